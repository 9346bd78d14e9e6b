#include "maps/pose_graph/relation_errors.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(RelationErrors, AreLengthAndAngleOfWhatIsLeft) {
  const std::vector<StampedPose> poses{{2.0, {1.0, 1.0, radians(90.0)}}, {1.0, {0.0, 0.0, radians(90.0)}}};
  // In the frame at 1 s, (1, 1) is one metre ahead and one to the right.
  const std::vector<StatedRelation> exact{{1.0, 2.0, {1.0, -1.0, 0.0}}};
  EXPECT_NEAR(relation_errors(exact, poses, 0.0).translation_m.mean, 0.0, 1e-12);
  const std::vector<StatedRelation> off{{1.0, 2.0, {1.3, -0.6, radians(-10.0)}}, {2.0, 1.0, {-1.0, -1.0, 0.0}}};
  const RelationErrors errors = relation_errors(off, poses, 0.0);
  EXPECT_EQ(errors.used, 2U);
  EXPECT_NEAR(errors.translation_m.greatest, 2.0, 1e-9);
  EXPECT_NEAR(errors.translation_m.mean, (0.5 + 2.0) / 2.0, 1e-9);
  EXPECT_NEAR(errors.translation_m.deviation, 0.75, 1e-9);
  EXPECT_NEAR(errors.rotation_deg.greatest, 10.0, 1e-9);
}

TEST(RelationErrors, OnlyPosesOfTheirStampCount) {
  const std::vector<StampedPose> poses{{1.0, {}}, {1.4, {1.0, 0.0, 0.0}}, {2.0, {5.0, 0.0, 0.0}}};
  const std::vector<StatedRelation> relations{{1.0, 1.5, {1.0, 0.0, 0.0}}, {1.0, 1.75, {}}};
  EXPECT_EQ(relation_errors(relations, poses, 0.01).used, 0U);
  EXPECT_EQ(relation_errors(relations, poses, 0.01).without_pose, 2U);
  const RelationErrors near = relation_errors(relations, poses, 0.15);
  EXPECT_EQ(near.used, 1U);
  EXPECT_NEAR(near.translation_m.mean, 0.0, 1e-12) << "the nearest pose counts";
}

}  // namespace
}  // namespace cairn
