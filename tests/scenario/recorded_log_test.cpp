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

}  // namespace
}  // namespace cairn::testing_program
