#include "maps/exchange/pose_graphs/stamped_poses.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

TEST(StampedPoses, AreReadInBothForms) {
  const auto poses =
      parse_stamped_poses("# t x y theta\n1.5 2 -3 0.25\n\n2.5 1 0 9 0 0 0.7071067811865476 0.7071067811865476\n", "p");
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].stamp_s, 1.5);
  EXPECT_EQ(poses[0].T_map_robot, (Pose2{2.0, -3.0, 0.25}));
  EXPECT_EQ(poses[1].T_map_robot.position(), Point(1.0, 0.0));
  EXPECT_NEAR(poses[1].T_map_robot.theta_rad, radians(90.0), 1e-9);
}

TEST(StampedPoses, AreWrittenInTheTumFormToTheLastBit) {
  const std::vector<StampedPose> poses = {{976053558.437199, {1.0 / 3.0, -2.5, 3.0}}, {0.5, {0.0, 1e-9, -0.25}}};
  const std::string text = tum_of(poses);
  EXPECT_EQ(text.substr(0, text.find(' ')), "976053558.437199");
  const std::vector<StampedPose> read = parse_stamped_poses(text, "poses.tum");
  ASSERT_EQ(read.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read[i].stamp_s, poses[i].stamp_s);
    EXPECT_EQ(read[i].T_map_robot.position(), poses[i].T_map_robot.position());
    EXPECT_NEAR(read[i].T_map_robot.theta_rad, poses[i].T_map_robot.theta_rad, 1e-12);
  }
}

TEST(StampedPoses, RelationsKeepWhatIsPlanar) {
  const auto relations = parse_relations("1 2 0.4 -0.1 9 9 9 -0.07\n", "r");
  ASSERT_EQ(relations.size(), 1U);
  EXPECT_EQ(relations[0].to_s, 2.0);
  EXPECT_EQ(relations[0].T_from_to, (Pose2{0.4, -0.1, -0.07}));
}

TEST(StampedPoses, RefuseWithThePlace) {
  EXPECT_EQ(refusal_of(parse_stamped_poses, "1 2 3\n"), "1:6: theta is missing: T X Y THETA, or T X Y Z QX QY QZ QW");
  EXPECT_EQ(refusal_of(parse_stamped_poses, "1 2 3 4 0 0 0 1 5\n"),
            "1:17: \"5\" is too much: T X Y THETA, or T X Y Z QX QY QZ QW");
  EXPECT_EQ(refusal_of(parse_relations, "1 2 0 0 0 0 0 x\n"), "1:15: yaw \"x\" is not a number");
  EXPECT_EQ(refusal_of(parse_relations, "# none\n"), " holds no line T1 T2 DX DY DZ ROLL PITCH YAW");
}

}  // namespace
}  // namespace cairn
