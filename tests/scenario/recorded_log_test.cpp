#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "maps/map_store.hpp"
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

}  // namespace
}  // namespace cairn::testing_program
