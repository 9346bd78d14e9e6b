#include "plugins/template_matcher/gradient_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

TEST(GradientField, PointsFromFreeToOccupied) {
  const OccupancyGrid grid = grid_of({"..##",  //
                                      "..##",  //
                                      "..##"});
  const GradientField field(grid, {{1, 1}, {2, 2}});
  EXPECT_EQ(*field.x_from({1, 1}), 4.0F * (ol_of(1024) - ol_of(-1024)));
  EXPECT_EQ(*field.y_from({1, 1}), 0.0F);
}

TEST(GradientField, CountsYUpwards) {
  const OccupancyGrid grid = grid_of({"###",  //
                                      "...",  //
                                      "..."});
  const GradientField field(grid, {{1, 1}, {2, 2}});
  EXPECT_GT(*field.y_from({1, 1}), 0.0F);
}

TEST(GradientField, IsFlatWhereNothingIsKnown) {
  const OccupancyGrid grid(0.05);
  const GradientField field(grid, {{-3, -3}, {4, 4}});
  for (int y = -3; y < 4; ++y) {
    for (int x = -3; x < 4; ++x) {
      EXPECT_EQ(*field.x_from({x, y}), 0.0F);
      EXPECT_EQ(*field.y_from({x, y}), 0.0F);
    }
  }
}

TEST(GradientField, EqualsTheSobelOperatorWrittenOut) {
  OccupancyGrid grid(0.05);
  std::mt19937_64 random(3);
  for (int y = -8; y < 8; ++y) {
    for (int x = -8; x < 8; ++x) {
      grid.set_log_odds({x, y}, static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024));
    }
  }
  const GradientField field(grid, {{-9, -9}, {9, 9}});
  for (int y = -9; y < 9; ++y) {
    for (int x = -9; x < 9; ++x) {
      int gradient_x = 0;
      int gradient_y = 0;
      for (int d = -1; d <= 1; ++d) {
        const int weight = d == 0 ? 2 : 1;
        gradient_x += weight * (grid.ol({x + 1, y + d}) - grid.ol({x - 1, y + d}));
        gradient_y += weight * (grid.ol({x + d, y + 1}) - grid.ol({x + d, y - 1}));
      }
      ASSERT_EQ(*field.x_from({x, y}), static_cast<float>(gradient_x)) << x << ", " << y;
      ASSERT_EQ(*field.y_from({x, y}), static_cast<float>(gradient_y)) << x << ", " << y;
    }
  }
}

}  // namespace
}  // namespace cairn::template_matcher
