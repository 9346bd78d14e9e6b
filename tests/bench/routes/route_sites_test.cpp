// What routes are held against must itself be right: the checker of paths and the plain searches.

#include <gmock/gmock.h>

#include "tests/bench/routes/lazy_theta_star.hpp"
#include "tests/bench/routes/path_check.hpp"
#include "tests/planners/common/any_angle/plain_paths.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

PlainCells plain(const test::OpenCells& cells) {
  return {cells.box.width(), cells.box.height(), cells.open, {0.0, 0.0}, 1.0};
}

PlainCells drawn(const std::string& drawing) {
  return plain(test::drawn_cells(drawing));
}

std::string fault(const PlainCells& cells, const std::vector<Point>& path) {
  return fault_of_point_path(cells, path, path.front(), path.back());
}

TEST(PathCheck, TouchingACornerAndRunningAlongAWallAreAllowed) {
  const PlainCells cells = drawn(
      "....\n"
      ".#..\n"
      "....\n");
  EXPECT_THAT(fault(cells, {{0.5, 0.5}, {1.0, 2.0}, {2.0, 2.0}, {3.5, 0.5}}), IsEmpty());
  EXPECT_THAT(fault(cells, {{0.5, 0.5}, {2.5, 2.5}}), HasSubstr("enters the closed cell"));
}

TEST(PathCheck, NothingPassesBetweenTwoClosedCells) {
  EXPECT_THAT(fault(drawn(".#\n"
                          "#.\n"),
                    {{0.5, 0.5}, {1.0, 1.0}, {1.5, 1.5}}),
              HasSubstr("enters"));
  EXPECT_THAT(fault(drawn("#.\n"
                          ".#\n"),
                    {{0.5, 0.5}, {1.5, 1.5}}),
              HasSubstr("slips"));
  EXPECT_THAT(fault(drawn(".##.\n"
                          ".##.\n"),
                    {{0.5, 1.0}, {3.5, 1.0}}),
              HasSubstr("enters"));
}

TEST(PathCheck, EndsAreThoseAskedForAndInside) {
  const PlainCells cells = drawn("..\n");
  const std::vector<Point> path{{0.5, 0.5}, {1.5, 0.5}};
  EXPECT_THAT(fault_of_point_path(cells, path, {0.5, 0.5}, {1.5, 0.6}), HasSubstr("ends at"));
  EXPECT_THAT(fault_of_point_path(cells, path, {0.4, 0.5}, {1.5, 0.5}), HasSubstr("begins at"));
  EXPECT_THAT(fault_of_point_path(cells, {}, {0.5, 0.5}, {1.5, 0.5}), HasSubstr("empty"));
  EXPECT_THAT(fault(cells, {{0.5, 0.5}, {2.5, 0.5}}), HasSubstr("enters"));
  EXPECT_THAT(fault(cells, {{0.5, 0.5}, {NAN, 0.5}, {1.5, 0.5}}), HasSubstr("finite"));
}

TEST(PathCheck, ADiscKeepsItsRadiusFromEveryClosedCell) {
  PlainCells cells = drawn(
      "......\n"
      "...#..\n"
      "......\n"
      "......\n"
      "......\n");
  cells.cell_m = 0.5;
  cells.origin_m = {10.0, -1.0};
  const std::vector<Point> path{{10.75, -0.25}, {12.25, -0.25}};  // 0.75 m below the closed cell
  EXPECT_THAT(fault_of_disc_path(cells, path, path.front(), path.back(), 0.74), IsEmpty());
  EXPECT_THAT(fault_of_disc_path(cells, path, path.front(), path.back(), 0.76), HasSubstr("comes within 0.75"));
  EXPECT_DOUBLE_EQ(distance_to_closed_m(cells, path, 0.7), 0.7);
  EXPECT_THAT(fault_of_disc_path(cells, path, path.front(), path.back(), 0.2), IsEmpty());
}

// The other rule for the same thing, in whole numbers.
TEST(PathCheck, AgreesWithWholeNumbersOnRandomSegments) {
  std::mt19937_64 random(5);
  int free = 0;
  for (int round = 0; round < 60; ++round) {
    const test::OpenCells cells = test::random_cells(random, 9, 7, 0.25);
    for (int i = 0; i < 60; ++i) {
      const auto any = [&](int halves) { return 0.5 * static_cast<double>(random() % (halves + 1U)); };
      // Braces: drawn from left to right, whatever the compiler.
      const Point a{any(18), any(14)};
      const Point b{any(18), any(14)};
      if (a == b) continue;  // no segment: the one judges the point, the other what is between
      const bool sees = test::sees(cells, a, b);
      EXPECT_EQ(fault(plain(cells), {a, b}).empty(), sees)
          << test::drawing_of(cells, {a, b}) << fault(plain(cells), {a, b});
      free += sees ? 1 : 0;
    }
  }
  EXPECT_GT(free, 300);
}

TEST(PlainSearches, LooksAlongLinesAsWholeNumbersDo) {
  std::mt19937_64 random(7);
  int free = 0;
  for (int round = 0; round < 60; ++round) {
    const test::OpenCells cells = test::random_cells(random, 12, 9, 0.12);
    for (int i = 0; i < 60; ++i) {
      const Cell a{static_cast<int>(random() % 12), static_cast<int>(random() % 9)};
      const Cell b{static_cast<int>(random() % 12), static_cast<int>(random() % 9)};
      const Point from(a.x + 0.5, a.y + 0.5);
      const Point to(b.x + 0.5, b.y + 0.5);
      const bool sees = cells.is_open(a.x, a.y) && cells.is_open(b.x, b.y) && test::sees(cells, from, to);
      EXPECT_EQ(sees_along_line(plain(cells), a, b), sees) << test::drawing_of(cells, {from, to});
      free += sees ? 1 : 0;
    }
  }
  EXPECT_GT(free, 300);
}

TEST(PlainSearches, GoRoundAWallEachInItsWay) {
  const PlainCells cells = drawn(
      ".....\n"
      ".###.\n"
      ".....\n");
  PlainSearches searches(cells);
  EXPECT_DOUBLE_EQ(searches.a_star({0, 0}, {4, 2}).length, 6.0);
  const PlainPath lazy = searches.lazy_theta_star({0, 0}, {4, 2});
  EXPECT_DOUBLE_EQ(lazy.length, 6.0);
  EXPECT_EQ(lazy.cells.size(), 3U);
  EXPECT_DOUBLE_EQ(searches.lazy_theta_star({0, 0}, {4, 0}).length, 4.0);
  EXPECT_TRUE(PlainSearches(drawn(".#.\n")).a_star({0, 0}, {2, 0}).cells.empty());
  EXPECT_TRUE(PlainSearches(drawn("#.\n.#\n")).lazy_theta_star({0, 0}, {1, 1}).cells.empty());
}

TEST(PlainSearches, LazyThetaStarFindsSoundPathsBetweenTheShortestAndTheOptimumOfEightNeighbours) {
  std::mt19937_64 random(3);
  int found = 0;
  double lazy_sum = 0.0;
  double eight_sum = 0.0;
  for (int round = 0; round < 150; ++round) {
    const test::OpenCells cells = test::random_cells(random, 14, 10, 0.25);
    const PlainCells same = plain(cells);
    PlainSearches searches(same);
    const Cell a{static_cast<int>(random() % 14), static_cast<int>(random() % 10)};
    const Cell b{static_cast<int>(random() % 14), static_cast<int>(random() % 10)};
    const PlainPath lazy = searches.lazy_theta_star(a, b);
    const PlainPath eight = searches.a_star(a, b);
    ASSERT_EQ(lazy.cells.empty(), eight.cells.empty());
    const std::vector<std::int32_t> part = parts_of(same);
    const bool joined = same.is_open(a.x, a.y) && part[same.index(a.x, a.y)] == part[same.index(b.x, b.y)];
    ASSERT_EQ(joined, !lazy.cells.empty());
    if (!joined) continue;
    ++found;
    std::vector<Point> path;
    for (const Cell cell : lazy.cells) path.push_back(same.centre_m(cell));
    EXPECT_THAT(fault_of_point_path(same, path, same.centre_m(a), same.centre_m(b)), IsEmpty())
        << test::drawing_of(cells, path);
    EXPECT_NEAR(length_of_m(path), lazy.length, 1e-9);
    EXPECT_GE(lazy.length, test::plain_shortest_length(cells, path.front(), path.back()) - 1e-9);
    lazy_sum += lazy.length;
    eight_sum += eight.length;
  }
  EXPECT_GT(found, 60);
  EXPECT_LT(lazy_sum, 0.98 * eight_sum);
}

}  // namespace
}  // namespace cairn
