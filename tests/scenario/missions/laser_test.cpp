// Robots with lasers, from outside: a home explored, its recording played back.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

std::string two_rooms_mission(const std::string& robot, const std::string& localizer) {
  const std::string config = source_folder() + "/config";
  return "mission: two_rooms\nseed: 7\nrobot: " + config + "/robots/" + robot + ".yaml\nworld: " + config +
         "/worlds/two_rooms.yaml\nstart: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: {plugin: simulated_robot}\n"
         "localizer: {plugin: " +
         localizer +
         "}\nmap: {plugin: muriel, cell_m: 0.05}\ndetector: {plugin: template_matcher, templates: " + config +
         "/templates, rendering: ideal, coarse_cells: 5}\nplanner: {plugin: hybrid}\nat_most_s: 1500\n"
         "record: recorded.log\nsteps:\n  - explore: {until_known_ratio: 0.97, at_most_s: 1200}\n";
}

class LaserMission : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(LaserMission, ExploresBothRoomsWithoutAContact) {
  const auto [robot, localizer] = GetParam();
  const auto out = fresh_folder(std::string("laser_") + robot);
  write_text(out / "two_rooms.yaml", two_rooms_mission(robot, localizer));
  const Finished run = run_cairn({"run", (out / "two_rooms.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err << run.out;
  const json summary = json::parse(run.out);
  EXPECT_EQ(summary["outcome"], "done");
  EXPECT_EQ(summary["collisions"], 0);
  const SavedMap map = load_map((out / "two_rooms.cairn").string());
  for (const Point& middle : {Point(3.0, 3.0), Point(9.0, 3.0)})
    EXPECT_EQ(map.grid.state(map.grid.cell_at(middle)), CellState::free) << middle.transpose();
}

INSTANTIATE_TEST_SUITE_P(Robots, LaserMission,
                         testing::Values(std::pair("pioneer3dx_laser", "odometry_compass"),
                                         std::pair("turtlebot3", "odometry_compass")),
                         [](const auto& tested) { return std::string(tested.param.first); });

TEST(LaserRecording, PlayedBackGivesTheSameMapBitForBit) {
  const auto out = fresh_folder("laser_recording");
  write_text(out / "two_rooms.yaml", two_rooms_mission("pioneer3dx_laser", "odometry_compass"));
  const Finished run = run_cairn({"run", (out / "two_rooms.yaml").string(), "--out", out.string(), "--json", "--set",
                                  "steps.0.explore.at_most_s=15"});
  ASSERT_TRUE(std::filesystem::exists(out / "recorded.log")) << run.err;
  write_text(out / "replay.yaml", "mission: replay\nrobot: " + source_folder() +
                                      "/config/robots/pioneer3dx_laser.yaml\nsensor: {plugin: carmen_log, file: "
                                      "./recorded.log}\nlocalizer: {plugin: odometry_compass}\n"
                                      "map: {plugin: muriel, cell_m: 0.05}\n");
  const Finished replay = run_cairn({"run", (out / "replay.yaml").string(), "--out", out.string(), "--json"});
  ASSERT_EQ(replay.exit_status, 0) << replay.err;
  EXPECT_TRUE(load_map((out / "two_rooms.cairn").string()).grid == load_map((out / "replay.cairn").string()).grid);
}

}  // namespace
}  // namespace cairn::testing_program
