#include "maps/edit/difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

Landmark landmark(const std::string& category, double x_m, double y_m, const std::string& name = "") {
  Landmark made;
  made.category = category;
  made.name = name;
  made.T_map_landmark = {x_m, y_m, 0.0};
  return made;
}

Landmark with_id(LandmarkId id, Landmark landmark) {
  landmark.id = id;
  return landmark;
}

RouteId add_route(LandmarkGraph& graph, LandmarkId from, LandmarkId to, double cost_m, bool closed = false) {
  Route made;
  made.from = from;
  made.to = to;
  made.cost_m = cost_m;
  made.closed = closed;
  return graph.add_route(made);
}

OccupancyGrid random_grid(unsigned seed, const Point& origin_m, const CellBox& box) {
  std::mt19937 random(seed);
  OccupancyGrid grid(0.1, 4.0, origin_m);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      grid.set_log_odds({x, y}, static_cast<LogOdds>(512 * (static_cast<int>(random() % 3) - 1)));
  return grid;
}

TEST(MapDifference, CountsCellsByPlaceOnLatticesThatDiffer) {
  SavedMap a;
  SavedMap b;
  a.grid = random_grid(1, {0.0, 0.0}, {{0, 0}, {20, 15}});
  b.grid = random_grid(2, {1.0, -0.5}, {{-5, 3}, {17, 12}});  // cell (0, 0) is a's (10, -5)
  const MapDifference difference = difference_of(a, b);
  std::array<std::array<std::int64_t, 3>, 3> expected{};
  std::int64_t differing = 0;
  for (int y = -20; y < 40; ++y)
    for (int x = -20; x < 60; ++x) {
      const auto in_a = a.grid.state({x, y});
      const auto in_b = b.grid.state(Cell{x - 10, y + 5});
      ++expected[static_cast<std::size_t>(in_a)][static_cast<std::size_t>(in_b)];
      differing += in_a != in_b;
    }
  EXPECT_EQ(difference.cells_of_other_state(), differing);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      if (i != 1 || k != 1) {
        EXPECT_EQ(difference.cells[i][k], expected[i][k]) << i << k;
      }
  EXPECT_EQ(difference.other_probability, 0);
  EXPECT_FALSE(difference.is_same());
}

TEST(MapDifference, AMapIsTheSameAsItself) {
  SavedMap map;
  map.grid = random_grid(3, {0.3, 0.3}, {{-9, -9}, {9, 9}});
  for (int i = 0; i < 9; ++i) map.graph.add(landmark("square", 0.1 * i, 0.0));
  add_route(map.graph, 1, 2, 3.0);
  add_route(map.graph, 1, 2, 5.0);
  EXPECT_TRUE(difference_of(map, map).is_same());
  SavedMap larger = map;
  larger.grid.include({{-50, -50}, {50, 50}});
  EXPECT_TRUE(difference_of(map, larger).is_same());
  larger.grid.add_log_odds({0, 0}, 1);
  EXPECT_EQ(difference_of(map, larger).other_probability, 1);
  EXPECT_FALSE(difference_of(map, larger).is_same());
}

TEST(MapDifference, AMapWithoutAGridKnowsNothing) {
  SavedMap a;
  SavedMap b;
  b.grid = OccupancyGrid(0.2);
  b.grid.set_log_odds({0, 0}, 1000);
  b.grid.set_log_odds({1, 0}, -1000);
  EXPECT_EQ(difference_of(a, b).cells[1][0], 1);
  EXPECT_EQ(difference_of(a, b).cells[1][2], 1);
  EXPECT_EQ(difference_of(b, a).cells[2][1], 1);
  EXPECT_EQ(difference_of(b, a).cells[0][1], 1);
  EXPECT_TRUE(difference_of(a, a).is_same());
  SavedMap other;
  other.grid.set_log_odds({0, 0}, 1);
  EXPECT_THROW(static_cast<void>(difference_of(b, other)), std::invalid_argument);
}

TEST(MapDifference, LandmarksAreFoundAgainByPlaceThenByIdThenByName) {
  SavedMap a;
  SavedMap b;
  a.graph.add(landmark("square", 0, 0));           // L1: the same place, another id
  a.graph.add(landmark("square", 5, 0));           // L2: a step further on
  a.graph.add(landmark("circle", 9, 0));           // L3: same id, far away
  a.graph.add(landmark("circle", 20, 0, "dock"));  // L4: by name
  a.graph.add(landmark("triangle", 30, 0));        // L5: gone
  b.graph.add(with_id(10, landmark("square", 0, 0, "gate")));
  b.graph.add(with_id(11, landmark("square", 5.3, 0)));
  b.graph.add(with_id(3, landmark("circle", 12, 4)));
  b.graph.add(with_id(12, landmark("circle", 40, 0, "dock")));
  b.graph.add(with_id(13, landmark("square", 30, 0)));  // another category
  const MapDifference difference = difference_of(a, b);
  EXPECT_THAT(difference.same, ElementsAre(LandmarkPair{1, 10, 0.0}));
  ASSERT_EQ(difference.moved.size(), 3U);
  EXPECT_EQ(difference.moved[0].b, 11);
  EXPECT_NEAR(difference.moved[0].distance_m, 0.3, 1e-12);
  EXPECT_EQ(difference.moved[1], (LandmarkPair{3, 3, 5.0}));
  EXPECT_EQ(difference.moved[2], (LandmarkPair{4, 12, 20.0}));
  EXPECT_THAT(difference.renamed, ElementsAre(LandmarkPair{1, 10, 0.0}));
  EXPECT_THAT(difference.only_in_a, ElementsAre(5));
  EXPECT_THAT(difference.only_in_b, ElementsAre(13));
}

TEST(MapDifference, RoutesAreThoseBetweenTheSameThings) {
  SavedMap a;
  for (int i = 0; i < 3; ++i) a.graph.add(landmark("square", 5.0 * i, 0));
  SavedMap b = a;
  b.graph.add(landmark("square", 20, 0));
  add_route(a.graph, 1, 2, 5.0);        // 1: the same
  add_route(a.graph, 1, 2, 9.0);        // 2: the same
  add_route(a.graph, 2, 3, 5.0);        // 3: another cost
  add_route(a.graph, 3, 1, 5.0);        // 4: closed meanwhile
  add_route(a.graph, 3, 2, 5.0);        // 5: gone
  add_route(b.graph, 1, 2, 9.0);        // 1
  add_route(b.graph, 1, 2, 5.0);        // 2
  add_route(b.graph, 2, 3, 6.0);        // 3
  add_route(b.graph, 3, 1, 5.0, true);  // 4
  add_route(b.graph, 3, 4, 5.0);        // 5: new
  const MapDifference difference = difference_of(a, b);
  EXPECT_THAT(difference.routes_same, ElementsAre(Pair(1, 2), Pair(2, 1)));
  EXPECT_THAT(difference.routes_changed, ElementsAre(Pair(3, 3), Pair(4, 4)));
  EXPECT_THAT(difference.routes_only_in_a, ElementsAre(5));
  EXPECT_THAT(difference.routes_only_in_b, ElementsAre(5));
  EXPECT_THAT(difference.moved, IsEmpty());
}

// Between them lie 4e12 cells that neither has.
TEST(MapDifference, OfGridsThatAreFarApartLooksAtTheirCellsOnly) {
  SavedMap a;
  a.grid = OccupancyGrid(0.05, 4.0, {-5e4, -5e4});
  a.grid.set_log_odds({0, 0}, LogOdds{600});
  SavedMap b;
  b.grid = OccupancyGrid(0.05, 4.0, {5e4, 5e4});
  b.grid.set_log_odds({0, 0}, LogOdds{-600});
  const MapDifference difference = difference_of(a, b);
  std::int64_t cells = 0;
  for (const auto& of_state : difference.cells)
    for (const std::int64_t count : of_state) cells += count;
  EXPECT_LE(cells, 20);
  EXPECT_EQ(difference.cells_of_other_state(), 2);
}

}  // namespace
}  // namespace cairn
