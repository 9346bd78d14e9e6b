#include "planners/common/any_angle/cell_mesh.hpp"

#include <gtest/gtest.h>

#include <ctime>
#include <map>
#include <queue>
#include <set>

#include "tests/planners/common/any_angle/plain_paths.hpp"

namespace cairn {
namespace {

using test::drawn_cells;
using test::OpenCells;
using test::random_cells;

CellMesh mesh_of(const OpenCells& cells) {
  return {cells.box, cells.open};
}

// Cells that a point can go to from one cell, over shared sides.
std::set<Cell> flooded(const OpenCells& cells, Cell from) {
  std::set<Cell> reached{from};
  std::queue<Cell> queue({from});
  for (; !queue.empty(); queue.pop())
    for (const Cell step : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) {
      const Cell to = queue.front() + step;
      if (cells.is_open(to.x, to.y) && reached.insert(to).second) queue.push(to);
    }
  return reached;
}

TEST(CellMesh, AnOpenBoxIsOneRectangle) {
  const CellMesh mesh = mesh_of(drawn_cells("....\n....\n....\n", {-7, 3}));
  ASSERT_EQ(mesh.rectangles(), 1);
  EXPECT_EQ(mesh.rectangle(0), (CellBox{{-7, 3}, {-3, 6}}));
  EXPECT_TRUE(mesh.portals(0).empty());
  EXPECT_EQ(mesh.corners(), 0) << "the box's own corners point inwards";
}

TEST(CellMesh, ABoxWithoutCellsHasNothing) {
  const CellMesh mesh(CellBox{}, {});
  EXPECT_EQ(mesh.rectangles(), 0);
  EXPECT_EQ(mesh.rectangle_of({0, 0}), CellMesh::kNone);
}

TEST(CellMesh, RefusesMarksThatDoNotFitTheBox) {
  const std::vector<std::uint8_t> marks(5, 1);
  EXPECT_THROW(CellMesh({{0, 0}, {2, 3}}, marks), std::invalid_argument);
}

TEST(CellMesh, RectanglesCoverTheOpenCellsEachOnce) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 50; ++round) {
    const OpenCells cells = random_cells(random, 17, 13, 0.3);
    const CellMesh mesh = mesh_of(cells);
    std::int64_t area = 0;
    for (CellMesh::Index i = 0; i < mesh.rectangles(); ++i) {
      const CellBox& r = mesh.rectangle(i);
      area += std::int64_t{r.width()} * r.height();
      for (int y = r.min.y; y < r.max.y; ++y)
        for (int x = r.min.x; x < r.max.x; ++x) {
          EXPECT_TRUE(cells.is_open(x, y));
          EXPECT_EQ(mesh.rectangle_of({x, y}), i);
        }
    }
    EXPECT_EQ(area, std::count(cells.open.begin(), cells.open.end(), 1));
  }
}

TEST(CellMesh, PortalsAreSharedByBothSides) {
  std::mt19937_64 random(4);
  const OpenCells cells = random_cells(random, 25, 25, 0.25);
  const CellMesh mesh = mesh_of(cells);
  for (CellMesh::Index i = 0; i < mesh.rectangles(); ++i)
    for (const CellMesh::Portal& there : mesh.portals(i)) {
      int back = 0;
      for (const CellMesh::Portal& p : mesh.portals(there.to))
        back += int{p.to == i && p.low == there.low && p.high == there.high && p.block == there.block};
      EXPECT_EQ(back, 1) << "rectangle " << i << " to " << there.to;
      EXPECT_LT(there.low, there.high);
    }
}

TEST(CellMesh, PartsAreWhatFloodingReaches) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 30; ++round) {
    const OpenCells cells = random_cells(random, 15, 15, 0.42);
    const CellMesh mesh = mesh_of(cells);
    for (int y = 0; y < 15; y += 4)
      for (int x = 0; x < 15; x += 4) {
        if (!cells.is_open(x, y)) continue;
        const std::set<Cell> reached = flooded(cells, {x, y});
        for (int v = 0; v < 15; ++v)
          for (int u = 0; u < 15; ++u) {
            if (!cells.is_open(u, v)) continue;
            const bool together = mesh.part_of(mesh.rectangle_of({x, y})) == mesh.part_of(mesh.rectangle_of({u, v}));
            EXPECT_EQ(together, reached.contains({u, v}));
          }
      }
  }
}

// A corridor with a niche at every other cell: what is done for a niche must not grow with their number.
TEST(CellMesh, ALongRectangleWithManyNeighboursCostsWhatManyShortOnesCost) {
  const auto seconds_to_build = [](int corridors, int niches) {
    const int width = 2 * niches;
    OpenCells cells{{{0, 0}, {width, 3 * corridors}}, {}};
    for (int y = 0; y < 3 * corridors; ++y)
      for (int x = 0; x < width; ++x) cells.open.push_back(y % 3 == 0 || (y % 3 == 1 && x % 2 == 0) ? 1 : 0);
    const std::clock_t begin = std::clock();  // of the processor
    const CellMesh mesh = mesh_of(cells);
    EXPECT_EQ(mesh.rectangles(), corridors * (niches + 1));
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  };
  EXPECT_LT(seconds_to_build(1, 200'000), 10.0 * seconds_to_build(1000, 200) + 0.1);
}

TEST(CellMesh, BlocksLeaveOutDeadEnds) {
  // A corridor with two side rooms: the path from end to end passes neither.
  const CellMesh mesh =
      mesh_of(drawn_cells("...#...\n"
                          "#.###.#\n"
                          ".......\n"));
  const CellMesh::Index corridor = mesh.rectangle_of({0, 0});
  const auto marks = mesh.blocks_between(mesh.rectangle_of({0, 2}), corridor);
  for (const CellMesh::Portal& portal : mesh.portals(corridor)) {
    const bool left_room = portal.to == mesh.rectangle_of({1, 1});
    EXPECT_EQ(marks[static_cast<std::size_t>(portal.block)], left_room ? 1 : 0) << "portal at x " << portal.low;
  }
}

}  // namespace
}  // namespace cairn
