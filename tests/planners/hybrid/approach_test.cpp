// Goals that are landmarks: where the path ends beside them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using testing::ElementsAre;
using testing::MatchesRegex;

TEST_F(Hybrid, StandsBesideALandmarkWithoutAnAccessOnTheSideThatCanBeReached) {
  Landmark inside;
  inside.T_map_landmark = {1.4, 1.15, 0.0};  // in the block between the corridors
  const LandmarkId id = world.graph.add(inside);
  PlanRequest to_landmark = request('A', 'B');
  to_landmark.to = {};
  to_landmark.to.landmarks = {id};
  const PlanResult result = plan(to_landmark);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.landmarks, ElementsAre(id));
  EXPECT_LT((result.path.back().position() - inside.T_map_landmark.position()).norm(), 1.0);
  EXPECT_THAT(result.reason, MatchesRegex(".*; it ends [0-9.]+ m from L1"));
  expect_clear(result);
}

TEST_F(Hybrid, SaysHowFarFromTheApproachPoseItEndsWhereThatHasTooLittleRoom) {
  const LandmarkId id = landmark('B');
  world.grid.set_log_odds(world.grid.cell_at(world.places['B']), 900);
  PlanRequest to_landmark = request('U', 'N');
  to_landmark.to = {};
  to_landmark.to.landmarks = {id};
  const PlanResult result = plan(to_landmark);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.reason,
              MatchesRegex(".*; it ends [0-9.]+ m from the approach pose of B, where there is too little room"));
  expect_clear(result);
}

}  // namespace
}  // namespace cairn
