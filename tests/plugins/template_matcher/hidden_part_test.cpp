#include "plugins/template_matcher/hidden_part.hpp"

#include <gmock/gmock.h>

#include "plugins/template_matcher/template_matcher.hpp"
#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

constexpr int kWallCells = 28;
constexpr int kGapCells = 8;

void fill(OccupancyGrid& grid, const CellBox& box, int log_odds) {
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) grid.set_log_odds({x, y}, static_cast<LogOdds>(log_odds));
}

// A square about (0, 0), free floor round it; above it a wall of so many cells, and nothing known behind the square.
OccupancyGrid square_before(int wall_cells) {
  OccupancyGrid grid(0.05);
  const Point at = grid.centre_of({0, 0});
  paint(grid, square_shape().contour, {at.x(), at.y(), 0.0}, {{-40, -25}, {41, 6 + kGapCells}});
  const int wall_y = 6 + kGapCells;
  fill(grid, {{-wall_cells / 2, wall_y}, {wall_cells / 2 + 1, wall_y + 2}}, 1024);
  fill(grid, {{-6, 7}, {7, wall_y}}, 0);
  return grid;
}

struct OfASquare : testing::Test {
  [[nodiscard]] LandmarkTemplate seen_in(const OccupancyGrid& grid) const {
    return HiddenParts(set.templates, kWallCells).seen_part(grid, index, {0, 0});
  }
  [[nodiscard]] const LandmarkTemplate& whole() const { return set.templates[index]; }
  TemplateSet set = paper_set();
  std::size_t index = static_cast<std::size_t>(std::ranges::find(set.templates, "square", &LandmarkTemplate::category) -
                                               set.templates.begin());
};

using HiddenPart = OfASquare;

TEST_F(HiddenPart, IsTheSideTowardsAWallThatNothingIsKnownBefore) {
  const LandmarkTemplate seen = seen_in(square_before(60));
  EXPECT_LT(seen.cells.size(), whole().cells.size());
  EXPECT_GT(seen.cells.size(), whole().cells.size() / 2);
  const auto is_in_front = [](const TemplateCell& cell) { return cell.offset.y <= 0; };
  EXPECT_EQ(std::ranges::count_if(seen.cells, is_in_front), std::ranges::count_if(whole().cells, is_in_front));
  EXPECT_TRUE(std::ranges::none_of(seen.cells,
                                   [](const TemplateCell& cell) { return cell.offset.y > std::abs(cell.offset.x); }));
}

TEST_F(HiddenPart, IsNoneOfAThingThatStandsFree) {
  OccupancyGrid grid(0.05);
  const Point at = grid.centre_of({0, 0});
  paint(grid, square_shape().contour, {at.x(), at.y(), 0.0}, {{-40, -40}, {41, 41}});
  EXPECT_EQ(seen_in(grid).cells, whole().cells);
}

TEST_F(HiddenPart, IsNoneWhereTheGapIsSeen) {
  OccupancyGrid grid = square_before(60);
  fill(grid, {{-6, 8}, {7, 6 + kGapCells}}, -1024);
  EXPECT_EQ(seen_in(grid).cells, whole().cells);
}

TEST_F(HiddenPart, IsNoneBeforeWhatIsNoLongerThanFurniture) {
  EXPECT_EQ(seen_in(square_before(16)).cells, whole().cells);
}

TEST_F(HiddenPart, IsNoneWhereHardlyAnythingIsLeft) {
  OccupancyGrid grid = square_before(60);
  fill(grid, {{-20, -5}, {-6, 14}}, 0);
  fill(grid, {{7, -5}, {20, 14}}, 0);
  EXPECT_EQ(seen_in(grid).cells, whole().cells);
}

// What the echoes of its corners make of the gap behind it.
OccupancyGrid closed_gap() {
  OccupancyGrid grid = square_before(60);
  fill(grid, {{-6, 3}, {7, 6 + kGapCells}}, 0);
  fill(grid, {{-7, 3}, {-4, 6 + kGapCells}}, 1024);
  fill(grid, {{5, 3}, {8, 6 + kGapCells}}, 1024);
  return grid;
}

std::optional<Detection> best_detection(double hidden_degree) {
  const OccupancyGrid grid = closed_gap();
  Config config;
  config.hidden_above = 0.5;  // the whole outline fits to 0.52
  config.hidden_degree = hidden_degree;
  TemplateMatcher matcher(config, std::make_shared<TemplateSet>(paper_set()));
  std::optional<Detection> best;
  for (const Matching& m : matcher.detect(grid, everything_in(grid.bounds()), {}).matchings)
    if (m.detection && (!best || m.detection->degree > best->degree)) best = m.detection;
  return best;
}

TEST(HiddenDegree, MakesALandmarkBeforeAWallKnown) {
  EXPECT_FALSE(best_detection(0.0));
  const std::optional<Detection> found = best_detection(Config().hidden_degree);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->category, "square");
  EXPECT_LT((found->T_map_landmark.position() - OccupancyGrid(0.05).centre_of({0, 0})).norm(), 0.06);
}

}  // namespace
}  // namespace cairn::template_matcher
