// Laser SLAM while it drives, from outside: worn wheels, no compass, loops that close.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "framework/files/world_file.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

constexpr double kMaxWallThickness_m = 0.25;  // drawn; a wall that is there twice has as much again

std::filesystem::path mission_file() {
  return source_folder() + "/config/missions/slam_home.yaml";
}

double length_of(const std::vector<Point>& points_m) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points_m.size(); ++i) length_m += (points_m[i] - points_m[i - 1]).norm();
  return length_m;
}

// Area of what is occupied, for each metre of the walls.
double wall_thickness_m(const OccupancyGrid& grid, const World& world) {
  int occupied = 0;
  const CellBox box = grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) occupied += grid.state({x, y}) == CellState::occupied ? 1 : 0;
  double length_m = 0.0;
  for (const WorldWall& wall : world.walls) length_m += length_of(wall.points_m);
  return occupied * grid.cell_m() * grid.cell_m() / length_m;
}

// Odometry alone is metres off by then.
TEST(SlamHome, AWornRobotWithoutACompassExploresAHomeAndComesBack) {
  const auto out = fresh_folder("slam_home");
  const Finished run = run_cairn({"run", mission_file().string(), "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err << run.out;
  const json report = json::parse(text_of_file(out / "report.json"));
  EXPECT_EQ(report["outcome"], "done");
  EXPECT_EQ(report["collisions"], 0);
  EXPECT_GT(report["explored_ratio"], 0.9);
  EXPECT_LT(report["pose_error"]["last_m"], 0.3);
  EXPECT_LT(report["pose_error"]["worst_m"], 0.5);

  const SavedMap map = load_map((out / "slam_home.cairn").string());
  const World world = load_world(source_folder() + "/config/worlds/turtlebot_home.yaml", map.shapes);
  EXPECT_LT(wall_thickness_m(map.grid, world), kMaxWallThickness_m);
  for (const auto& [category, at_m] : {std::pair("square", Point(1.9, 4.4)), std::pair("circle", Point(5.2, 4.6))}) {
    const std::vector<LandmarkId> found = map.graph.of_category(category);
    ASSERT_EQ(found.size(), 1U) << category;
    EXPECT_LT((map.graph.find(found.front())->T_map_landmark.position() - at_m).norm(), 0.3) << category;
  }
}

TEST(SlamHome, TheSameSeedGivesTheSameBytesAlthoughSearchesTakeTheirTime) {
  std::vector<std::string> maps;
  for (const char* name : {"slam_home_first", "slam_home_second"}) {
    const auto out = fresh_folder(name);
    const Finished run = run_cairn(
        {"run", mission_file().string(), "--out", out.string(), "--json", "--set", "steps.0.explore.at_most_s=240"});
    ASSERT_TRUE(std::filesystem::exists(out / "slam_home.cairn")) << run.err << run.out;
    maps.push_back(text_of_file(out / "slam_home.cairn") + text_of_file(out / "track.json"));
  }
  EXPECT_TRUE(maps[0] == maps[1]);
}

}  // namespace
}  // namespace cairn::testing_program
