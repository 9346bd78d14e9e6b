#include "maps/edit/graph_lint.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "maps/edit/route_lint.hpp"
#include "maps/grid/swept_disc.hpp"
#include "tests/maps/drawn_graph.hpp"
#include "tests/maps/drawn_grid.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<LintFinding> lint(const LandmarkGraph& graph, const OccupancyGrid& grid = OccupancyGrid(0.1),
                              const LintOptions& options = {}) {
  return lint_graph(graph, grid, options);
}

// The one finding that is expected.
LintFinding only(const std::vector<LintFinding>& findings) {
  for (std::size_t i = 1; i < findings.size(); ++i) ADD_FAILURE() << findings[i].kind << ": " << findings[i].sentence;
  if (!findings.empty()) return findings.front();
  ADD_FAILURE() << "no finding";
  return {};
}

void place(LandmarkGraph& graph, LandmarkId id, double x_m, double y_m, const std::string& category = "") {
  graph.find(id)->T_map_landmark = {x_m, y_m, 0.0};
  graph.find(id)->category = category;
}

// Two landmarks in a corridor of cells of 0.1 m, with one route that runs at y_m.
LandmarkGraph corridor_graph(double y_m = 0.25) {
  LandmarkGraph graph = drawn_graph("1 2");
  place(graph, 1, 0.35, y_m);
  place(graph, 2, 1.65, y_m);
  Route route;
  route.from = 1;
  route.to = 2;
  route.cost_m = 1.3;
  route.trajectory = {{0.35, y_m, 0.0}, {1.65, y_m, 0.0}};
  graph.add_route(route);
  std::swap(route.from, route.to);
  std::swap(route.trajectory.front(), route.trajectory.back());
  graph.add_route(route);
  return graph;
}

const std::vector<std::string> kCorridor{"####################", "#..................#", "#..................#",
                                         "#..................#", "####################"};

TEST(GraphLint, ASoundGraphIsClean) {
  EXPECT_THAT(lint(corridor_graph(), drawn(kCorridor), {0.1, 0.4}), IsEmpty());
  EXPECT_THAT(lint({}), IsEmpty());
  EXPECT_THAT(lint(drawn_graph("1")), IsEmpty()) << "one landmark has nowhere to go";
}

TEST(GraphLint, ATrapIsAnErrorAndComesFirst) {
  LandmarkGraph graph = drawn_graph("1<>2 2>3 3>4 5>1 6<>7 8");
  graph.find(3)->name = "cellar";
  const auto findings = lint(graph);
  ASSERT_EQ(findings.size(), 4U);
  EXPECT_EQ(findings[0].kind, "trap");
  EXPECT_EQ(findings[0].severity, LintSeverity::error);
  EXPECT_THAT(findings[0].landmarks, ElementsAre(3, 4));
  EXPECT_EQ(findings[0].at_m, Point(3.0, 0.0));
  EXPECT_EQ(
      findings[0].sentence,
      "cellar (L3), L4: open routes lead there from the main part of the graph (2 of 8 landmarks), but none back");
  EXPECT_EQ(findings[1].kind, "cut_off");
  EXPECT_THAT(findings[1].landmarks, ElementsAre(6, 7));
  EXPECT_EQ(findings[2].kind, "isolated");
  EXPECT_THAT(findings[2].landmarks, ElementsAre(8));
  EXPECT_EQ(findings[3].kind, "no_way_in");
  EXPECT_THAT(findings[3].landmarks, ElementsAre(5));
  for (int i : {1, 2, 3}) EXPECT_EQ(findings[i].severity, LintSeverity::warning) << i;
}

TEST(GraphLint, AGraphWithoutAnyRouteIsOneNote) {
  const LintFinding finding = only(lint(drawn_graph("1 2 3")));
  EXPECT_EQ(finding.kind, "no_routes");
  EXPECT_EQ(finding.severity, LintSeverity::note);
}

TEST(GraphLint, LongListsAreCutInTheSentenceOnly) {
  const LintFinding finding =
      only(lint(drawn_graph("1<>2 1<>3 1<>4 1<>5 1<>6 1<>7 1<>8 1>9 9>10 9>11 9>12 9>13 9>14 9>15")));
  EXPECT_THAT(finding.sentence, HasSubstr("L9, L10, L11, L12, L13 and 2 more: "));
  EXPECT_EQ(finding.landmarks.size(), 7U);
}

TEST(GraphLint, LandmarksOfOneCategoryNearEachOtherMayBeOne) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  place(graph, 1, 0.0, 0.0, "square");
  place(graph, 2, 0.3, 0.0, "square");
  place(graph, 3, 0.1, 0.1, "circle");
  const LintFinding finding = only(lint(graph));
  EXPECT_EQ(finding.kind, "near_duplicate");
  EXPECT_THAT(finding.landmarks, ElementsAre(1, 2));
  EXPECT_EQ(finding.sentence, "L1, L2 are of category square, each within 0.4 m of another");
  EXPECT_THAT(lint(graph, OccupancyGrid(0.1), {0.25, 0.2}), IsEmpty()) << "farther apart than that";
  graph.find(2)->level = 1;
  EXPECT_THAT(lint(graph), IsEmpty()) << "on another floor";
}

TEST(GraphLint, NoTwoLandmarksStandAtOnePlace) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3");
  place(graph, 1, 3.0, 0.0, "square");
  const LintFinding finding = only(lint(graph));
  EXPECT_EQ(finding.kind, "same_place");
  EXPECT_THAT(finding.landmarks, ElementsAre(1, 3));
  place(graph, 3, 3.0, 0.0, "square");
  EXPECT_EQ(only(lint(graph)).kind, "same_place") << "said once";
}

TEST(GraphLint, ARouteThroughAnOccupiedCellSaysWhere) {
  auto rows = kCorridor;
  rows[2] = "#..........#..?....#";
  const LintFinding finding = lint(corridor_graph(), drawn(rows), {0.08, 0.4}).front();
  EXPECT_EQ(finding.kind, "blocked_route");
  EXPECT_EQ(finding.severity, LintSeverity::error);
  EXPECT_THAT(finding.routes, ElementsAre(1));
  EXPECT_THAT(finding.landmarks, ElementsAre(1, 2));
  EXPECT_NEAR((finding.at_m - Point(1.15, 0.25)).norm(), 0.0, 1e-9);
  EXPECT_EQ(finding.sentence,
            "route 1, L1 -> L2, is not free for a robot of 0.08 m radius: the cell at (1.15, 0.25) m is occupied");
}

TEST(GraphLint, ARouteThroughUnknownCellsIsAWarning) {
  auto rows = kCorridor;
  rows[2] = "#.....???..........#";
  const auto findings = lint(corridor_graph(), drawn(rows), {0.08, 0.4});
  ASSERT_EQ(findings.size(), 2U) << "there and back";
  EXPECT_EQ(findings[0].severity, LintSeverity::warning);
  EXPECT_NEAR(findings[0].at_m.x(), 0.65, 1e-9) << "the first one met";
  EXPECT_NEAR(findings[1].at_m.x(), 0.85, 1e-9) << "from the other side";
  EXPECT_THAT(findings[0].sentence, HasSubstr("is unknown"));
}

TEST(GraphLint, AWideRobotDoesNotFitWhereANarrowOneDoes) {
  EXPECT_THAT(lint(corridor_graph(), drawn(kCorridor), {0.14, 0.4}), IsEmpty());
  EXPECT_EQ(lint(corridor_graph(), drawn(kCorridor), {0.16, 0.4}).size(), 2U);
  LandmarkGraph closed = corridor_graph();
  closed.set_closed(1, true);
  closed.set_closed(2, true);
  for (const LintFinding& finding : lint(closed, drawn(kCorridor), {0.16, 0.4}))
    EXPECT_NE(finding.kind, "blocked_route") << "a closed route is not driven";
}

TEST(GraphLint, WithoutAGridTrajectoriesAreNotCheckedAndThatIsSaid) {
  const LintFinding finding = only(lint(corridor_graph()));
  EXPECT_EQ(finding.kind, "unchecked_routes");
  EXPECT_EQ(finding.severity, LintSeverity::note);
  EXPECT_THAT(finding.routes, ElementsAre(1, 2));
}

TEST(GraphLint, TrajectoriesBeginAndEndAtTheirLandmarks) {
  LandmarkGraph graph = corridor_graph();
  graph.find(2)->access = Pose2{1.4, 0.25, 0.0};
  const auto findings = lint(graph, drawn(kCorridor), {0.1, 0.4});
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].kind, "loose_ends");
  EXPECT_EQ(findings[0].severity, LintSeverity::warning);
  EXPECT_EQ(
      findings[0].sentence,
      "route 1, L1 -> L2, begins 0.00 m from where a robot stands at L1 and ends 0.25 m from where it stands at L2");
  EXPECT_NEAR(findings[0].at_m.x(), 1.65, 1e-9);
  EXPECT_NEAR(findings[1].at_m.x(), 1.65, 1e-9) << "the way back begins there";
}

TEST(GraphLint, ACostBelowTheStraightLineIsANote) {
  LandmarkGraph graph = drawn_graph("1<>3");
  Route route;
  route.from = 1;
  route.to = 3;
  route.cost_m = 1.5;
  graph.add_route(route);
  const LintFinding finding = only(lint(graph));
  EXPECT_EQ(finding.kind, "too_cheap");
  EXPECT_EQ(finding.severity, LintSeverity::note);
  EXPECT_THAT(finding.sentence, HasSubstr("costs 1.50 m, less than the straight line of 2.00 m"));
}

TEST(GraphLint, AClosedRouteIsANote) {
  LandmarkGraph graph = drawn_graph("1<>2 1>2");
  graph.set_closed(3, true);
  const LintFinding finding = only(lint(graph));
  EXPECT_EQ(finding.kind, "closed_route");
  EXPECT_EQ(finding.severity, LintSeverity::note);
  EXPECT_THAT(finding.routes, ElementsAre(3));
}

TEST(GraphLint, NamesThatStandForSomethingElseMislead) {
  LandmarkGraph graph = drawn_graph("1<>2 2<>3 3<>4 4<>5 5<>6");
  graph.find(1)->name = "door";
  graph.find(2)->name = "door";
  graph.find(3)->name = "L1";
  graph.find(4)->name = "L4";
  graph.find(5)->name = "2, 3.5";
  graph.find(6)->name = "nearest door";
  const auto findings = lint(graph);
  ASSERT_EQ(findings.size(), 4U);
  EXPECT_EQ(findings[0].sentence, "L3 is named \"L1\", which reads as the id of a landmark");
  EXPECT_THAT(findings[1].sentence, HasSubstr("reads as coordinates"));
  EXPECT_THAT(findings[2].sentence, HasSubstr("reads as a search for a category"));
  EXPECT_EQ(findings[3].kind, "name_taken_twice");
  EXPECT_EQ(findings[3].sentence, "door (L1), door (L2) are all named \"door\", which stands for L1 alone");
}

TEST(BlockageOn, IsThereExactlyWhenTheSweepIsNotFree) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(-0.05, 1.05);
  int blocked = 0;
  for (int trial = 0; trial < 500; ++trial) {
    OccupancyGrid grid(0.1);
    for (int i = 0; i < 144; ++i) {
      const auto kind = random() % 40;  // one cell of forty is occupied, one unknown
      grid.set_log_odds({i % 12, i / 12}, kind == 0 ? LogOdds{900} : kind == 1 ? LogOdds{0} : LogOdds{-900});
    }
    std::vector<Pose2> way(3);
    for (Pose2& pose : way) pose = {1.2 * unit(random), 1.2 * unit(random), 0.0};
    const double radius_m = 0.05 * static_cast<double>(random() % 3);
    const auto is_free = [&](UnknownPolicy unknown) {
      const GroundRules rules{unknown, {}};
      return sweep_is_free(grid, rules, way[0].position(), way[1].position(), radius_m) &&
             sweep_is_free(grid, rules, way[1].position(), way[2].position(), radius_m);
    };
    const auto blockage = blockage_on(way, grid, radius_m);
    EXPECT_EQ(blockage.has_value(), !is_free(UnknownPolicy::avoid)) << drawing_of(grid);
    if (!blockage) continue;
    ++blocked;
    EXPECT_EQ(blockage->by == CellState::occupied, !is_free(UnknownPolicy::allow)) << drawing_of(grid);
    EXPECT_EQ(grid.state(grid.cell_at(blockage->at_m)), blockage->by);
  }
  EXPECT_GT(blocked, 50);
  EXPECT_LT(blocked, 450);
}

TEST(BlockageOn, AWayFarOutsideTheGridIsUnknown) {
  const std::vector<Pose2> way{{0.35, 0.25, 0.0}, {1e9, 0.25, 0.0}};
  const auto blockage = blockage_on(way, drawn(kCorridor), 0.1);
  ASSERT_TRUE(blockage.has_value());
  EXPECT_EQ(blockage->by, CellState::unknown);
  EXPECT_EQ(blockage->at_m.x(), 1e9);
}

}  // namespace
}  // namespace cairn
