#include "framework/reporting/run_track.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "maps/base/base64.hpp"
#include "maps/base/deflate.hpp"

namespace cairn {
namespace {

TEST(RunTrack, HoldsPosesPlansAndLandmarksWithTheirTimes) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  RobotModel robot;
  robot.radius_m = 0.31;
  const auto view = [&](double time_s) { return WorldView{grid, graph, robot, {{time_s, 0.0, 0.25}}, time_s}; };
  RunTrack track({.max_path_poses = 10, .max_samples = 10, .max_events = 3});
  PlanResult plan;
  plan.path = {{0.0, 0.0, 0.0}, {2.0, 1.0, 0.0}};
  track.on(TickDone{}, {view(1.0)});
  track.on(PathStarted{{Point(0.0, 0.0), Point(0.0, 3.0)}}, {view(0.5)});
  track.on(PlanDone{plan}, {view(1.0)});
  track.on(PathStarted{{Point(0.0, 0.0), Point(1.0, 0.5)}}, {view(1.0)});  // a part of the plan
  Landmark landmark;
  landmark.id = 3;
  track.on(LandmarkChanged{landmark, true}, {view(1.5)});
  track.on(LandmarkChanged{landmark, false}, {view(1.6)});
  track.on(TickDone{}, {view(2.0)});
  track.on(StepEnded{}, {view(2.0)});
  track.on(StepEnded{}, {view(2.5)});  // no plan is left
  track.on(LandmarkRetired{landmark, "freed"}, {view(3.0)});
  EXPECT_EQ(
      track.json(),
      R"({"robot_radius_m":0.31,"poses_every":1,"poses":[[1.0,1.0,0.0,0.25,0.0,0.0,0.0],[2.0,2.0,0.0,0.25,0.0,0.0,0.0]],)"
      R"("plans":[{"time_s":0.5,"points":[[0.0,0.0],[0.0,3.0]]},)"
      R"({"time_s":1.0,"points":[[0.0,0.0],[2.0,1.0]]},{"time_s":2.0,"points":[]}],)"
      R"("landmarks":[{"time_s":1.5,"id":3,"change":"found"},{"time_s":3.0,"id":3,"change":"retired"}],"grid":[],"ranges":[]})"
      "\n");
}

TEST(RunTrack, HoldsWhatOfTheGridHasChanged) {
  OccupancyGrid grid(0.05);
  grid.set_log_odds({64, -1}, 400);
  const LandmarkGraph graph;
  const RobotModel robot;
  RunTrack track;
  track.on(TickDone{}, {WorldView{grid, graph, robot, {}, 1.5}});
  const auto json = nlohmann::json::parse(track.json());
  ASSERT_EQ(json["grid"].size(), 1U);
  const auto& moment = json["grid"][0];
  EXPECT_EQ(moment["time_s"], 1.5);
  ASSERT_EQ(moment["tiles"].size(), 1U);
  EXPECT_EQ(moment["tiles"][0][0], 1);
  EXPECT_EQ(moment["tiles"][0][1], -1);
  const std::vector<std::uint8_t> packed = bytes_of_base64(moment["tiles"][0][2].get<std::string>());
  const std::string ol = inflated(std::string(packed.begin(), packed.end()), GridTile::kCells);
  EXPECT_EQ(static_cast<std::uint8_t>(ol[std::size_t{63} * 64]), ol_of(400));
  EXPECT_EQ(static_cast<std::uint8_t>(ol[0]), kUnknownOl);
}

TEST(RunTrack, HoldsHowSureThePoseIsAndTheLastReadings) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  PoseEstimate pose;
  pose.T_map_robot = {1.0, 2.0, 0.0};
  pose.covariance(0, 1) = 0.001234;
  const double none = std::numeric_limits<double>::infinity();
  Observation observation;
  RunTrack track;
  const auto tick = [&](double time_s, const RangeReading& reading) {
    observation.ranges = {reading};
    track.on(TickDone{}, {WorldView{grid, graph, robot, pose, time_s, &observation}});
  };
  tick(0.1, {{0.1, 0.0, 1.0}, 0.26, 0.1, 5.0, 1.5, 0});
  tick(0.2, {{0.0, 0.2, 0.0}, 0.26, 0.1, 5.0, none, 1});
  tick(0.3, {{0.0, 0.2, 0.0}, 0.26, 0.1, 5.0, -none, 1});
  const auto json = nlohmann::json::parse(track.json());
  EXPECT_EQ(json["poses"][0], nlohmann::json::parse("[0.1, 1.0, 2.0, 0.0, 0.0, 0.001234, 0.0]"));
  EXPECT_EQ(json["ranges"], nlohmann::json::parse("[[0.1, [1.1, 2.0, 1.0, 0.26, 1.5]],"
                                                  "[0.2, [1.1, 2.0, 1.0, 0.26, 1.5], [1.0, 2.2, 0.0, 0.26, -5.0]],"
                                                  "[0.3, [1.1, 2.0, 1.0, 0.26, 1.5]]]"));
}

TEST(RunTrack, HasABoundedSize) {
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  const RobotModel robot;
  RunTrack track({.max_path_poses = 10, .max_samples = 100, .max_events = 100});
  for (int i = 0; i < 100'000; ++i) track.on(TickDone{}, {WorldView{grid, graph, robot, {}, 0.1 * i}});
  EXPECT_LT(track.json().size(), 5000U);
}

}  // namespace
}  // namespace cairn
