// A saved map of which only a part is read.

#include "tests/maps/store/store_fixture.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;

SavedMap map_of_many_tiles() {
  SavedMap map = small_map();
  std::mt19937_64 random(3);
  for (int i = 0; i < 4000; ++i)
    map.grid.set_log_odds({static_cast<int>(random() % 500) - 200, static_cast<int>(random() % 300) - 100},
                          static_cast<LogOdds>(static_cast<int>(random() % 2000) - 1000));
  return map;
}

TEST_F(MapStore, WithoutCellsAllElseIsThere) {
  const SavedMap map = map_of_many_tiles();
  save_map(file(), map);
  SavedMap expected = map;
  expected.grid = OccupancyGrid(map.grid.cell_m(), map.grid.clamp_nat(), map.grid.origin_m());
  expected.grid.include(map.grid.bounds());
  const MapFile opened(file());
  expect_equal(opened.without_cells(), expected);
  EXPECT_EQ(opened.lattice(), expected.grid);
}

TEST_F(MapStore, AnyBoxOfCellsIsThatPartOfTheGrid) {
  const SavedMap map = map_of_many_tiles();
  save_map(file(), map);
  const MapFile opened(file());
  for (const CellBox& box : {map.grid.bounds(), CellBox{{-100, -30}, {65, 64}}, CellBox{{64, 64}, {128, 128}},
                             CellBox{{-1, -1}, {1, 1}}, CellBox{{-5000, 0}, {5000, 1}}, CellBox{{900, 0}, {950, 9}}})
    EXPECT_EQ(opened.grid_within(box), part_of(map.grid, box));
}

TEST_F(MapStore, WhatIsReadIsCheckedAndWhatIsNotIsNot) {
  save_map(file(), map_of_many_tiles());
  run_sql(file(), "UPDATE tiles SET log_odds = zeroblob(length(log_odds)) WHERE tx = 2 AND ty = 1");
  EXPECT_NO_THROW((void)MapFile(file()).grid_within({{0, 0}, {128, 64}}));
  try {
    (void)MapFile(file()).grid_within({{0, 0}, {129, 65}});
    FAIL() << "a damaged tile was read";
  } catch (const StoreError& error) {
    EXPECT_THAT(error.what(), HasSubstr(file().string() + ": table tiles: tile (2, 1) is damaged"));
  }
  run_sql(file(), "UPDATE landmarks SET degree = 0.5");
  EXPECT_THROW(MapFile{file()}, StoreError);
  EXPECT_THROW(MapFile{file().parent_path() / "none.cairn"}, StoreError);
}

TEST_F(MapStore, AnOpenFileKeepsItsContentWhileAnotherTakesItsPlace) {
  const SavedMap map = map_of_many_tiles();
  save_map(file(), map);
  const MapFile opened(file());
  save_map(file(), small_map());
  EXPECT_EQ(opened.grid_within(map.grid.bounds()), map.grid);
}

}  // namespace
}  // namespace cairn
