#include "framework/reporting/marker_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using testing::HasSubstr;

const Pose2 kT_map_marker{4.0, 1.0, radians(180.0)};

struct TagDrive {
  double reprojection_px = 0.1;
  double drive_m = 2.5;
  double drifted_m = 0.0;  // of the pose that is believed
  double begin_s = 0.0;
};

// A robot drives towards a marker whose distances it sees wrong by a ratio.
void drive(MarkerFigures& figures, double seen_ratio, const TagDrive& how) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  Observation observation;
  WorldView world{grid, graph, robot, {}};
  world.observation = &observation;
  world.time_s = how.begin_s;
  for (double x_m = 0.5; x_m < 0.5 + how.drive_m; x_m += 0.05) {
    world.time_s += 0.2;
    world.pose.T_map_robot = {x_m, 1.2, 0.0};
    MarkerSighting sighting;
    sighting.marker = {MarkerFamily::tag36h11, 7};
    sighting.pose.T_robot_marker = inverse(world.pose.T_map_robot) * kT_map_marker;
    sighting.pose.T_robot_marker.x_m *= seen_ratio;
    sighting.pose.T_robot_marker.y_m *= seen_ratio;
    sighting.pose.reprojection_error_px = how.reprojection_px;
    observation.markers = {sighting};
    world.pose.T_map_robot.x_m += how.drifted_m;
    figures.note(world);
  }
}

MarkerFigures figures_of_drive(double seen_ratio, const TagDrive& how = {}) {
  MarkerFigures figures;
  drive(figures, seen_ratio, how);
  return figures;
}

TEST(MarkerFigures, ARightCameraGivesNoWarning) {
  const MarkerFigures figures = figures_of_drive(1.0);
  EXPECT_EQ(figures.markers(), 1U);
  EXPECT_GE(figures.sightings(), 50U);
  EXPECT_NEAR(figures.reprojection_error_px(), 0.1, 1e-9);
  ASSERT_TRUE(figures.range_ratio());
  EXPECT_NEAR(*figures.range_ratio(), 1.0, 1e-9);
  EXPECT_EQ(figures.warning(), "");
}

TEST(MarkerFigures, AWrongFocalLengthIsNoticed) {
  const MarkerFigures figures = figures_of_drive(1.25);
  EXPECT_NEAR(figures.range_ratio().value(), 0.8, 1e-9);
  EXPECT_THAT(figures.warning(), HasSubstr("0.80 times as far away as the pictures say"));
}

TEST(MarkerFigures, AWrongDistortionIsNoticed) {
  EXPECT_THAT(figures_of_drive(1.0, {.reprojection_px = 2.5}).warning(), HasSubstr("2.5 pixels from where"));
}

TEST(MarkerFigures, APoseThatHasDriftedBetweenTwoVisitsIsNoFaultOfTheCamera) {
  MarkerFigures figures = figures_of_drive(1.0, {.drive_m = 1.5});
  drive(figures, 1.0, {.drive_m = 2.5, .drifted_m = 1.0, .begin_s = 200.0});
  EXPECT_NEAR(figures.range_ratio().value(), 1.0, 1e-9);
  EXPECT_EQ(figures.warning(), "");
}

TEST(MarkerFigures, ARobotThatHardlyMovesCannotTell) {
  EXPECT_FALSE(figures_of_drive(1.25, {.drive_m = 0.3}).range_ratio());
  EXPECT_EQ(figures_of_drive(1.25, {.drive_m = 0.3}).warning(), "");
}

}  // namespace
}  // namespace cairn
