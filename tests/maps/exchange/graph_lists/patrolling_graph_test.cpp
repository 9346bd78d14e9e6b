#include "maps/exchange/graph_lists/patrolling_graph.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;

constexpr const char* kTwo = "2\n688\n499\n0.1\n-1\n2\n\n0\n31\n289\n1\n1\nS\n177\n\n1\n82\n287\n1\n0 N 177\n";

TEST(PatrollingGraph, PixelsBecomeMetresByResolutionAndOffset) {
  const ImportedGraph read = parse_patrolling_graph(kTwo, "a.graph");
  ASSERT_EQ(read.graph.landmarks().size(), 2U);
  EXPECT_NEAR(read.graph.find(1)->T_map_landmark.x_m, 7.2, 1e-9);
  EXPECT_NEAR(read.graph.find(1)->T_map_landmark.y_m, 30.7, 1e-9);
  EXPECT_EQ(read.graph.find(2)->name, "0");
  ASSERT_EQ(read.graph.routes().size(), 2U);
  EXPECT_EQ(read.graph.find_route(1)->from, 2);
  EXPECT_EQ(read.graph.find_route(1)->to, 1);
  EXPECT_NEAR(read.graph.find_route(1)->cost_m, 17.7, 1e-9);
  EXPECT_THAT(read.warnings, ElementsAre("node 0 is landmark L2: ids of landmarks begin at 1"));
}

TEST(PatrollingGraph, IsKnownByItsFirstCharacter) {
  EXPECT_TRUE(is_patrolling_graph("\n 40\n"));
  EXPECT_FALSE(is_patrolling_graph("node 1 0 0\n"));
  EXPECT_FALSE(is_patrolling_graph(" \n"));
}

TEST(PatrollingGraph, RefusesWithThePlace) {
  const auto refused = [](const std::string& text) { return refusal_of(parse_patrolling_graph, text); };
  EXPECT_EQ(refused("1 5 5 0 0 0 1 1 1 0\n"), "1:7: the resolution must be above 0 m a pixel");
  EXPECT_EQ(refused("1 5 5 0.1 0 0\n1 1 x 0\n"), "2:5: y_px \"x\" is not a number");
  EXPECT_EQ(refused("1 5 5 0.1 0 0\n1 1 1 1\n7 N 5\n"), "3:1: there is no vertex 7");
  EXPECT_EQ(refused("1 5 5 0.1 0 0\n1 1 1 0\n2\n"),
            "3:1: there is more after the 1 vertices that the first line states");
  EXPECT_EQ(refused("2 5 5 0.1 0 0\n1 1 1 0\n1 2 2 0\n"), "3:1: node 1 is there already, in line 2");
  EXPECT_THAT(refused("2 5 5 0.1 0 0\n1 1 1 0\n"),
              testing::HasSubstr("the vertex's id is missing: ID X_PX Y_PX DEGREE"));
}

}  // namespace
}  // namespace cairn
