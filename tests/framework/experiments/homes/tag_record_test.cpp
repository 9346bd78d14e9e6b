#include "framework/experiments/homes/tag_record.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

World hall_of_8_m() {
  World world;
  world.max_m = {8.0, 8.0};
  world.walls = {{{{0.0, 0.0}, {8.0, 0.0}, {8.0, 8.0}, {0.0, 8.0}, {0.0, 0.0}}, Surface::rough}};
  return world;
}

constexpr double kTolerance_m = 0.5;

// A room of 8 x 8 m with a tag in the middle of its right wall, and one behind the robot.
struct Tagged : testing::Test {
  Tagged() : world(hall_of_8_m()) {
    world.tags = {{{MarkerFamily::tag36h11, 7}, {8.0, 4.0, radians(180.0)}, 0.3, 0.16},
                  {{MarkerFamily::tag36h11, 8}, {0.0, 4.0, 0.0}, 0.3, 0.16}};
    robot.cameras.emplace_back();
  }
  void take_pictures(const std::vector<Point>& places_m, TagRecord& record) {
    for (const Point& p_m : places_m) {
      observation.images = {CameraImage{}};
      WorldView view{grid, graph, robot, {}, 0.0};
      view.observation = &observation;
      MissionView mission{view};
      mission.truth.emplace();
      mission.truth->T_map_robot = {p_m.x(), p_m.y(), 0.0};
      record.on(TickDone{}, mission);
    }
  }
  void add_landmark(int number, const Pose2& T_map_landmark) {
    Landmark landmark;
    landmark.marker = MarkerId{MarkerFamily::tag36h11, number};
    landmark.T_map_landmark = T_map_landmark;
    graph.add(landmark);
  }

  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  RobotModel robot;
  World world;
  Observation observation;
};

TEST_F(Tagged, ThreePlacesMakeATagOneWithinSight) {
  TagRecord record(world);
  take_pictures({{6.0, 4.0}, {6.05, 4.0}, {6.3, 4.0}}, record);
  EXPECT_EQ(record.verdict(graph, kTolerance_m).in_sight, 0) << "two of them are one place";
  take_pictures({{6.6, 4.0}}, record);
  const TagVerdict verdict = record.verdict(graph, kTolerance_m);
  EXPECT_EQ(verdict.hung, 2);
  EXPECT_EQ(verdict.in_sight, 1);
  EXPECT_EQ(verdict.found, 0);
}

TEST_F(Tagged, LandmarksOfNoTagOrFarFromItAreFalse) {
  TagRecord record(world);
  take_pictures({{6.0, 4.0}, {6.3, 4.0}, {6.6, 4.0}}, record);
  add_landmark(7, {8.0, 4.1, radians(178.0)});
  add_landmark(8, {0.0, 4.0, 0.0});
  add_landmark(9, {3.0, 3.0, 0.0});
  TagVerdict verdict = record.verdict(graph, kTolerance_m);
  EXPECT_EQ(verdict.found, 1);
  EXPECT_EQ(verdict.found_besides, 1);
  EXPECT_EQ(verdict.false_landmarks, 1);
  ASSERT_EQ(verdict.position_error_m.size(), 2U);
  EXPECT_NEAR(verdict.position_error_m[0], 0.1, 1e-9);
  EXPECT_NEAR(verdict.direction_error_deg[0], 2.0, 1e-9);
  verdict = record.verdict(graph, 0.05);
  EXPECT_EQ(verdict.found, 0);
  EXPECT_EQ(verdict.false_landmarks, 2) << "0.1 m are too far now";
}

TEST_F(Tagged, SightingsOfNumbersThatHangNowhereAreFalse) {
  TagRecord record(world);
  observation.markers.resize(2);
  observation.markers[0].marker = {MarkerFamily::tag36h11, 7};
  observation.markers[1].marker = {MarkerFamily::tag36h11, 99};
  take_pictures({{6.0, 4.0}}, record);
  const TagVerdict verdict = record.verdict(graph, kTolerance_m);
  EXPECT_EQ(verdict.sightings, 2);
  EXPECT_EQ(verdict.false_sightings, 1);
}

}  // namespace
}  // namespace cairn
