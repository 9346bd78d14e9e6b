#include "plugins/behaviours/lookouts/frontiers.hpp"

#include <gmock/gmock.h>

#include "tests/plugins/behaviours/ascii_grid.hpp"

namespace cairn::behaviours {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

FreeSpace space_of(const AsciiGrid& map) {
  return FreeSpace(map.grid, {map.at('R'), 0.2, 0.1}, {{map.at('R').x(), map.at('R').y(), 0.0}});
}

TEST(Frontiers, AreTheFreeCellsBesideUnknownOnesInGroups) {
  const AsciiGrid map(R"(
##########
#........
#..R.....
#........
#........
####  ####
)");
  const std::vector<CellGroup> groups = grouped(frontier_cells(space_of(map)), 1);
  ASSERT_THAT(groups, SizeIs(2));
  EXPECT_THAT(groups[0], ElementsAre(Cell{4, 1}, Cell{5, 1}));
  EXPECT_THAT(groups[1], ElementsAre(Cell{8, 1}, Cell{8, 2}, Cell{8, 3}, Cell{8, 4}));
}

TEST(Edges, AreTheOccupiedCellsBesideFreeOnes) {
  const AsciiGrid map(R"(
.....
.###.
.###R
.###.
.....
)");
  const FreeSpace space = space_of(map);
  EXPECT_THAT(edge_cells(space), SizeIs(8));
  EXPECT_FALSE(is_edge(space, {2, 2}));
}

TEST(Lookouts, AreTheCheapestPlacesWithinTheDistance) {
  const AsciiGrid map(R"(
....................
....................
....................
....................
.R.................#
....................
....................
....................
....................
)");
  const std::vector<std::optional<Cell>> found = lookouts(space_of(map), {{{19, 4}}}, 0.6);
  ASSERT_THAT(found, SizeIs(1));
  ASSERT_TRUE(found[0]);
  EXPECT_NEAR((map.grid.centre_of(*found[0]) - map.grid.centre_of({19, 4})).norm(), 0.6, 0.05);
  EXPECT_LT(found[0]->x, 19);
}

TEST(Lookouts, AreNoneWhereTheGroupIsOutOfReachOrHidden) {
  const AsciiGrid map(R"(
#####################
#.........#.........#
#.........#.........#
#.........#.........#
#.R.......#.........#
#.........#.........#
#.........#.........#
#.........#.........#
#####################
)");
  // Seen from the other side of the wall only.
  EXPECT_THAT(lookouts(space_of(map), {{{20, 4}}, {{0, 4}}}, 0.6),
              ElementsAre(testing::Eq(std::nullopt), testing::Ne(std::nullopt)));
}

TEST(Grouped, JoinsCellsOverGapsUpToTheReach) {
  const std::vector<Cell> cells{{0, 0}, {2, 0}, {5, 0}, {6, 1}};
  EXPECT_THAT(grouped(cells, 1), SizeIs(3));
  EXPECT_THAT(grouped(cells, 2), SizeIs(2));
  EXPECT_THAT(grouped(cells, 3), SizeIs(1));
  EXPECT_THAT(grouped({}, 1), IsEmpty());
}

}  // namespace
}  // namespace cairn::behaviours
