#include "plugins/behaviours/docking/axis_echoes.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn::behaviours {
namespace {

// A robot 1 m before the centre of a landmark, which it faces; the outline on the map is 0.2 m from the centre.
struct Approaching : testing::Test {
  void see(double range_m, int sensor = 0, double angle_rad = 0.0) {
    Observation seen;
    seen.ranges = {{{0.1, 0.0, angle_rad}, radians(15.0), 0.1, 5.0, range_m, sensor}};
    time_s += 0.1;
    WorldView world{grid, graph, robot, {}, time_s, &seen};
    world.pose.T_map_robot = {1.0, 0.0, radians(180.0)};
    echoes.see(world, {{0.0, 0.0}, 0.0}, 0.2);
  }
  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  RobotModel robot;
  AxisEchoes echoes{ApproachEchoSettings{}};
  double time_s = 0.0;
};

TEST_F(Approaching, TheOutlineIsTheMedianOfTheLatestEchoes) {
  see(0.6);
  see(0.6);
  EXPECT_FALSE(echoes.outline_m()) << "too few";
  see(0.7);
  EXPECT_NEAR(*echoes.outline_m(), 0.3, 1e-9);
  echoes.forget();
  EXPECT_FALSE(echoes.outline_m());
}

TEST_F(Approaching, SilenceAndTransducersThatLookAsideDoNotCount) {
  for (int i = 0; i < 5; ++i) {
    see(std::numeric_limits<double>::infinity());
    see(0.6, 1, radians(30.0));
  }
  EXPECT_FALSE(echoes.outline_m());
}

TEST_F(Approaching, OnlyTheTransducerThatReportedSomethingBetweenReportsThatItHasGone) {
  EXPECT_FALSE(echoes.between_since_s());
  see(0.2, 3);
  ASSERT_TRUE(echoes.between_since_s());
  EXPECT_DOUBLE_EQ(*echoes.between_since_s(), 0.1);
  see(0.7, 4);
  EXPECT_TRUE(echoes.between_since_s());
  see(0.7, 3);
  EXPECT_FALSE(echoes.between_since_s());
}

TEST(DockAxis, MeasuresAlongAndAsideOfTheLine) {
  const DockAxis axis{{1.0, 1.0}, radians(90.0)};
  EXPECT_NEAR(axis.along_m({1.0, 3.0}), 2.0, 1e-12);
  EXPECT_NEAR(axis.aside_m({0.5, 3.0}), 0.5, 1e-12);
}

}  // namespace
}  // namespace cairn::behaviours
