#include "maps/landmarks/graph_parts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/maps/drawn_graph.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(GraphParts, OfAConnectedGraphAreAllMain) {
  const GraphParts parts = parts_of(drawn_graph("1>2 2>3 3>1"));
  EXPECT_THAT(parts.main, ElementsAre(1, 2, 3));
  EXPECT_THAT(parts.others, IsEmpty());
}

TEST(GraphParts, AreNamedByHowTheyHangTogetherWithTheMainPart) {
  const GraphParts parts = parts_of(drawn_graph("1 2<>3 3<>4 4>5 5>6 7>8 8>2 9<>10 11"));
  EXPECT_THAT(parts.main, ElementsAre(2, 3, 4));
  EXPECT_THAT(parts.others, ElementsAre(GraphPart{Reach::isolated, {1}}, GraphPart{Reach::trap, {5, 6}},
                                        GraphPart{Reach::no_way_in, {7, 8}}, GraphPart{Reach::cut_off, {9, 10}},
                                        GraphPart{Reach::isolated, {11}}));
}

TEST(GraphParts, OfEqualSizeTheOneWithTheLowestIdIsMain) {
  EXPECT_THAT(parts_of(drawn_graph("1 2>3")).main, ElementsAre(2)) << "one with routes";
  EXPECT_THAT(parts_of(drawn_graph("3<>4 1<>2")).main, ElementsAre(1, 2));
}

TEST(GraphParts, ClosedRoutesLeadNowhere) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  graph.set_closed(4, true);  // 3 -> 2
  EXPECT_THAT(parts_of(graph).others, ElementsAre(GraphPart{Reach::trap, {3}}));
}

TEST(GraphParts, WithoutRoutesThereIsNoMainPart) {
  EXPECT_THAT(parts_of(drawn_graph("1 2")).main, IsEmpty());
  EXPECT_THAT(parts_of(drawn_graph("1 2>2")).others.size(), 2U) << "a route to itself leads nowhere";
  EXPECT_THAT(parts_of({}).others, IsEmpty());
}

// Against the closure of the relation "has a route to", on random graphs.
TEST(GraphParts, AgreeWithWhatCanBeReachedOnRandomGraphs) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 2 + static_cast<int>(random() % 9);
    LandmarkGraph graph;
    for (int i = 1; i <= n; ++i) drawn_landmark(graph, std::to_string(i));
    std::vector<std::vector<char>> reach(n + 1, std::vector<char>(n + 1, 0));
    for (int i = 1; i <= n; ++i) reach[i][i] = 1;
    const int routes = static_cast<int>(random() % (2 * n));
    for (int k = 0; k < routes; ++k) {
      Route route;
      route.from = 1 + static_cast<LandmarkId>(random() % n);
      route.to = 1 + static_cast<LandmarkId>(random() % n);
      reach[route.from][route.to] = 1;
      graph.add_route(route);
    }
    for (int k = 1; k <= n; ++k)
      for (int i = 1; i <= n; ++i)
        for (int j = 1; j <= n; ++j)
          if (reach[i][k] != 0 && reach[k][j] != 0) reach[i][j] = 1;
    const GraphParts parts = parts_of(graph);
    std::size_t seen = parts.main.size();
    for (const LandmarkId a : parts.main)
      for (const LandmarkId b : parts.main) EXPECT_TRUE(reach[a][b]);
    for (const GraphPart& part : parts.others) {
      seen += part.landmarks.size();
      for (const LandmarkId id : part.landmarks) {
        if (parts.main.empty()) {
          EXPECT_EQ(part.reach, Reach::isolated);
          continue;
        }
        EXPECT_EQ(part.reach == Reach::trap, reach[parts.main.front()][id] != 0) << "trial " << trial << ", L" << id;
        EXPECT_EQ(part.reach == Reach::no_way_in, reach[id][parts.main.front()] != 0) << trial;
      }
    }
    EXPECT_EQ(seen, graph.landmarks().size());
  }
}

}  // namespace
}  // namespace cairn
