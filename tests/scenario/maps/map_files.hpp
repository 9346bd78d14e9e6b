// A folder of saved maps, and `cairn map ...` run on them.
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {

class MapFiles : public testing::Test {
 protected:
  explicit MapFiles(const std::string& folder) : folder_(fresh_folder(folder)) {}

  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] SavedMap map(const std::string& name) const { return load_map(file(name)); }
  void save(const std::string& name, const SavedMap& map) const { save_map(file(name), map); }

  // Runs `cairn map ...`, expects exit status 2 and gives standard error.
  static std::string refused(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "map");
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, 2) << finished.err;
    EXPECT_EQ(finished.out, "");
    return finished.err;
  }
  static nlohmann::json done(std::vector<std::string> arguments, int exit_status = 0) {
    arguments.insert(arguments.begin(), "map");
    arguments.emplace_back("--json");
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, exit_status) << finished.err;
    return nlohmann::json::parse(finished.out, nullptr, false);
  }

  // '#' occupied, '.' free, '?' unknown, the top row first, cells of 0.05 m; one landmark, a square in the middle.
  static SavedMap drawn_map(const std::vector<std::string>& rows, const Point& origin_m) {
    SavedMap map;
    map.grid = OccupancyGrid(0.05, 4.0, origin_m);
    const int height = static_cast<int>(rows.size());
    const int width = static_cast<int>(rows.front().size());
    map.grid.include({{0, 0}, {width, height}});
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const char c = rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
        if (c != '?') map.grid.set_log_odds({x, y}, static_cast<LogOdds>(c == '#' ? 1024 : -1024));
      }
    Landmark landmark;
    landmark.category = "square";
    landmark.T_map_landmark = {origin_m.x() + 0.025 * width, origin_m.y() + 0.025 * height, 0.0};
    map.graph.add(landmark);
    return map;
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace cairn::testing_program
