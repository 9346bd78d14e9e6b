// Missions of config/ in a world that is not ours, from a map without a cell to home again: by the serial protocol and
// on a ROS 2 network.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/mission/mission.hpp"
#include "framework/reporting/report.hpp"
#include "maps/store/map_store.hpp"
#include "tests/enki/enki_robot.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

constexpr double kKnown = 0.95;  // of a room's cells
constexpr double kNearLandmark_m = 0.10;
constexpr double kNearHome_m = 0.25;
constexpr double kFromWalls_m = 0.10;
constexpr double kDoorway_m = 2.75;  // x of the wall between the rooms

// Of the cells between left and right that no object hides.
double known_ratio_of_room(const OccupancyGrid& grid, const World& world, double left_m, double right_m) {
  int known = 0;
  int all = 0;
  for (double x_m = left_m + kFromWalls_m; x_m < right_m - kFromWalls_m; x_m += grid.cell_m())
    for (double y_m = world.min_m.y() + kFromWalls_m; y_m < world.max_m.y() - kFromWalls_m; y_m += grid.cell_m()) {
      const Point at(x_m, y_m);
      if (std::any_of(world.objects.begin(), world.objects.end(), [&](const WorldObject& object) {
            return object.contour.signed_distance(inverse(object.T_map_object) * at) < kFromWalls_m;
          }))
        continue;
      ++all;
      known += grid.state(grid.cell_at(at)) != CellState::unknown ? 1 : 0;
    }
  return known / static_cast<double>(all);
}

class EnkiMission : public EnkiRobot {
 protected:
  void expect_both_rooms_the_landmarks_and_home(const std::string& name, const std::vector<std::string>& settings) {
    const std::string file = source_folder() + "/config/missions/" + name + ".yaml";
    std::vector<std::string> words{"run", file, "--out", (folder_ / "out").string()};
    for (const std::string& setting : settings) words.insert(words.end(), {"--set", setting});
    const Finished finished = run_cairn(words);
    ASSERT_EQ(finished.exit_status, 0) << finished.out << finished.err;
    said_ = finished.out + finished.err;
    const Mission mission = load_mission(file);
    const SavedMap map = load_map(folder_ / "out" / (name + ".cairn"));
    const World& world = *mission.world;
    EXPECT_GT(known_ratio_of_room(map.grid, world, world.min_m.x(), kDoorway_m), kKnown) << said_;
    EXPECT_GT(known_ratio_of_room(map.grid, world, kDoorway_m, world.max_m.x()), kKnown) << said_;
    const TruthScore score = score_against(world, map.graph, kNearLandmark_m);
    EXPECT_EQ(score.matched.size(), 2U) << said_;
    EXPECT_EQ(score.false_landmarks, 0) << said_;
    EXPECT_EQ(score.missed_objects, 0) << said_;
    expect_home(mission.config.start.at_m);
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "map.png"));
    expect_the_recording_to_give(map, mission, folder_ / "out" / (name + ".log.gz"));
  }

 private:
  // Bit for bit, with the same settings of what makes maps.
  void expect_the_recording_to_give(const SavedMap& map, const Mission& mission, const std::filesystem::path& log) {
    const Point start_m = mission.config.start.at_m;
    write_text(folder_ / "replay.yaml",
               "mission: replay\nrobot: " + mission.config.robot.string() + "\nstart: {at_m: [" +
                   std::to_string(start_m.x()) + ", " + std::to_string(start_m.y()) +
                   "], angle_deg: 0}\nsensor: {plugin: carmen_log, file: " + log.string() +
                   "}\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel, cell_m: 0.05}\n"
                   "detector: {plugin: template_matcher, templates: " +
                   source_folder() + "/config/templates, coarse_cells: 5}\n");
    const Finished finished = run_cairn({"run", (folder_ / "replay.yaml").string(), "--out", folder_.string()});
    ASSERT_EQ(finished.exit_status, 0) << finished.out << finished.err;
    const SavedMap replayed = load_map(folder_ / "replay.cairn");
    EXPECT_TRUE(replayed.grid == map.grid) << finished.out;
    EXPECT_EQ(replayed.graph.landmarks().size(), map.graph.landmarks().size()) << finished.out;
  }
  // By Enki's own account, standing, and never having touched anything.
  void expect_home(const Point& start_m) {
    const std::vector<EnkiTick> all = ticks();
    ASSERT_FALSE(all.empty());
    const EnkiTick& last = all.back();
    EXPECT_LT(std::hypot(last.x_m - start_m.x(), last.y_m - start_m.y()), kNearHome_m) << said_;
    EXPECT_NEAR(last.v_mps, 0.0, 0.01);
    EXPECT_EQ(last.touches, 0.0) << said_;
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), [](const EnkiTick& tick) { return tick.x_m > kDoorway_m + 0.5; }));
  }

  std::string said_;
};

TEST_F(EnkiMission, ExploresTwoRoomsAndComesHomeAtASerialLine) {
  begin_at_the_line();
  if (IsSkipped()) return;
  expect_both_rooms_the_landmarks_and_home("enki_pioneer", {"sensor.device=" + line_.string()});
}

TEST_F(EnkiMission, ExploresTwoRoomsAndComesHomeOnARos2Network) {
  begin_in_the_domain();
  if (IsSkipped()) return;
  expect_both_rooms_the_landmarks_and_home("enki_ros2", {"sensor.domain=" + domain_});
}

// With a world to hold landmarks against, but no robot there: nobody is waited for.
TEST(EnkiMissions, AreCheckedWithoutARobot) {
  std::vector<std::string> names{"enki_pioneer"};
  if (std::filesystem::exists(std::string(CAIRN_BINARY_DIR) + "/lib/cairn/ros2_robot.so")) names.push_back("enki_ros2");
  for (const std::string& name : names) {
    const Finished finished = run_cairn({"mission", "check", source_folder() + "/config/missions/" + name + ".yaml"});
    EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  }
}

}  // namespace
}  // namespace cairn::testing_program
