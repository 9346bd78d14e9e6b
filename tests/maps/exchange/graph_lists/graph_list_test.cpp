#include "maps/exchange/graph_lists/graph_list.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string refused(const std::string& text) {
  return refusal_of(parse_graph_list, text);
}

TEST(GraphList, NodeSeventeenBecomesLandmarkSeventeen) {
  const ImportedGraph read = parse_graph_list("node 17 1.5 -2 front desk\nnode 4 0 0\nedge 17 4 2.5\n", "a.graph");
  ASSERT_NE(read.graph.find(17), nullptr);
  EXPECT_EQ(read.graph.find(17)->name, "front desk");
  EXPECT_EQ(read.graph.find(17)->T_map_landmark, (Pose2{1.5, -2.0, 0.0}));
  ASSERT_NE(read.graph.find_route(1), nullptr);
  EXPECT_EQ(read.graph.find_route(1)->from, 17);
  EXPECT_EQ(read.graph.find_route(1)->to, 4);
  EXPECT_EQ(read.graph.find_route(1)->cost_m, 2.5);
  EXPECT_EQ(read.graph.route_between(4, 17), nullptr) << "edges are directed";
  EXPECT_THAT(read.warnings, IsEmpty());
}

TEST(GraphList, CommentsBlanksAndLineEndsOfWindowsAreFine) {
  const ImportedGraph read = parse_graph_list(
      "\xEF\xBB\xBF# roads\r\n\r\n  node\t1 0 0  # no name\r\nnode 2 3 4  B #2 \r\n \t\r\nedge 1 2 5 # main street\r\n",
      "a.graph");
  EXPECT_EQ(read.graph.find(1)->name, "");
  EXPECT_EQ(read.graph.find(2)->name, "B #2");
  EXPECT_EQ(read.graph.routes().size(), 1U);
  EXPECT_THAT(read.warnings, IsEmpty());
}

TEST(GraphList, EdgesMayStandBeforeTheirNodes) {
  EXPECT_EQ(parse_graph_list("edge 1 2 5\nnode 2 0 0\nnode 1 0 0\n", "a").graph.routes().size(), 1U);
}

TEST(GraphList, NodeZeroGetsTheNextFreeIdAndItsNumberAsName) {
  const ImportedGraph read = parse_graph_list("node 0 1 1\nnode 7 2 2\nedge 0 7 1\nedge 7 0 2\n", "a");
  EXPECT_EQ(read.graph.find(8)->name, "0");
  EXPECT_EQ(read.graph.find_by_name("0")->id, 8);
  EXPECT_EQ(read.graph.find_route(1)->from, 8);
  EXPECT_EQ(read.graph.find_route(2)->to, 8);
  EXPECT_THAT(read.warnings, ElementsAre("node 0 is landmark L8: ids of landmarks begin at 1"));
  EXPECT_EQ(parse_graph_list("node 0 1 1 gate\n", "a").graph.find(1)->name, "gate");
}

TEST(GraphList, AMissingLastLineEndIsAWarning) {
  EXPECT_THAT(parse_graph_list("node 1 0 0\nnode 2 0 0\nedge 1 2 5", "a").warnings,
              ElementsAre("the last line has no line end: the file may have been cut"));
}

TEST(GraphList, NamesThatTwoLandmarksHaveAreAWarning) {
  EXPECT_THAT(
      parse_graph_list("node 1 0 0 a\nnode 2 0 0 a\nnode 3 0 0 b\n", "a").warnings,
      ElementsAre("1 name belongs to more than one landmark, the first is \"a\": a name finds the landmark with "
                  "the lowest id"));
}

TEST(GraphList, RefusesUnknownWords) {
  EXPECT_EQ(refused("node 1 0 0\n nod 2 0 0\n"),
            "2:2: unknown word \"nod\" (did you mean \"node\"?): a line begins with node, edge or #");
  EXPECT_EQ(refused("Edge 1 2 3\n"),
            "1:1: unknown word \"Edge\" (did you mean \"edge\"?): a line begins with node, edge or #");
  EXPECT_EQ(refused("vertex 1 0 0\n"), "1:1: unknown word \"vertex\": a line begins with node, edge or #");
}

TEST(GraphList, RefusesBadIds) {
  const std::string allowed = " is not a whole number of 0 to 9007199254740991";
  EXPECT_EQ(refused("node -1 0 0\n"), "1:6: the node's id \"-1\"" + allowed);
  EXPECT_EQ(refused("node 1.5 0 0\n"), "1:6: the node's id \"1.5\"" + allowed);
  EXPECT_EQ(refused("node 9007199254740992 0 0\n"), "1:6: the node's id \"9007199254740992\"" + allowed);
  EXPECT_EQ(refused("node 99999999999999999999999 0 0\n"), "1:6: the node's id \"99999999999999999999999\"" + allowed);
  EXPECT_EQ(refused("node 1 0 0\nedge 1 x 3\n"), "2:8: the id that the edge goes to \"x\"" + allowed);
  EXPECT_EQ(refused("node 9007199254740991 0 0\n"), "accepted");
  EXPECT_EQ(refused("node 9007199254740991 0 0\nnode 0 0 0\n"), "2:6: there is no id left for node 0");
}

TEST(GraphList, RefusesBadNumbers) {
  EXPECT_EQ(refused("node 1 nan 0\n"), "1:8: x_m \"nan\" is not allowed: it must be a finite number");
  EXPECT_EQ(refused("node 1 0 inf\n"), "1:10: y_m \"inf\" is not allowed: it must be a finite number");
  EXPECT_EQ(refused("node 1 0 -1e300\n"), "1:10: the coordinate -1e+300 is not allowed: it must be within 1e+09 m");
  EXPECT_EQ(refused("node 1 0 1e999\n"), "1:10: y_m \"1e999\" is not allowed: it must be a finite number");
  EXPECT_EQ(refused("node 1 3,5 0\n"), "1:8: x_m \"3,5\" is not a number");
  EXPECT_EQ(refused("edge 1 2 -0.5\nnode 1 0 0\n"), "1:10: the cost -0.5 is not allowed: it must not be negative");
  EXPECT_EQ(refused("edge 1 2 NaN\n"), "1:10: the cost \"NaN\" is not allowed: it must be a finite number");
  EXPECT_EQ(refused("edge 1 2 -inf\n"), "1:10: the cost \"-inf\" is not allowed: it must be a finite number");
}

TEST(GraphList, RefusesLinesThatAreTooShortOrTooLong) {
  EXPECT_EQ(refused("node\n"), "1:5: the node's id is missing: node ID X_M Y_M [NAME]");
  EXPECT_EQ(refused("node 1 0\n"), "1:9: y_m is missing: node ID X_M Y_M [NAME]");
  EXPECT_EQ(refused("edge 1 2\n"), "1:9: the cost is missing: edge FROM TO COST_M");
  EXPECT_EQ(refused("edge 1 2 3 4\n"), "1:12: \"4\" is too much: edge FROM TO COST_M");
  EXPECT_EQ(refused("node 1 0 0\nedge 1 1"),
            "2:9: the cost is missing: edge FROM TO COST_M; the file ends here, it may have been cut");
}

TEST(GraphList, RefusesDuplicatesDanglingEdgesAndNothing) {
  EXPECT_EQ(refused("node 5 0 0\nnode 1 0 0\nnode 5 1 1\nnode 1 0 0\n"), "3:6: node 5 is there already, in line 1");
  EXPECT_EQ(refused("node 1 0 0\nedge 1 1 0\nedge 1 9 0\nedge 8 1 0\n"), "3:8: there is no node 9");
  EXPECT_EQ(refused("node 1 0 0\nedge 8 1 0\n"), "2:6: there is no node 8");
  EXPECT_EQ(refused("node 1 0 0\nedge 0 1 0\n"), "2:6: there is no node 0");
  EXPECT_EQ(refused(""), " holds no node (node ID X_M Y_M [NAME])");
  EXPECT_EQ(refused("# nothing\n"), " holds no node (node ID X_M Y_M [NAME])");
}

TEST(GraphList, RefusesNamesThatNobodyCanRead) {
  EXPECT_EQ(refused("node 1 0 0 ab\xE2\x80\xAE\n"), "1:14: the name \"ab\\u202e\" holds a control character");
  EXPECT_EQ(refused("node 1 0 0 a\x1B[2J\n"), "1:13: the name \"a\\x1b[2J\" holds a control character");
  EXPECT_EQ(refused("node 1 0 0 a\xC3\n"), "1:13: is not UTF-8 text");
}

TEST(GraphList, AFileCutAnywhereIsRefusedOrWarnedOf) {
  const std::string whole = "node 1 0.25 0\nnode 2 10 0 gate\nedge 1 2 10.5\nedge 2 1 11\n";
  for (std::size_t size = 1; size < whole.size(); ++size) {
    if (whole[size - 1] == '\n') continue;
    try {
      EXPECT_THAT(parse_graph_list(whole.substr(0, size), "a").warnings,
                  testing::Contains("the last line has no line end: the file may have been cut"))
          << size;
    } catch (const ExchangeError&) {
    }
  }
}

TEST(GraphList, WhatIsWrittenReadsBackTheSame) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 300; ++round) {
    const LandmarkGraph graph = random_graph(random);
    const ExportedGraph written = graph_list_of(graph);
    expect_same_content(parse_graph_list(written.text, "a").graph, graph);
    EXPECT_EQ(graph_list_of(parse_graph_list(written.text, "a").graph).text, written.text);
    EXPECT_THAT(written.warnings, IsEmpty());
    ASSERT_FALSE(HasFailure()) << written.text;
  }
}

TEST(GraphList, SaysWhatItCannotHold) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.name = "two\nlines";
  landmark.category = "square";
  landmark.level = 2;
  landmark.annotations = "{}";
  landmark.T_map_landmark.theta_rad = 1.0;
  landmark.access = Pose2{};
  landmark.sightings = 3;
  graph.add(landmark);
  graph.add({});
  Route route{0, 1, 2, 1.0, {{}, {}}, true, true, 0};
  route.speed_limit_mps = 1.0;
  route.annotations = "{}";
  graph.add_route(route);
  const ExportedGraph written = graph_list_of(graph);
  EXPECT_EQ(written.text, "# 2 landmarks, 1 route\nnode 1 0 0\nnode 2 0 0\n");
  EXPECT_THAT(
      written.warnings,
      ElementsAre("1 landmark: the category is not written", "1 landmark: the heading is not written",
                  "1 landmark: where a robot stands at it is not written", "1 landmark: the floor is not written",
                  "1 landmark: what other tools keep with it is not written",
                  "1 landmark: how it was recognised is not written",
                  "1 route: closed, and so left out: whoever reads the file would drive there",
                  "1 route: the trajectory is not written", "1 route: that a robot has driven it is not written",
                  "1 route: the speed limit is not written", "1 route: what other tools keep with it is not written",
                  "1 landmark: the name does not fit on a line of the list and is not written"));
}

}  // namespace
}  // namespace cairn
