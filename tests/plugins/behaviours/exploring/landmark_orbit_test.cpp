#include "plugins/behaviours/exploring/landmark_orbit.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

struct Orbiting : testing::Test {
  Orbiting()
      : map(R"(
####################
#..................#
#..................#
#..................#
#..................#
#..................#
#..................#
#..................#
#..................#
#........###.......#
#........#L#.......#
#........###.......#
#..................#
#..................#
#..................#
#.........R........#
#..................#
#..................#
####################
)"),
        orbit({}, 0.4, {}) {
    robot.radius_m = 0.15;
  }
  [[nodiscard]] WorldView world() const {
    WorldView view{map.grid, graph, robot, {}, 0.0, nullptr};
    view.pose.T_map_robot = {map.at('R').x(), map.at('R').y(), 0.0};
    return view;
  }
  AsciiGrid map;
  LandmarkGraph graph;
  RobotModel robot;
  LandmarkOrbit orbit;
};

TEST_F(Orbiting, LeadsRoundTheLandmarkAtTheGivenDistance) {
  orbit.see(world());
  orbit.begin();
  const std::vector<Point> path = orbit.path(world(), map.at('L'));
  ASSERT_GT(path.size(), 4U);
  EXPECT_FALSE(orbit.is_covered()) << "it has not looked yet";
  const double radius_m = (path.back() - map.at('L')).norm();
  EXPECT_GT(radius_m, 0.4);
  EXPECT_LT(radius_m, 1.0);
}

TEST_F(Orbiting, NothingIsLeftWhereAllIsAvoided) {
  orbit.see(world());
  orbit.begin();
  for (double x_m = 0.0; x_m < 2.0; x_m += 0.1)
    for (double y_m = 0.0; y_m < 2.0; y_m += 0.1) orbit.avoid({x_m, y_m});
  EXPECT_TRUE(orbit.path(world(), map.at('L')).empty());
  orbit.begin();
  EXPECT_FALSE(orbit.path(world(), map.at('L')).empty()) << "a new orbit tries all again";
}

}  // namespace
}  // namespace cairn::behaviours
