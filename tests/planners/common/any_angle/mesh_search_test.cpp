#include "planners/common/any_angle/mesh_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "maps/geometry/segments.hpp"
#include "tests/planners/common/any_angle/plain_paths.hpp"

namespace cairn {
namespace {

using test::drawing_of;
using test::drawn_cells;
using test::OpenCells;
using test::random_cells;

// Compares with the oracle; what is wrong, or empty.
std::string fault_of(const OpenCells& cells, const CellMesh& mesh, const Point& from, const Point& to) {
  const MeshPath path = shortest_path(mesh, from, to);
  const double wanted = test::plain_shortest_length(cells, from, to);
  if (path.points.empty()) return std::isinf(wanted) ? "" : "no path, though there is one of " + std::to_string(wanted);
  if (std::abs(path.length - wanted) > 1e-9)
    return "length " + std::to_string(path.length) + ", the shortest is " + std::to_string(wanted);
  if (std::abs(length_of(path.points) - path.length) > 1e-9) return "the points are as long as something else";
  if (path.points.front() != from || path.points.back() != to) return "its ends are elsewhere";
  for (std::size_t i = 1; i < path.points.size(); ++i)
    if (!test::sees(cells, path.points[i - 1], path.points[i])) return "segment " + std::to_string(i) + " is blocked";
  return {};
}

void expect_shortest(const std::string& drawing, const Point& from, const Point& to) {
  const OpenCells cells = drawn_cells(drawing);
  const CellMesh mesh(cells.box, cells.open);
  EXPECT_EQ(fault_of(cells, mesh, from, to), "") << drawing_of(cells, shortest_path(mesh, from, to).points);
}

TEST(MeshSearch, GoesStraightWhereItCan) {
  const OpenCells cells = drawn_cells("....\n....\n");
  const MeshPath path = shortest_path(CellMesh(cells.box, cells.open), {0.5, 0.5}, {3.5, 1.5});
  EXPECT_EQ(path.points, (std::vector<Point>{{0.5, 0.5}, {3.5, 1.5}}));
}

TEST(MeshSearch, TurnsRoundABoxAtItsCorner) {
  expect_shortest(
      ".....\n"
      ".###.\n"
      ".###.\n"
      ".....\n",
      {0.5, 0.5}, {4.5, 3.5});
}

TEST(MeshSearch, HugsAWallBetweenTwoOpenings) {
  expect_shortest(
      "...........\n"
      "##.#####.##\n"
      "...........\n",
      {2.5, 0.5}, {8.5, 0.5});
  expect_shortest(
      "...........\n"
      "##.#####.##\n"
      "###########\n",
      {2.5, 1.5}, {8.5, 1.5});
}

TEST(MeshSearch, DoesNotSlipBetweenClosedCellsThatMeetAtACorner) {
  const OpenCells cells = drawn_cells(
      ".#\n"
      "#.\n");
  const MeshPath path = shortest_path(CellMesh(cells.box, cells.open), {0.5, 1.5}, {1.5, 0.5});
  EXPECT_TRUE(path.points.empty());
  expect_shortest(
      "....\n"
      ".#..\n"
      "..#.\n"
      "....\n",
      {0.5, 0.5}, {3.5, 3.5});
}

TEST(MeshSearch, EndsInClosedCellsOrOtherPartsHaveNoPath) {
  const OpenCells cells = drawn_cells("..#..\n..#..\n");
  const CellMesh mesh(cells.box, cells.open);
  EXPECT_TRUE(shortest_path(mesh, {0.5, 0.5}, {2.5, 0.5}).points.empty());
  EXPECT_TRUE(shortest_path(mesh, {2.5, 0.5}, {0.5, 0.5}).points.empty());
  EXPECT_TRUE(shortest_path(mesh, {0.5, 0.5}, {4.5, 0.5}).points.empty());
  EXPECT_TRUE(shortest_path(mesh, {0.5, 0.5}, {99.5, 0.5}).points.empty());
}

TEST(MeshSearch, StopsWhenAsked) {
  std::mt19937_64 random(9);
  const OpenCells cells = random_cells(random, 300, 300, 0.3);
  const CellMesh mesh(cells.box, cells.open);
  Point ends[2];
  for (int i = 0; i < 2; ++i) {
    Cell at{i == 0 ? 0 : 299, 150};
    while (!cells.is_open(at.x, at.y) ||
           mesh.part_of(mesh.rectangle_of(at)) != mesh.part_of(mesh.rectangle_of({150, 150})))
      at.y += 1;
    ends[i] = {at.x + 0.5, at.y + 0.5};
  }
  ASSERT_FALSE(shortest_path(mesh, ends[0], ends[1]).points.empty());
  const MeshPath path = shortest_path(mesh, ends[0], ends[1], [] { return true; });
  EXPECT_TRUE(path.interrupted);
  EXPECT_TRUE(path.points.empty());
}

class RandomCells : public testing::TestWithParam<double> {};

TEST_P(RandomCells, HaveTheOraclesLength) {
  std::mt19937_64 random(11 + std::llround(100 * GetParam()));
  for (int round = 0; round < 60; ++round) {
    const OpenCells cells = random_cells(random, 13, 11, GetParam());
    const CellMesh mesh(cells.box, cells.open);
    for (int pair = 0; pair < 6; ++pair) {
      const auto somewhere = [&] {
        return Point(0.5 + static_cast<int>(random() % 13), 0.5 + static_cast<int>(random() % 11));
      };
      const Point from = somewhere();
      const Point to = somewhere();
      if (!cells.is_open(static_cast<int>(from.x()), static_cast<int>(from.y()))) continue;
      if (!cells.is_open(static_cast<int>(to.x()), static_cast<int>(to.y()))) continue;
      ASSERT_EQ(fault_of(cells, mesh, from, to), "")
          << drawing_of(cells, {from, to}) << drawing_of(cells, shortest_path(mesh, from, to).points);
    }
  }
}

// Where several rectangles meet, too.
TEST_P(RandomCells, HaveTheOraclesLengthFromLatticeLinesAndPoints) {
  std::mt19937_64 random(23 + std::llround(100 * GetParam()));
  int found = 0;
  for (int round = 0; round < 60; ++round) {
    const OpenCells cells = random_cells(random, 13, 11, GetParam());
    const CellMesh mesh(cells.box, cells.open);
    for (int pair = 0; pair < 6; ++pair) {
      const auto somewhere = [&] {
        return Point(0.5 * static_cast<double>(1 + random() % 25), 0.5 * static_cast<double>(1 + random() % 21));
      };
      const auto is_in_the_open = [&](const Point& p) {
        for (const double x : {-0.25, 0.25})
          for (const double y : {-0.25, 0.25})
            if (!cells.is_open(static_cast<int>(p.x() + x), static_cast<int>(p.y() + y))) return false;
        return true;
      };
      const Point from = somewhere();
      const Point to = somewhere();
      if (!is_in_the_open(from) || !is_in_the_open(to)) continue;
      ++found;
      ASSERT_EQ(fault_of(cells, mesh, from, to), "")
          << drawing_of(cells, {from, to}) << drawing_of(cells, shortest_path(mesh, from, to).points);
    }
  }
  EXPECT_GT(found, 20);
}

INSTANTIATE_TEST_SUITE_P(Densities, RandomCells, testing::Values(0.05, 0.12, 0.2, 0.3, 0.4));

}  // namespace
}  // namespace cairn
