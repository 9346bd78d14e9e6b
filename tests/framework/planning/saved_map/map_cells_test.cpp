#include "framework/planning/saved_map/map_cells.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace cairn {
namespace {

class MapCellsOfAFile : public testing::Test {
 protected:
  MapCellsOfAFile() {
    SavedMap map;
    map.grid = OccupancyGrid(0.1);
    for (int y = -300; y < 700; ++y)
      for (int x = -500; x < 600; ++x)
        map.grid.set_log_odds({x, y}, static_cast<LogOdds>((x * 7 + y * 13) % 5 == 0 ? 900 : -900));
    save_map(path_, map);
    whole_ = map.grid;
  }
  ~MapCellsOfAFile() override { std::filesystem::remove(path_); }

  const std::filesystem::path path_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_map_cells_" + std::to_string(getpid()) + ".cairn");
  OccupancyGrid whole_{0.1};
};

TEST_F(MapCellsOfAFile, ReadWhatIsRequiredAndAllInTheEnd) {
  const MapFile file(path_);
  OccupancyGrid grid = file.lattice();
  const MapCells cells(file, grid);
  EXPECT_EQ(grid.log_odds({0, 0}), 0);
  const CellBox box{{-40, 250}, {10, 270}};
  cells.require(box);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) EXPECT_EQ(grid.log_odds({x, y}), whole_.log_odds({x, y}));
  EXPECT_EQ(grid.log_odds({-450, -250}), 0) << "far away";
  cells.require(grid.bounds().grown(5000));
  EXPECT_TRUE(grid == whole_);
}

TEST_F(MapCellsOfAFile, WhatIsOutsideTheMapIsNotRead) {
  const MapFile file(path_);
  OccupancyGrid grid = file.lattice();
  const MapCells cells(file, grid);
  cells.require({{5000, 5000}, {5100, 5100}});
  cells.require({});
  EXPECT_EQ(grid.bounds(), whole_.bounds());
}

}  // namespace
}  // namespace cairn
