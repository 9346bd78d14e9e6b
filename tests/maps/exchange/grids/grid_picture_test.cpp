#include "maps/exchange/grids/grid_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cairn {
namespace {

OccupancyGrid random_grid(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  OccupancyGrid grid(0.05);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      grid.set_log_odds({x - 3, y + 2}, static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024));
  return grid;
}

// Many samples a pixel instead of areas.
double sampled(const OccupancyGrid& grid, int column, int row, double px_per_cell) {
  constexpr int kSamples = 60;
  double sum = 0.0;
  int inside = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int k = 0; k < kSamples; ++k) {
      const int x = static_cast<int>((column + (i + 0.5) / kSamples) / px_per_cell);
      const int y = static_cast<int>((row + (k + 0.5) / kSamples) / px_per_cell);
      const CellBox box = grid.bounds();
      if (x >= box.width() || y >= box.height()) continue;
      sum += grid.ol({box.min.x + x, box.max.y - 1 - y});
      ++inside;
    }
  return 255.0 - sum / inside;
}

TEST(GridPicture, APixelIsTheMeanOfWhatItCovers) {
  const OccupancyGrid grid = random_grid(13, 7, 1);
  for (const double scale : {1.0, 2.0, 3.0, 0.5, 0.25, 0.3, 1.7, 0.01}) {
    const GreyPicture picture = grid_picture_of(grid, scale);
    EXPECT_EQ(picture.width, std::max(1.0, std::ceil(13 * scale))) << scale;
    EXPECT_EQ(picture.height, std::max(1.0, std::ceil(7 * scale))) << scale;
    for (int row = 0; row < picture.height; ++row)
      for (int column = 0; column < picture.width; ++column)
        ASSERT_NEAR(picture.grey[static_cast<std::size_t>(row * picture.width + column)],
                    sampled(grid, column, row, scale), scale == std::floor(scale) ? 0.0 : 6.0)
            << scale << " at " << column << "," << row;
  }
}

TEST(GridPicture, UnknownIsGreyAndTheTopRowIsTheHighest) {
  OccupancyGrid grid(0.1);
  grid.set_log_odds({0, 0}, -1024);
  grid.set_log_odds({1, 1}, 1024);
  EXPECT_EQ(grid_picture_of(grid, 1.0).grey, (std::vector<std::uint8_t>{128, 5, 251, 128}));
}

TEST(GridPicture, WhatIsTooLargeOrNoScaleIsRefused) {
  const OccupancyGrid grid = random_grid(200, 100, 2);
  const auto refusal = [&](double scale) -> std::string {
    try {
      static_cast<void>(grid_picture_of(grid, scale));
    } catch (const std::invalid_argument& refused) {
      return refused.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(100.0),
            "a scale of 100 makes 20000 x 10000 pixels of 200 x 100 cells, possible are 65536 a side and 67108864 in "
            "all");
  EXPECT_EQ(refusal(0.0), "a scale must be a finite number above 0, is 0");
  EXPECT_EQ(refusal(std::nan("")), "a scale must be a finite number above 0, is nan");
  EXPECT_TRUE(refusal(1e300).starts_with("a scale of 1e+300 makes 1000000000 x"));
  EXPECT_THROW(static_cast<void>(grid_picture_of(OccupancyGrid(0.1), 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace cairn
