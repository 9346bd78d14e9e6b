#include "plugins/template_matcher/region.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

using ::testing::ElementsAre;

// A coarse grid of one cell a character: '#' stands for OL2 = 250, '.' for 4.
CoarseGrid coarse_of(const std::vector<std::string>& rows) {
  const OccupancyGrid grid = grid_of(rows);
  CoarseGrid coarse(1, 2.0);
  coarse.rebuild(grid);
  return coarse;
}

// The region in the frame of the drawing: 'o' a cell of it, 'T' the trigger.
std::vector<std::string> region_in(const std::vector<std::string>& rows, Cell trigger, const RegionReach& reach) {
  const int height = static_cast<int>(rows.size());
  std::vector<std::string> drawing(rows.size(), std::string(rows.front().size(), ' '));
  for (const Cell c : grow_region(coarse_of(rows), trigger, reach, 140.0)) {
    if (c.x < 0 || c.y < 0 || c.y >= height || c.x >= static_cast<int>(rows.front().size())) continue;
    drawing[static_cast<std::size_t>(height - 1 - c.y)][static_cast<std::size_t>(c.x)] = c == trigger ? 'T' : 'o';
  }
  return drawing;
}

TEST(RegionReach, FollowsThePapersBounds) {
  // n l = 0.25 m: 1 + floor(0.5 / 0.5) and 1 + floor(0.7 / 0.25) are the bounds the distance stays below.
  const RegionReach reach = RegionReach::of(0.5, 0.7, 0.25);
  EXPECT_EQ(reach.start, 1);
  EXPECT_EQ(reach.most, 2);
}

TEST(RegionReach, IsNotCutByRoundingOfWholeRatios) {
  EXPECT_EQ(RegionReach::of(0.6, 0.6, 0.3).start, 1);
  EXPECT_EQ(RegionReach::of(0.1, 0.7, 0.1).most, 7);
}

TEST(RegionReach, LooksBesideTheOccupiedCellsOnlyForShapesWithAnOpenCentre) {
  const auto post = [](double x) { return std::vector<Point>{{x, 0.0}, {x + 0.2, 0.0}, {x + 0.2, 0.2}, {x, 0.2}}; };
  TemplateSet set;
  set.shapes = {{"box", Contour::polygon(post(0.0))}};
  EXPECT_EQ(RegionReach::of(set, 0.25).open, 0);
  // The posts begin 0.45 m from the middle.
  set.shapes.push_back({"door", Contour::parts({post(0.0), post(1.1)})});
  EXPECT_EQ(RegionReach::of(set, 0.25).open, 2);
}

TEST(GrowRegion, IsWidenedForShapesWithAnOpenCentre) {
  EXPECT_THAT(region_in({".......",  //
                         ".......",  //
                         "...##..",  //
                         ".......",  //
                         "......."},
                        {3, 2}, {0, 1, 1}),
              ElementsAre("       ",  //
                          "  oooo ",  //
                          "  oToo ",  //
                          "  oooo ",  //
                          "       "));
}

TEST(GrowRegion, IsTheSmallestNeighbourhoodWhereNothingRisesAround) {
  EXPECT_THAT(region_in({".......",  //
                         ".......",  //
                         ".......",  //
                         "...#...",  //
                         ".......",  //
                         ".......",  //
                         "......."},
                        {3, 3}, {1, 3}),
              ElementsAre("       ",  //
                          "       ",  //
                          "  ooo  ",  //
                          "  oTo  ",  //
                          "  ooo  ",  //
                          "       ",  //
                          "       "));
}

TEST(GrowRegion, FollowsPromisingCellsAlsoDiagonally) {
  EXPECT_THAT(region_in({".......",  //
                         "#......",  //
                         ".#.....",  //
                         "...#...",  //
                         ".....#.",  //
                         "......#",  //
                         "....#.."},
                        {3, 3}, {1, 3}),
              ElementsAre("       ",  //
                          "o      ",  //
                          " oooo  ",  //
                          "  oTo  ",  //
                          "  oooo ",  //
                          "      o",  //
                          "       "));
}

TEST(GrowRegion, LeavesOutPromisingCellsThatNothingJoinsToIt) {
  EXPECT_THAT(region_in({"#......",  //
                         ".......",  //
                         ".......",  //
                         "...#...",  //
                         ".......",  //
                         "......#",  //
                         "......#"},
                        {3, 3}, {1, 3}),
              ElementsAre("       ",  //
                          "       ",  //
                          "  ooo  ",  //
                          "  oTo  ",  //
                          "  ooo  ",  //
                          "       ",  //
                          "       "));
}

TEST(GrowRegion, StopsAtTheLargestNeighbourhood) {
  EXPECT_THAT(region_in({".......",  //
                         ".......",  //
                         "#######",  //
                         ".......",  //
                         "......."},
                        {3, 2}, {1, 2}),
              ElementsAre("       ",  //
                          "  ooo  ",  //
                          " ooToo ",  //
                          "  ooo  ",  //
                          "       "));
}

TEST(GrowRegion, ReachesOverTheGridsEdgeOnlyWithTheSmallestNeighbourhood) {
  const std::vector<std::string> rows = {"##",  //
                                         "##"};
  const std::vector<Cell> region = grow_region(coarse_of(rows), {0, 0}, {1, 3}, 100.0);
  EXPECT_THAT(region, ElementsAre(Cell{-1, -1}, Cell{0, -1}, Cell{1, -1}, Cell{-1, 0}, Cell{0, 0}, Cell{1, 0},
                                  Cell{-1, 1}, Cell{0, 1}, Cell{1, 1}));
}

TEST(FineSpans, CoverTheCellsBelowRowByRowAndJoinNeighbours) {
  const CoarseGrid coarse(2, 2.0);
  // Coarse cells  . A
  //               B C  with B at (-1, 0).
  const std::vector<CellSpan> spans = fine_spans(coarse, {{-1, 0}, {0, 0}, {0, 1}});
  EXPECT_THAT(spans, ElementsAre(CellSpan{0, -2, 2}, CellSpan{1, -2, 2}, CellSpan{2, 0, 2}, CellSpan{3, 0, 2}));
}

TEST(FineSpans, KeepApartWhatDoesNotTouch) {
  const CoarseGrid coarse(2, 2.0);
  EXPECT_THAT(fine_spans(coarse, {{0, 0}, {2, 0}}),
              ElementsAre(CellSpan{0, 0, 2}, CellSpan{0, 4, 6}, CellSpan{1, 0, 2}, CellSpan{1, 4, 6}));
}

}  // namespace
}  // namespace cairn::template_matcher
