#include "maps/hierarchy/straight_bound.hpp"

#include <gtest/gtest.h>

#include "maps/hierarchy/hierarchy.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/hierarchy/graph_laws.hpp"

namespace cairn {
namespace {

// No open route costs less than the bound says.
void expect_consistent(const StraightBound& bound, const Network& network) {
  for (VertexIndex v = 0; v < network.end(); ++v)
    for (const Arc& arc : network.out(v))
      ASSERT_LE(bound.cost_per_m() * (bound.place_of(v) - bound.place_of(arc.other)).norm(), arc.cost);
}

TEST(StraightBound, IsTheLeastThatAnOpenRouteCostsAMetre) {
  LandmarkGraph graph = drawn_graph("1>2 2>4 1>4");
  graph.set_cost(1, 3.0);   // 3 a metre
  graph.set_cost(2, 4.0);   // 2 a metre
  graph.set_cost(3, 0.75);  // 0.25 a metre
  EXPECT_NEAR(Hierarchy(graph).bound().cost_per_m(), 0.25, 1e-8);
  graph.set_closed(3, true);
  EXPECT_NEAR(Hierarchy(graph).bound().cost_per_m(), 2.0, 1e-8);
}

TEST(StraightBound, IsNoneWhereARouteOrEverythingIsFree) {
  LandmarkGraph graph = drawn_graph("1>2 2>3");
  graph.set_cost(2, 0.0);
  EXPECT_EQ(Hierarchy(graph).bound().cost_per_m(), 0.0);
  EXPECT_EQ(Hierarchy(drawn_graph("1 2 3")).bound().cost_per_m(), 0.0);
}

TEST(StraightBound, CountsFromApproachPoseToApproachPose) {
  LandmarkGraph graph = drawn_graph("1>3");
  graph.find(1)->access = Pose2{2.0, 0.0, 0.0};
  graph.set_cost(1, 1.0);
  EXPECT_NEAR(Hierarchy(graph).bound().cost_per_m(), 1.0, 1e-8);
}

TEST(StraightBound, StaysConsistentThroughChangesAlsoOfPlacesThatNobodyReports) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    LandmarkGraph graph;
    test::GraphChanger changer(graph, seed);
    changer.grow_to(60);
    Hierarchy hierarchy(graph);
    for (int step = 0; step < 200; ++step) {
      GraphChanges changes = changer.change();
      if (const LandmarkId moved = changer.any_landmark(); moved != 0) {
        graph.find(moved)->T_map_landmark.x_m += static_cast<double>(changer.number_below(40)) - 20.0;
        if (step % 2 == 0) changes.landmarks.push_back(moved);
      }
      hierarchy.update(graph, changes);
      expect_consistent(hierarchy.bound(), hierarchy.network());
    }
  }
}

}  // namespace
}  // namespace cairn
