// What ends short of the goal is never called solved, and is reported as it is.

#include <gmock/gmock.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using test::kRadius_m;

TEST_F(Hybrid, AnApproximateAnswerIsReportedAsItIsAlsoFromATightStart) {
  OmplConfig few;
  few.algorithm = Algorithm::rrt;
  few.iterations = 3;
  few.fall_back_to_grid = false;
  router = test::counted_ompl(few);
  int approximate = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    for (const double x_m : {0.25, 0.18}) {  // free, and nearer to the wall than the radius
      PlanRequest asked = request('A', 'D');
      asked.from.pose = Pose2{x_m, 1.0, 0.0};
      asked.seed = seed;
      const PlanResult result = plan(asked);
      EXPECT_NE(result.outcome, PlanOutcome::solved) << "three draws do not get there";
      if (result.outcome != PlanOutcome::approximate) continue;
      ++approximate;
      EXPECT_EQ(result.path.front().position(), asked.from.pose->position());
      EXPECT_NE(result.path.back().position(), world.places['D']);
      EXPECT_NEAR(result.length_m, length_of(result.path), 1e-9) << result.reason;
      EXPECT_THAT(result.reason, ::testing::HasSubstr("short of the goal"));
      EXPECT_FALSE(result.length_lower_bound_m);
      expect_segments_add_up(result);
    }
  EXPECT_GT(approximate, 4);
}

}  // namespace
}  // namespace cairn
