// The hybrid planner as a mission makes it: from the modules that its settings name.
#include <gtest/gtest.h>

#include "framework/modules/module_library.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

constexpr double kRadius_m = 0.14;

class HybridModule : public ::testing::Test {
 protected:
  // A corridor whose stored route keeps 0.03 m beside the robot.
  test::DrawnWorld world = test::drawn_world(
      "####################\n"
      "#..................#\n"
      "#..................#\n"
      "#...A..........B...#\n"
      "#..................#\n"
      "#..................#\n"
      "####################\n");

  HybridModule() {
    for (const char place : {'A', 'B'}) {
      Landmark landmark;
      landmark.T_map_landmark = world.pose(place);
      landmark.access = world.pose(place);
      world.graph.add(landmark);
    }
    const double beside_m = 0.1 + kRadius_m + 0.03;  // the wall is one cell of 0.1 m
    Route route;
    route.from = 1;
    route.to = 2;
    route.trajectory = {world.pose('A'), {0.7, beside_m, 0.0}, {1.3, beside_m, 0.0}, world.pose('B')};
    route.cost_m = 0.5;  // by far the cheapest
    world.graph.add_route(route);
  }

  [[nodiscard]] PlanResult plan(const std::string& path_planner) const {
    const ModuleLibrary library({std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn"});
    ModuleContext context{world.robot};
    context.modules = &library;
    const std::string settings = "{shortcut: false, route: " + path_planner + "}";
    PlanRequest request;
    request.from.landmarks = {1};
    request.to.landmarks = {2};
    request.radius_m = kRadius_m;
    return library.make<Planner>({"hybrid", parse_config_text(settings, "test")}, context)
        ->plan(request, world.view(), {});
  }
};

TEST_F(HybridModule, TakesTheStoredRouteWhereThePathPlannerAsksForNoMargin) {
  const PlanResult result = plan("{plugin: ompl}");
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  ASSERT_EQ(result.segments.size(), 1U) << result.reason;
  EXPECT_EQ(result.segments.front().origin, PathSegment::Origin::stored);
  EXPECT_NEAR(result.clearance_m, 0.03, 1e-6);
}

// However the number is written: one module never reads the settings of another.
TEST_F(HybridModule, KeepsTheMarginThatThePathPlannerWasConfiguredWith) {
  for (const std::string margin : {"0.05", "+0.05", "5e-2", ".05"}) {
    const PlanResult result = plan("{plugin: ompl, margin_m: " + margin + "}");
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_GE(result.clearance_m, 0.05) << "margin_m: " << margin << "; " << result.reason
                                        << test::drawing_of(world.grid, result.path);
  }
}

}  // namespace
}  // namespace cairn
