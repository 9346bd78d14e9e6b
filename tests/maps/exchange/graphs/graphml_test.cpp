#include "maps/exchange/graphs/graphml.hpp"

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

// Line 1: the head with the keys of networkx; what follows begins in line 2.
std::string graphml(const std::string& content, const std::string& direction = "directed") {
  return R"(<?xml version='1.0' encoding='utf-8'?><graphml xmlns="http://graphml.graphdrawing.org/xmlns">)"
         R"(<key id="d0" for="node" attr.name="x" attr.type="double"/>)"
         R"(<key id="d1" for="node" attr.name="y" attr.type="long"/>)"
         R"(<key id="d2" for="node" attr.name="label" attr.type="string"/>)"
         R"(<key id="d3" for="edge" attr.name="weight" attr.type="double"/>)"
         R"(<key id="d4" for="edge" attr.name="closed" attr.type="boolean"/>)"
         R"(<key id="d5" for="node" attr.name="z" attr.type="double"/>)"
         R"(<key id="d6" for="edge" attr.name="lanes" attr.type="int"/>)"
         R"(<key id="d7" for="all" attr.name="level" attr.type="int"/>)"
         R"(<key id="d8" for="edge" attr.name="speed_limit_mps" attr.type="double"/>)"
         R"(<key id="d9" for="node" attr.name="annotations" attr.type="string"/>)"
         R"(<key id="c" for="graph" attr.name="crs" attr.type="string"/>)"
         R"(<graph edgedefault=")" +
         direction + "\">\n" + content + "\n</graph></graphml>\n";
}

std::string node(const std::string& id, const std::string& more = "") {
  return "<node id=\"" + id + "\"><data key=\"d0\">1.5</data><data key=\"d1\"> 2 </data>" + more + "</node>\n";
}

std::string edge(const std::string& from, const std::string& to, const std::string& more = "") {
  return "<edge source=\"" + from + "\" target=\"" + to + "\">" + more + "</edge>\n";
}

ImportedGraph read(const std::string& content, const std::string& direction = "directed") {
  return parse_graphml(graphml(content, direction), "a.graphml");
}
std::string refused(const std::string& content) {
  return refusal_of(parse_graphml, graphml(content));
}

TEST(GraphMl, ReadsWhatNetworkxWrites) {
  const ImportedGraph got =
      read(node("17", R"(<data key="d2">a &lt;b&gt; &amp; c</data><data key="d5">3.5</data>)") + node("4") +
           edge("17", "4", R"(<data key="d3">2.5</data><data key="d4">True</data><data key="d6">2</data>)") +
           edge("4", "17"));
  EXPECT_EQ(got.graph.find(17)->name, "a <b> & c");
  EXPECT_EQ(got.graph.find(17)->T_map_landmark, (Pose2{1.5, 2.0, 0.0}));
  EXPECT_EQ(got.graph.find(17)->annotations, R"({"z":3.5})");
  EXPECT_EQ(got.graph.find_route(1)->from, 17);
  EXPECT_EQ(got.graph.find_route(1)->cost_m, 2.5);
  EXPECT_TRUE(got.graph.find_route(1)->closed);
  EXPECT_EQ(got.graph.find_route(1)->annotations, R"({"lanes":2})");
  EXPECT_EQ(got.graph.find_route(2)->cost_m, 0.0) << "both nodes are at one place";
  EXPECT_THAT(got.warnings, ElementsAre("1 edge: no cost (cost, weight or length), the straight length is taken"));
}

TEST(GraphMl, LettersBeforeANumberAreNoPartOfTheId) {
  const ImportedGraph got = read(node("n17") + node("n0") + node("n3", R"(<data key="d2">gate</data>)") +
                                 edge("n0", "n17", R"(<data key="d3">1</data>)"));
  EXPECT_EQ(got.graph.find(18)->name, "n0");
  EXPECT_EQ(got.graph.find(3)->name, "gate");
  EXPECT_EQ(got.graph.find_route(1)->from, 18);
  EXPECT_THAT(got.warnings, ElementsAre("node 0 is landmark L18: ids of landmarks begin at 1"));
}

TEST(GraphMl, OtherIdsAreNames) {
  for (const char* id : {"lift", "m17", "n017", "n9007199254740992", "n1a", "1n1"}) {
    const ImportedGraph got = read(node("n17") + node(id, R"(<data key="d2">gate</data>)"));
    EXPECT_EQ(got.graph.find(1)->name, "n17") << id;
    EXPECT_EQ(got.graph.find(2)->name, id);
    EXPECT_EQ(got.graph.find(2)->annotations, R"({"label":"gate"})");
    EXPECT_THAT(got.warnings, ElementsAre("the ids of nodes are no numbers: they are the landmarks' names"));
  }
}

TEST(GraphMl, AnUndirectedEdgeIsTwoRoutes) {
  const std::string cost = R"(<data key="d3">4</data>)";
  const ImportedGraph got = read(node("1") + node("2") + edge("1", "2", cost) +
                                     "<edge id=\"e9\" source=\"2\" target=\"1\" directed=\"true\">" + cost + "</edge>",
                                 "undirected");
  ASSERT_EQ(got.graph.routes().size(), 3U);
  EXPECT_EQ(got.graph.find_route(2)->from, 2);
  EXPECT_EQ(got.graph.find_route(2)->cost_m, 4.0);
  EXPECT_EQ(got.graph.find_route(3)->from, 2);
}

TEST(GraphMl, TakesDefaultsOfKeys) {
  std::string text = graphml(node("1") + edge("1", "1"));
  const std::string key = R"(attr.name="weight" attr.type="double")";
  text.replace(text.find(key + "/>"), key.size() + 2, key + "><default>7</default></key>");
  EXPECT_EQ(parse_graphml(text, "a").graph.find_route(1)->cost_m, 7.0);
}

TEST(GraphMl, TakesThePlacesOfYed) {
  const ImportedGraph got = parse_graphml(
      R"(<graphml xmlns:y="http://www.yworks.com/xml/graphml"><key for="node" id="d6" yfiles.type="nodegraphics"/>
<graph edgedefault="directed" id="G"><node id="n1"><data key="d6"><y:ShapeNode>
<y:Geometry height="30.0" width="20.0" x="100.0" y="50.0"/><y:Fill color="#FFCC00"/><y:NodeLabel>hall</y:NodeLabel>
</y:ShapeNode></data></node></graph><data key="d7"><y:Resources/></data></graphml>)",
      "a");
  EXPECT_EQ(got.graph.find(1)->T_map_landmark, (Pose2{110.0, -65.0, 0.0}));
  EXPECT_EQ(got.graph.find(1)->name, "hall");
  EXPECT_THAT(got.warnings,
              ElementsAre("1 node: no x and y, the place in yEd's drawing is taken as metres, y upwards"));
}

TEST(GraphMl, RefusesBadNodes) {
  EXPECT_EQ(refused("<node/>"), "2:2: a node needs an id");
  EXPECT_EQ(refused("<node id=\"a\"/>"), "2:2: node \"a\" has no place: the keys x and y, in metres");
  EXPECT_EQ(refused(node("a") + node("b") + node("a")), "4:2: node \"a\" is there already, in line 2");
  EXPECT_EQ(refused(R"(<node id="1"><data key="d0">nan</data></node>)"), "2:15: x \"nan\" is not a finite number");
  EXPECT_EQ(refused(R"(<node id="1"><data key="d0">2e9</data></node>)"),
            "2:15: the coordinate 2e+09 is not allowed: it must be within 1e+09 m");
  EXPECT_EQ(refused(R"(<node id="1"><data key="d0"/></node>)"), "2:15: x \"\" is not a finite number");
  EXPECT_EQ(refused(R"(<node id="1"><data key="x">1</data></node>)"), "2:15: the key \"x\" is not declared");
  EXPECT_EQ(refused(node("1", "<data key=\"d7\">1.5</data>")),
            "2:65: level 1.5 is not a floor: it must be a whole number of -1000000 to 1000000");
  EXPECT_EQ(refused(node("1", "<data key=\"d9\">[1]</data>")), "2:65: annotations must be the text of a JSON object");
  EXPECT_EQ(refused(node("1", "<data key=\"d2\">&#xD800;</data>")),
            "2:65: the text names a character that does not exist (&#...;)");
  EXPECT_EQ(refused(node("1", "<data key=\"d2\">a&#x1B;[2J</data>")),
            "2:65: the text \"a\\x1b[2J\" holds the control character \\x1b");
  EXPECT_EQ(refused(node("1", "<data key=\"d2\">a&#10;b</data>")), "2:2: the name \"a\\nb\" holds a control character");
  EXPECT_EQ(refused(node("a&#x202E;")), "2:2: the text \"a\\u202e\" holds the control character \\u202e");
  EXPECT_EQ(refused("<node id=\"&#x110000;\"/>"), "2:2: the text names a character that does not exist (&#...;)");
  EXPECT_EQ(refused(node("1", "<graph edgedefault=\"directed\"/>")), "2:65: a graph within a node is not read");
  EXPECT_EQ(refused(""), "1:773: the graph holds no node");
}

TEST(GraphMl, RefusesBadEdges) {
  EXPECT_EQ(refused(node("1") + edge("1", "2")), "3:2: target: there is no node \"2\"");
  EXPECT_EQ(refused(node("1") + "<edge target=\"1\"/>"), "3:2: source: there is no node \"\"");
  const auto loop = [](const std::string& data) { return refused(node("1") + edge("1", "1", data)); };
  EXPECT_EQ(loop("<data key=\"d3\">-1</data>"), "3:2: the cost -1 is not allowed: it must not be negative");
  EXPECT_EQ(loop("<data key=\"d3\">inf</data>"), "3:30: weight \"inf\" is not a finite number");
  EXPECT_EQ(loop("<data key=\"d4\">maybe</data>"), "3:30: closed \"maybe\" is neither true nor false");
  EXPECT_EQ(loop("<data key=\"d8\">0</data>"), "3:2: speed_limit_mps 0 is not allowed: it must be above 0");
  EXPECT_EQ(refused(node("1") + "<hyperedge/>"), "3:2: a hyperedge is not a route: edges have two ends");
}

TEST(GraphMl, RefusesWhatIsNoGraphMl) {
  const auto refused_text = [](const std::string& text) { return refusal_of(parse_graphml, text); };
  EXPECT_EQ(refused_text(""), "1:1: is not XML: No document element found; the file ends here, it may have been cut");
  EXPECT_EQ(refused_text("<gexf/>"), "1:2: is not GraphML: its outer element is <gexf>");
  EXPECT_EQ(refused_text("<graphml/>"), "1:2: holds no graph");
  EXPECT_EQ(refused_text("<graphml><graph/></graphml>"), "1:11: edgedefault must be directed or undirected, is \"\"");
  EXPECT_EQ(refused_text("<graphml>\n<graphs/></graphml>"),
            "2:2: unknown element <graphs> (did you mean \"graph\"?) in <graphml>");
  EXPECT_EQ(refused(node("1") + "<egde/>"), "3:2: unknown element <egde> (did you mean \"edge\"?) in <graph>");
  EXPECT_EQ(refused("</graph>\n<graph>"), "3:2: holds a second graph: a map has one");
  EXPECT_EQ(refused_text("<graphml><key id=\"a\"/><key id=\"a\"/></graphml>"), "1:24: the key \"a\" is there twice");
  EXPECT_EQ(refused_text("<graphml>\n  <graph></graphml>"), "2:12: is not XML: Start-end tags mismatch");
  EXPECT_EQ(refused_text("<graphml>\xFF</graphml>"), "1:10: is not UTF-8 text");
}

TEST(GraphMl, RefusesDegrees) {
  EXPECT_EQ(refused("<data key=\"c\">epsg:4326</data>" + node("1")),
            "2:2: crs \"epsg:4326\" has degrees of longitude and latitude; a map needs metres in its own frame");
}

TEST(GraphMl, EntitiesAreNotExpandedAndDeepNestingIsNotFollowed) {
  const std::string doctype = R"(<!DOCTYPE g [<!ENTITY a "aaaa"><!ENTITY b "&a;&a;">]>)";
  std::string text = graphml(node("1", "<data key=\"d2\">&b;</data>"));
  text.insert(text.find("<graphml"), doctype);
  EXPECT_EQ(parse_graphml(text, "a").graph.find(1)->name, "&b;");
  std::string deep;
  for (int i = 0; i < 200'000; ++i) deep += "<a:b>";
  EXPECT_THAT(refused(node("1") + deep), HasSubstr("is not XML"));
  for (int i = 0; i < 200'000; ++i) deep += "</a:b>";
  EXPECT_EQ(refused(node("1") + deep), "accepted");
}

TEST(GraphMl, AFileCutAnywhereIsRefused) {
  const std::string whole = graphml(node("1") + node("2") + edge("1", "2"));
  for (std::size_t size = 0; size < whole.size() - 1; size += 3)
    EXPECT_NE(refusal_of(parse_graphml, whole.substr(0, size)), "accepted") << size;
  EXPECT_THAT(refusal_of(parse_graphml, whole.substr(0, whole.size() - 5)),
              testing::EndsWith("the file ends here, it may have been cut"));
}

TEST(GraphMl, WhatIsWrittenReadsBackTheSame) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 200; ++round) {
    LandmarkGraph graph = random_graph(random);
    std::vector<LandmarkId> ids;
    for (const auto& [id, landmark] : graph.landmarks())
      if (random() % 2 == 0) ids.push_back(id);
    for (const LandmarkId id : ids) {
      Landmark* const changed = graph.find(id);
      changed->category = "dock & door";
      changed->level = static_cast<int>(random() % 5) - 2;
      changed->T_map_landmark.theta_rad = random_number(random);
      changed->annotations = R"({"nav2":{"properties":{"a":"<&\">"}},"z":[1,2.5]})";
    }
    for (std::uint64_t i = random() % 3; i > 0 && !graph.routes().empty(); --i) {
      Route route = graph.routes().begin()->second;
      route.id = static_cast<RouteId>(100 + 7 * i);
      route.speed_limit_mps = 0.1;
      route.closed = route.driven = true;
      route.annotations = R"({"lane":3})";
      route.level = 1;
      graph.add_route(route);
    }
    const ExportedGraph written = graphml_of(graph);
    expect_same_content(parse_graphml(written.text, "a").graph, graph);
    EXPECT_THAT(written.warnings, IsEmpty());
    ASSERT_FALSE(HasFailure()) << written.text;
  }
}

TEST(GraphMl, SaysWhatItCannotHold) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.name = "a\x1B";
  landmark.access = Pose2{};
  graph.add(landmark);
  graph.add_route({0, 1, 1, 0.0, {{}, {}}, false, false, 0});
  const ExportedGraph written = graphml_of(graph);
  EXPECT_THAT(written.text, HasSubstr(">a?<"));
  EXPECT_THAT(written.warnings, ElementsAre("1 landmark: where a robot stands at it is not written",
                                            "1 route: the trajectory is not written",
                                            "1 text: what XML cannot hold (control characters) is written as \"?\""));
}

TEST(Graphml, KeepsWhichLandmarksArePrintedTags) {
  LandmarkGraph graph;
  Landmark tag;
  tag.marker = MarkerId{MarkerFamily::tag25h9, 7};
  graph.add(tag);
  const ExportedGraph exported = graphml_of(graph);
  EXPECT_NE(exported.text.find(">tag 25h9 7<"), std::string::npos);
  EXPECT_TRUE(exported.warnings.empty());
  EXPECT_EQ(parse_graphml(exported.text, "tags.graphml").graph.landmarks(), graph.landmarks());
}

}  // namespace
}  // namespace cairn
