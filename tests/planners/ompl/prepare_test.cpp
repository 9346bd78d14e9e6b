// What is prepared is what the first request asks for.

#include <gtest/gtest.h>

#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

struct Case {
  std::string name;
  MotionKind kind;
  PlannerTraits::Shape footprint;
};

class Prepared : public ::testing::TestWithParam<Case> {};

TEST_P(Prepared, TheFirstRequestBuildsNothing) {
  auto world = test::drawn_world(test::kOffice, 0.1, 2);
  world.robot.polygon_m = {{-0.1, -0.08}, {0.2, -0.08}, {0.2, 0.08}, {-0.1, 0.08}};
  OmplConfig config;
  config.kinematics = GetParam().kind;
  config.footprint = GetParam().footprint;
  config.turning_radius_m = 0.3;
  config.margin_m = 0.02;
  const OmplPlanner planner(config, world.robot);
  planner.prepare(world.view(), 0.1);
  const auto routes = planner.caches().routes.last();
  const auto outer_routes = planner.caches().outer_routes.last();
  ASSERT_TRUE(routes);
  EXPECT_EQ(outer_routes != nullptr, GetParam().kind == MotionKind::differential);

  PathRequest request = world.request('A', 'B', 0.1);
  request.to.heading_matters = true;
  const PathResult result = planner.plan(request, world.view(), {});
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(planner.caches().routes.last(), routes);
  EXPECT_EQ(planner.caches().outer_routes.last(), outer_routes);
}

INSTANTIATE_TEST_SUITE_P(
    Ompl, Prepared,
    ::testing::Values(Case{"disc", MotionKind::holonomic, PlannerTraits::Shape::disc},
                      Case{"differential_disc", MotionKind::differential, PlannerTraits::Shape::disc},
                      Case{"differential", MotionKind::differential, PlannerTraits::Shape::outline},
                      Case{"dubins", MotionKind::dubins, PlannerTraits::Shape::outline},
                      Case{"reeds_shepp", MotionKind::reeds_shepp, PlannerTraits::Shape::outline}),
    [](const auto& instance) { return instance.param.name; });

TEST(Prepared, WhatIsLargerThanTheMapIsLeftAlone) {
  const auto world = test::drawn_world(test::kOffice);
  OmplConfig config;
  config.kinematics = MotionKind::differential;
  const OmplPlanner planner(config);
  planner.prepare(world.view(), 1e9);
  EXPECT_FALSE(planner.caches().routes.last());
  planner.prepare(test::DrawnWorld{}.view(), 0.1);
  EXPECT_FALSE(planner.caches().routes.last());
}

}  // namespace
}  // namespace cairn
