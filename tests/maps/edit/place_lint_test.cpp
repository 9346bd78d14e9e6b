#include "maps/edit/place_lint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// Three rooms: a door joins the two on the left, nothing the one on the right.
const std::vector<std::string> kRooms{"##################", "#....#.....#.....#", "#..........#.....#",
                                      "#....#.....#.....#", "##################"};

LandmarkGraph with_places(const std::vector<Point>& places) {
  LandmarkGraph graph;
  for (const Point& at : places) {
    Landmark landmark;
    landmark.T_map_landmark = {at.x(), at.y(), 0.0};
    graph.add(landmark);
  }
  return graph;
}

void join(LandmarkGraph& graph, LandmarkId from, LandmarkId to) {
  Route route;
  route.from = from;
  route.to = to;
  route.cost_m = 9.0;
  graph.add_route(route);
  std::swap(route.from, route.to);
  graph.add_route(route);
}

std::vector<LintFinding> of_kind(const std::vector<LintFinding>& findings, const std::string& kind) {
  std::vector<LintFinding> some;
  for (const LintFinding& finding : findings)
    if (finding.kind == kind) some.push_back(finding);
  return some;
}

TEST(PlaceLint, LandmarksThatTheGridJoinsAndTheGraphDoesNotLackARoute) {
  LandmarkGraph graph = with_places({{0.15, 0.25}, {0.35, 0.25}, {0.85, 0.25}, {1.55, 0.25}});
  join(graph, 1, 2);
  const auto findings = lint_graph(graph, drawn(kRooms), {0.04, 0.0});
  const auto missing = of_kind(findings, "missing_route");
  ASSERT_EQ(missing.size(), 1U) << "the nearest pair of the two sets";
  EXPECT_EQ(missing[0].severity, LintSeverity::warning);
  EXPECT_THAT(missing[0].landmarks, ElementsAre(2, 3));
  EXPECT_EQ(missing[0].sentence,
            "a robot of 0.04 m radius can drive the 0.50 m from L2 to L3, but no open routes join them");
  const auto isolated = of_kind(findings, "isolated");
  ASSERT_EQ(isolated.size(), 2U);
  EXPECT_EQ(isolated[0].sentence, "L3: no open route leads there or away");
  EXPECT_EQ(isolated[1].sentence, "L4: no open route leads there or away; the grid has no way there either");
  join(graph, 2, 3);
  EXPECT_THAT(of_kind(lint_graph(graph, drawn(kRooms), {0.04, 0.0}), "missing_route"), IsEmpty());
}

TEST(PlaceLint, AWideRobotMissesNoRouteThroughANarrowDoor) {
  LandmarkGraph graph = with_places({{0.25, 0.25}, {0.85, 0.25}});
  EXPECT_EQ(of_kind(lint_graph(graph, drawn(kRooms), {0.04, 0.0}), "missing_route").size(), 1U);
  EXPECT_THAT(of_kind(lint_graph(graph, drawn(kRooms), {0.06, 0.0}), "missing_route"), IsEmpty());
}

TEST(PlaceLint, AClosedRouteJoinsNothing) {
  LandmarkGraph graph = with_places({{0.15, 0.25}, {0.35, 0.25}});
  join(graph, 1, 2);
  graph.set_closed(1, true);
  EXPECT_THAT(of_kind(lint_graph(graph, drawn(kRooms), {0.04, 0.0}), "missing_route"), IsEmpty()) << "one way is open";
  graph.set_closed(2, true);
  EXPECT_EQ(of_kind(lint_graph(graph, drawn(kRooms), {0.04, 0.0}), "missing_route").size(), 1U);
}

TEST(PlaceLint, ALandmarkWithoutAPlaceToStandSaysWhy) {
  const OccupancyGrid grid = drawn({"#####????????????????????????????????",  //
                                    "#.?.#????????????????????????????????",  //
                                    "#####????????????????????????????????"});
  LandmarkGraph graph = with_places({{0.25, 0.15}, {3.55, 0.15}});
  const auto findings = of_kind(lint_graph(graph, grid, {0.2, 0.0}), "no_approach_pose");
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].sentence,
            "L1 has no approach pose: the free ground within 1.5 m of it has no room for a robot of 0.2 m radius");
  EXPECT_EQ(findings[1].sentence, "L2 has no approach pose: nothing within 1.5 m of it is known to be free");
  graph.add({});
  join(graph, 1, 3);
  const auto isolated = of_kind(lint_graph(graph, grid, {0.2, 0.0}), "isolated");
  ASSERT_EQ(isolated.size(), 1U);
  EXPECT_THAT(isolated[0].sentence, HasSubstr("L2: no open route leads there or away; it has no approach pose: noth"));
  EXPECT_THAT(of_kind(lint_graph(graph, grid, {0.2, 0.0}), "no_approach_pose"), IsEmpty()) << "said once";
}

TEST(PlaceLint, OtherFloorsAndMapsWithoutAGridAreNotAskedAbout) {
  LandmarkGraph graph = with_places({{0.15, 0.25}, {0.35, 0.25}});
  EXPECT_THAT(of_kind(lint_graph(graph, OccupancyGrid(0.1), {0.04, 0.0}), "no_approach_pose"), IsEmpty());
  graph.find(2)->level = 1;
  EXPECT_THAT(of_kind(lint_graph(graph, drawn(kRooms), {0.04, 0.0}), "missing_route"), IsEmpty());
}

}  // namespace
}  // namespace cairn
