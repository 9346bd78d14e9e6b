#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

using ::testing::HasSubstr;

class EveryAlgorithm : public ::testing::TestWithParam<std::string> {
 protected:
  static OmplPlanner planner(const std::string& more = "") {
    return OmplPlanner(
        load_config<OmplConfig>(parse_config_text("algorithm: " + GetParam() + "\n" + more, "test"), "plugin ompl"));
  }
};

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, algorithm] : algorithm_names()) all.push_back(name);
  return all;
}

TEST_P(EveryAlgorithm, FindsItsOwnWayRoundTheWalls) {
  const auto world = test::drawn_world(test::kOffice);
  const PathRequest request = world.request('A', 'B', 0.15);
  const PathResult result = planner("fall_back_to_grid: false\niterations: 5000").plan(request, world.view(), {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_TRUE(test::keeps_clear(world.grid, result.path, request.radius_m))
      << test::drawing_of(world.grid, result.path);
  EXPECT_EQ(result.path.front().position(), world.places.at('A'));
  EXPECT_EQ(result.path.back().position(), world.places.at('B'));
  EXPECT_NEAR(result.length_m, length_of(result.path), 1e-9);
  EXPECT_EQ(result.cost_m, result.length_m);
  EXPECT_LT(result.length_m, 2.9) << test::drawing_of(world.grid, result.path);
}

TEST_P(EveryAlgorithm, GivesTheSameRouteAgain) {
  const auto world = test::drawn_world(test::kOffice);
  PathRequest request = world.request('A', 'D', 0.12);
  request.seed = 5;
  const PathResult first = planner("iterations: 600").plan(request, world.view(), {});
  (void)planner("iterations: 77").plan(world.request('C', 'B', 0.1), world.view(), {});
  const PathResult again = planner("iterations: 600").plan(request, world.view(), {});
  EXPECT_EQ(first.outcome, again.outcome);
  EXPECT_EQ(first.path, again.path);
}

TEST_P(EveryAlgorithm, StopsWhenCancelledOrLate) {
  const auto world = test::drawn_world(test::kOffice);
  const std::atomic<bool> cancel{true};
  Budget cancelled;
  cancelled.cancel = &cancel;
  EXPECT_EQ(planner().plan(world.request('A', 'B', 0.1), world.view(), cancelled).outcome, PlanOutcome::cancelled);
  Budget late;
  late.deadline = Budget::Clock::time_point::min();
  EXPECT_EQ(planner().plan(world.request('A', 'B', 0.1), world.view(), late).outcome, PlanOutcome::out_of_budget);
}

// A deadline that passes while the search runs: only that the call comes back is promised.
TEST_P(EveryAlgorithm, ComesBackWhenTheDeadlinePassesMeanwhile) {
  const auto world = test::drawn_world(test::kOffice);
  Budget short_budget;
  short_budget.deadline = Budget::Clock::now() + std::chrono::milliseconds(3);
  const PathResult result =
      planner("iterations: 1000000000").plan(world.request('A', 'B', 0.1), world.view(), short_budget);
  EXPECT_TRUE(result.outcome == PlanOutcome::solved || result.outcome == PlanOutcome::out_of_budget) << result.reason;
}

INSTANTIATE_TEST_SUITE_P(Ompl, EveryAlgorithm, ::testing::ValuesIn(names()),
                         [](const auto& instance) { return instance.param; });

std::string error_of(const std::string& config) {
  try {
    (void)OmplPlanner(load_config<OmplConfig>(parse_config_text(config, "mission.yaml"), "plugin ompl"));
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

TEST(OmplConfig, AMisspeltAlgorithmNamesTheNearest) {
  const std::string error = error_of("algorithm: BITStar");
  EXPECT_THAT(error, HasSubstr("mission.yaml:1:12"));
  EXPECT_THAT(error, HasSubstr("BITstar"));
}

TEST(OmplConfig, ParametersAreThoseOfTheAlgorithm) {
  EXPECT_EQ(error_of("algorithm: RRTConnect\nparameters: {range: 0.5}"), "no error");
  EXPECT_EQ(error_of("algorithm: RRTConnect\nparameters: {rnage: 0.5}"),
            "mission.yaml:2:14: RRTConnect has no parameter \"rnage\" (did you mean \"range\"?)");
  EXPECT_EQ(error_of("algorithm: RRTConnect\nparameters: {range: wide}"),
            "mission.yaml:2:21: parameter range of RRTConnect does not take \"wide\"");
  EXPECT_THAT(error_of("parameters: [1, 2]"), HasSubstr("parameters must be a map"));
}

}  // namespace
}  // namespace cairn
