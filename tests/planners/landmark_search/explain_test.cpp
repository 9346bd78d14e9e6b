#include "planners/landmark_search/explain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "planners/landmark_search/landmark_search.hpp"
#include "tests/planners/landmark_search/graph_world.hpp"

namespace cairn {
namespace {

using test::GraphWorld;
using test::line_of;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

RouteRequest request(LandmarkId from, LandmarkId to) {
  RouteRequest request = test::request({from}, {to});
  request.explain = true;
  return request;
}

TEST(Explain, OnlyWhoAsksIsAnswered) {
  EXPECT_FALSE(line_of(2).plan(LandmarkSearch(), test::request({1}, {2})).explanation);
  EXPECT_TRUE(line_of(2).plan(LandmarkSearch(), request(1, 2)).explanation);
}

TEST(Explain, SaysWhatTheClosedRoutesOfTheMapCost) {
  GraphWorld world = line_of(4);
  world.route(1, 4, 9.0);
  world.graph.set_closed(2, true);
  const RouteResult result = world.plan(LandmarkSearch(), request(1, 4));
  EXPECT_DOUBLE_EQ(result.cost_m, 9.0);
  EXPECT_EQ(result.explanation->cost, 9.0);
  EXPECT_THAT(result.explanation->closed_on_cheaper_path, ElementsAre(2));
  EXPECT_DOUBLE_EQ(result.explanation->cost_with_closed_open.value(), 3.0);
}

TEST(Explain, AndThoseThatTheRequestCloses) {
  GraphWorld world = line_of(4);
  world.route(1, 4, 9.0);
  RouteRequest asked = request(1, 4);
  asked.closed = {1, 3, 77};
  const RouteResult result = world.plan(LandmarkSearch(), asked);
  EXPECT_THAT(result.explanation->closed_on_cheaper_path, ElementsAre(1, 3));
  EXPECT_DOUBLE_EQ(result.explanation->cost_with_closed_open.value(), 3.0);
}

TEST(Explain, ClosedRoutesThatWouldNotHelpAreNotNamed) {
  GraphWorld world = line_of(3);
  world.graph.set_closed(world.route(1, 3, 50.0), true);
  const RouteResult result = world.plan(LandmarkSearch(), request(1, 3));
  EXPECT_THAT(result.explanation->closed_on_cheaper_path, IsEmpty());
  EXPECT_FALSE(result.explanation->cost_with_closed_open);
}

TEST(Explain, WithoutAWayTheReasonSaysWhetherClosedRoutesAreToBlame) {
  GraphWorld world = line_of(3);
  world.graph.set_closed(2, true);
  EXPECT_EQ(world.plan(LandmarkSearch(), request(1, 3)).reason,
            "no open route leads from L1 to L3; with every closed route open one would");
  EXPECT_EQ(world.plan(LandmarkSearch(), request(3, 1)).reason, "no open route leads from L3 to L1");
}

TEST(Explain, SaysWhichSearchAnsweredAndWhy) {
  const GraphWorld world = line_of(4);
  const auto explained = [&](std::int64_t bidirectional_from, int alternatives) {
    RouteRequest asked = request(1, 4);
    asked.alternatives = alternatives;
    return world.plan(LandmarkSearch({bidirectional_from}), asked).explanation.value();
  };
  EXPECT_EQ(explained(5, 0).search, "Boost.Graph's A*");
  EXPECT_EQ(explained(5, 0).search_reason, "4 landmarks, fewer than bidirectional_from (5)");
  EXPECT_EQ(explained(4, 0).search, "the search from both ends");
  EXPECT_EQ(explained(4, 2).search_reason,
            "4 landmarks, not fewer than bidirectional_from (4); alternatives by Yen's method over the same search");
  EXPECT_EQ(explained(4, 0).search_level, 0);
}

TEST(Explain, SaysOnWhichLevelTheSearchWas) {
  const GraphWorld world = line_of(800);
  const Hierarchies hierarchies = world.hierarchies();
  const Hierarchy& hierarchy = hierarchies.by(CostKind::length);
  EXPECT_EQ(world.plan(LandmarkSearch(), request(1, 800), {}, &hierarchies).explanation->search_level,
            hierarchy.levels());
  EXPECT_EQ(world.plan(LandmarkSearch(), request(1, 1), {}, &hierarchies).explanation->search_level, 0);
}

TEST(Explain, NamesTheClustersOfEveryLevelAlongTheWayAndCountsWhatWasSettled) {
  const GraphWorld world = line_of(800);
  const Hierarchies hierarchies = world.hierarchies();
  const RouteResult result = world.plan(LandmarkSearch(), request(1, 800), {}, &hierarchies);
  const ClusterTree tree = hierarchies.tree();
  const RouteExplanation& explanation = result.explanation.value();
  const auto levels = static_cast<std::size_t>(hierarchies.by(CostKind::length).levels());
  ASSERT_GE(levels, 2U);
  ASSERT_EQ(explanation.clusters.size(), levels);
  ASSERT_EQ(explanation.settled_of_level.size(), levels + 1);
  EXPECT_EQ(std::accumulate(explanation.settled_of_level.begin(), explanation.settled_of_level.end(), std::int64_t{0}),
            result.settled);
  for (std::size_t level = 1; level <= levels; ++level) {
    std::vector<ClusterId> want;
    for (const LandmarkId landmark : result.landmarks) {
      ClusterId cluster = tree.cluster_of.at(landmark);
      for (std::size_t up = 1; up < level; ++up) cluster = tree.clusters.at(cluster).parent;
      if (want.empty() || want.back() != cluster) want.push_back(cluster);
    }
    EXPECT_EQ(explanation.clusters[level - 1], want) << "level " << level;
  }
}

}  // namespace
}  // namespace cairn
