#include "planners/landmark_search/flat_search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/landmark_search/graph_world.hpp"

namespace cairn {
namespace {

using test::GraphWorld;
using test::line_of;
using test::request;
using ::testing::ElementsAre;

// What it shares with the search over the hierarchy is in landmark_search_test.

TEST(FlatSearch, SettlesWhatIsNotFartherThanTheGoal) {
  GraphWorld world = line_of(3);
  world.route(1, 3, 5.0);
  const RouteResult result = world.plan(FlatSearch(), request({1}, {3}));
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2, 3));
  EXPECT_EQ(result.settled, 3);
}

TEST(FlatSearch, StopsAsSoonAsTheGoalIsSettled) {
  EXPECT_EQ(line_of(1000).plan(FlatSearch(), request({1}, {10})).settled, 10);
}

TEST(FlatSearch, KeepsToACountOfSettledLandmarks) {
  const GraphWorld world = line_of(200);
  Budget few;
  few.iterations = 100;
  EXPECT_EQ(world.plan(FlatSearch(), request({1}, {100}), few).outcome, PlanOutcome::solved);
  EXPECT_EQ(world.plan(FlatSearch(), request({1}, {101}), few).outcome, PlanOutcome::out_of_budget);
}

TEST(FlatSearch, SaysWhatItDoesNotKnow) {
  const GraphWorld world = line_of(2);
  const auto reason = [&](auto change) {
    RouteRequest asked = request({1}, {2});
    change(asked);
    const RouteResult result = world.plan(FlatSearch(), asked);
    EXPECT_EQ(result.outcome, PlanOutcome::unsupported);
    return result.reason;
  };
  EXPECT_EQ(reason([](RouteRequest& asked) { asked.alternatives = 1; }),
            "flat_search does not know alternatives; landmark_search does");
  EXPECT_EQ(reason([](RouteRequest& asked) { asked.explain = true; }),
            "flat_search does not know an explanation; landmark_search does");
  EXPECT_EQ(reason([](RouteRequest& asked) { asked.cost = CostKind::time; }),
            "flat_search does not know other costs than length; landmark_search does");
}

}  // namespace
}  // namespace cairn
