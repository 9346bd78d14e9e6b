#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

std::filesystem::path data_folder() {
  const char* folder = std::getenv("CAIRN_DATA");
  return folder != nullptr ? std::filesystem::path(folder)
                           : std::filesystem::path(source_folder()).parent_path() / "shared" / "data";
}

TEST(RecordedLog, ARealSonarRobotsLogBecomesAMapOfBothCorridors) {
  if (!std::filesystem::exists(data_folder() / "sonar" / "corridor8")) GTEST_SKIP() << "no data folder: corridor8";
  const auto out = fresh_folder("corridor8");
  const Finished run =
      run_cairn({"run", source_folder() + "/config/missions/corridor8.yaml", "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err;
  const auto summary = nlohmann::json::parse(run.out);
  EXPECT_EQ(summary["outcome"], "done");
  EXPECT_EQ(summary["readings"], 413 * 8);
  EXPECT_TRUE(std::filesystem::exists(out / "map.png"));
  EXPECT_TRUE(std::filesystem::exists(out / "report.json"));
  // The robot drove some 14 m along one corridor and turned into another: the map is larger than a room.
  const SavedMap map = load_map(summary["map"].get<std::string>());
  const double cell_m = map.grid.cell_m();
  EXPECT_GT(map.grid.bounds().width() * cell_m, 8.0);
  EXPECT_GT(map.grid.bounds().height() * cell_m, 8.0);
  EXPECT_FALSE(map.driven_path.empty());
}

TEST(RecordedLog, LaserLogsBecomeMapsOfTheirBuildings) {
  struct Log {
    std::string mission;
    int readings;
    double width_m, height_m;  // of what is not unknown, beams through windows and doors too
  };
  for (const Log& log : {Log{"intel", 910 * 180, 39.0, 36.0}, Log{"freiburg_079", 4791 * 360, 45.0, 16.5},
                         Log{"belgioioso", 395 * 361, 34.5, 92.0}}) {
    if (!std::filesystem::exists(data_folder() / "laser_carmen")) GTEST_SKIP() << "no data folder: laser_carmen";
    const auto out = fresh_folder(log.mission);
    const Finished run = run_cairn(
        {"run", source_folder() + "/config/missions/" + log.mission + ".yaml", "--out", out.string(), "--json"});
    ASSERT_EQ(run.exit_status, 0) << run.err;
    const auto summary = nlohmann::json::parse(run.out);
    EXPECT_EQ(summary["readings"], log.readings) << log.mission;
    const SavedMap map = load_map(summary["map"].get<std::string>());
    EXPECT_NEAR(map.grid.bounds().width() * map.grid.cell_m(), log.width_m, 1.0) << log.mission;
    EXPECT_NEAR(map.grid.bounds().height() * map.grid.cell_m(), log.height_m, 1.0) << log.mission;
  }
}

struct Surveyed {
  double x_m, y_m;
};

// Lines "L C x y radius", in millimetres.
std::vector<Surveyed> surveyed_cylinders(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<Surveyed> cylinders;
  std::string kind;
  std::string shape;
  for (double x = 0, y = 0, radius = 0; in >> kind >> shape >> x >> y >> radius;)
    cylinders.push_back({0.001 * x, 0.001 * y});
  return cylinders;
}

TEST(RecordedLog, SixRealCylindersAreFoundWhereTheyWereSurveyed) {
  const auto folder = data_folder() / "landmarks" / "lego_cylinders";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data folder: lego_cylinders";
  const auto out = fresh_folder("lego_cylinders");
  const Finished run =
      run_cairn({"run", source_folder() + "/config/missions/lego_cylinders.yaml", "--out", out.string(), "--json"});
  ASSERT_EQ(run.exit_status, 0) << run.err;
  const auto summary = nlohmann::json::parse(run.out);
  EXPECT_EQ(summary["readings"], 278 * 660);
  const std::vector<Surveyed> cylinders = surveyed_cylinders(folder / "robot_arena_landmarks.txt");
  ASSERT_EQ(cylinders.size(), 6U);
  EXPECT_EQ(summary["landmarks"].size(), 6U) << "none missing, none false";
  std::vector<double> errors_m;
  for (const Surveyed& cylinder : cylinders) {
    double nearest_m = 1e9;
    for (const auto& found : summary["landmarks"]) {
      nearest_m = std::min(
          nearest_m, std::hypot(found["x_m"].get<double>() - cylinder.x_m, found["y_m"].get<double>() - cylinder.y_m));
    }
    EXPECT_LT(nearest_m, 0.055) << "within its own radius, at " << cylinder.x_m << ", " << cylinder.y_m;
    errors_m.push_back(nearest_m);
  }
  std::sort(errors_m.begin(), errors_m.end());
  EXPECT_LE(0.5 * (errors_m[2] + errors_m[3]), 0.015) << "median";
}

}  // namespace
}  // namespace cairn::testing_program
