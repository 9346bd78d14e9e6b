#include "maps/exchange/grids/map_server.hpp"

#include <gtest/gtest.h>

#include "maps/base/source_text.hpp"

namespace cairn {
namespace {

// As drawn, the top row first; the letters by the thresholds of the grid, A for the log-odds' clamp.
std::string drawn(const OccupancyGrid& grid) {
  std::string text;
  const CellBox box = grid.bounds();
  for (int y = box.max.y - 1; y >= box.min.y; --y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const CellState state = grid.state({x, y});
      text += state == CellState::free ? '.' : state == CellState::occupied ? '#' : '?';
    }
    text += '\n';
  }
  return text;
}

// '#' black, '.' white, '?' map_server's grey for unknown, '+' and '-' darker and lighter ones.
GreyPicture picture_of(const std::vector<std::string>& rows) {
  GreyPicture picture{static_cast<int>(rows.front().size()), static_cast<int>(rows.size()), {}, {}};
  for (const std::string& row : rows)
    for (const char c : row)
      picture.grey.push_back(c == '#' ? 0 : c == '.' ? 254 : c == '?' ? 205 : c == '+' ? 100 : 180);
  return picture;
}

ImportedGrid read(const GreyPicture& picture, const MapServerSettings& settings = {}) {
  return grid_of(picture, settings, "map.pgm");
}

// Log-odds of one pixel of that grey, as a share of the clamp.
double share(int grey, const MapServerSettings& settings, int alpha = 255) {
  const OccupancyGrid grid =
      read({1, 1, {static_cast<std::uint8_t>(grey)}, {static_cast<std::uint8_t>(alpha)}}, settings).grid;
  return static_cast<double>(grid.log_odds({0, 0})) / grid.clamp_quanta();
}
double probability(int grey, const MapServerSettings& settings) {
  return probability_of(read({1, 1, {static_cast<std::uint8_t>(grey)}, {}}, settings).grid.log_odds({0, 0}));
}

TEST(MapServer, TheTopRowOfThePictureIsTheHighest) {
  const ImportedGrid imported = read(picture_of({"##?", "#.?", "..-"}));
  EXPECT_EQ(drawn(imported.grid), "##?\n#.?\n..?\n");
  EXPECT_TRUE(imported.warnings.empty());
}

TEST(MapServer, TheOriginIsTheLowerLeftCorner) {
  MapServerSettings settings;
  settings.resolution_m = 0.1;
  settings.origin = {-2.0, 3.0, 0.0};
  const OccupancyGrid grid = read(picture_of({"..", "#."}), settings).grid;
  EXPECT_EQ(grid.state(grid.cell_at({-1.95, 3.05})), CellState::occupied);
  EXPECT_EQ(grid.origin_m(), Point(-2.0, 3.0));
  EXPECT_EQ(grid.bounds(), (CellBox{{0, 0}, {2, 2}}));
}

TEST(MapServer, TrinaryIsSureOrUnknownAtTheVeryThresholds) {
  MapServerSettings settings;            // 0.65, 0.196
  EXPECT_EQ(share(205, settings), 0.0);  // p = 0.196078
  EXPECT_EQ(share(206, settings), -1.0);
  EXPECT_EQ(share(90, settings), 0.0);  // p = 0.647
  EXPECT_EQ(share(89, settings), 1.0);  // p = 0.651
  settings.free_thresh = settings.occupied_thresh = 1.0 - 100 / 255.0;
  EXPECT_EQ(share(100, settings), -1.0);  // both hold: free is asked last
  EXPECT_EQ(share(99, settings), 1.0);
}

TEST(MapServer, NegateTurnsBlackAndWhite) {
  MapServerSettings settings;
  settings.negate = true;
  EXPECT_EQ(share(255, settings), 1.0);
  EXPECT_EQ(share(0, settings), -1.0);
  EXPECT_EQ(share(150, settings), 0.0);
}

TEST(MapServer, ScaleGivesWhatLiesBetweenItsProbability) {
  MapServerSettings settings;
  settings.mode = MapServerMode::scale;
  settings.occupied_thresh = 0.8;
  settings.free_thresh = 0.2;
  EXPECT_EQ(share(0, settings), 1.0);
  EXPECT_EQ(share(255, settings), -1.0);
  EXPECT_NEAR(probability(102, settings), 0.67, 0.001);  // p = 0.6, so 66.7 % of the way
  EXPECT_NEAR(probability(127, settings), 0.50, 0.001);
  EXPECT_NEAR(probability(178, settings), 0.17, 0.001);
}

TEST(MapServer, RawIsPercentWhateverNegateAndAlphaSay) {
  MapServerSettings settings;
  settings.mode = MapServerMode::raw;
  settings.negate = true;
  EXPECT_EQ(share(0, settings, 0), -1.0);
  EXPECT_EQ(share(100, settings, 7), 1.0);
  EXPECT_EQ(share(50, settings), 0.0);
  EXPECT_NEAR(probability(80, settings), 0.8, 0.001);
  EXPECT_EQ(share(101, settings), 0.0);
  EXPECT_EQ(share(255, settings), 0.0);
}

TEST(MapServer, WhatIsNotOpaqueIsUnknown) {
  MapServerSettings settings;
  for (const MapServerMode mode : {MapServerMode::trinary, MapServerMode::scale}) {
    settings.mode = mode;
    EXPECT_EQ(share(0, settings, 254), 0.0);
    EXPECT_EQ(share(255, settings, 0), 0.0);
    EXPECT_EQ(share(0, settings, 255), 1.0);
  }
}

TEST(MapServer, ReportsWhenTheGreyOfUnknownCountsAsFree) {
  MapServerSettings settings;
  settings.free_thresh = 0.25;
  const ImportedGrid imported = read(picture_of({".?#"}), settings);
  EXPECT_EQ(drawn(imported.grid), "..#\n");
  EXPECT_EQ(imported.warnings, std::vector<std::string>{
                                   "grey 205, by which map_server means unknown, counts as free by these thresholds"});
  EXPECT_TRUE(read(picture_of({".#"}), settings).warnings.empty());
}

TEST(MapServer, ARightAngleTurnsThePictureCellByCell) {
  MapServerSettings settings;
  settings.resolution_m = 1.0;
  settings.origin = {10.0, 20.0, radians(90.0)};  // its x axis points up, its y axis to the left
  const ImportedGrid imported = read(picture_of({"#..", "??."}), settings);
  EXPECT_EQ(drawn(imported.grid), "..\n.?\n#?\n");
  EXPECT_EQ(imported.grid.cell_at({8.5, 20.5}), (Cell{0, 0}));
  EXPECT_EQ(imported.warnings, std::vector<std::string>{"the origin is turned by 90 deg: the picture was laid anew on "
                                                        "the map's axes, walls are up to a cell thicker"});
}

// Whatever the angle: a point that the picture says is occupied lies in an occupied cell, and what is free in the grid
// is free in the picture.
TEST(MapServer, ATurnedWallHasNoGaps) {
  const GreyPicture picture = picture_of({".........", ".........", "..#####..", ".........", "........."});
  for (int angle_deg = -175; angle_deg < 180; angle_deg += 5) {
    MapServerSettings settings;
    settings.resolution_m = 0.5;
    settings.origin = {3.0, -4.0, radians(angle_deg)};
    const OccupancyGrid grid = read(picture, settings).grid;
    for (double x = 2.05; x < 7.0; x += 0.1) {
      const Point p_map = settings.origin * Point(0.5 * x, 0.5 * 2.5);  // along the middle of the wall
      EXPECT_EQ(grid.state(grid.cell_at(p_map)), CellState::occupied) << angle_deg << " deg, " << x;
    }
    const Pose2 T_picture_map = inverse(settings.origin);
    const CellBox box = grid.bounds();
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x)
        if (grid.state({x, y}) == CellState::free) {
          const Point p_picture = T_picture_map * grid.centre_of({x, y}) / settings.resolution_m;
          ASSERT_TRUE((p_picture.array() > 0.0).all() && p_picture.x() < 9.0 && p_picture.y() < 5.0);
          EXPECT_FALSE(p_picture.x() > 2.0 && p_picture.x() < 7.0 && p_picture.y() > 2.0 && p_picture.y() < 3.0);
        }
  }
}

TEST(MapServer, AYawThatMovesNothingIsNone) {
  MapServerSettings settings;
  settings.origin.theta_rad = 1e-6;
  EXPECT_TRUE(read(picture_of({".#", "#."}), settings).warnings.empty());
}

}  // namespace
}  // namespace cairn
