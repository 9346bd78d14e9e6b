#include "maps/exchange/graphs/nav2_routes.hpp"

#include <nlohmann/json.hpp>

#include "tests/maps/exchange/exchange_fixture.hpp"

namespace cairn {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string kCrs = R"("crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::3857"}},)";

std::string node(const std::string& properties, const std::string& coordinates = "[1, 2]") {
  return R"({"type": "Feature", "properties": {)" + properties + R"(}, "geometry": {"type": "Point", "coordinates": )" +
         coordinates + "}}";
}

std::string edge(const std::string& properties, const std::string& coordinates = "[[[1, 2], [4, 6]]]") {
  return R"({"type": "Feature", "properties": {)" + properties +
         R"(}, "geometry": {"type": "MultiLineString", "coordinates": )" + coordinates + "}}";
}

// Each feature in a line of its own, the first in line 2.
std::string collection(const std::vector<std::string>& features, const std::string& crs = kCrs) {
  std::string text = R"({"type": "FeatureCollection", "name": "graph", )" + crs + "\"features\": [";
  for (const std::string& feature : features) text += (&feature == &features.front() ? "\n" : ",\n") + feature;
  return text + "\n]}\n";
}

const std::string kTwoNodes = node(R"("id": 1)") + ",\n" + node(R"("id": 2)", "[4, 6]");

ImportedGraph read(const std::vector<std::string>& features, const std::string& crs = kCrs) {
  return parse_nav2_routes(collection(features, crs), "a.geojson");
}
std::string refused(const std::string& feature) {
  return refusal_of(parse_nav2_routes, collection({kTwoNodes, feature}));
}

// The features of a text, by kind and id.
std::map<std::pair<bool, std::int64_t>, json> features_of(const std::string& text) {
  std::map<std::pair<bool, std::int64_t>, json> features;
  const json all = json::parse(text);
  for (const json& feature : all.at("features"))
    features[{feature["geometry"]["type"] == "Point", feature["properties"]["id"]}] = feature;
  return features;
}

TEST(Nav2Routes, NodesAreLandmarksAndEdgesRoutes) {
  const ImportedGraph graph =
      read({node(R"("id": 1, "frame": "map", "metadata": {"class": "dock", "name": "front desk"})"),
            node(R"("id": 2)", "[4, 6]"),
            edge(R"("id": 3, "startid": 1, "endid": 2, "cost": 7.25, "metadata": {"abs_speed_limit": 0.4})")});
  EXPECT_EQ(graph.graph.find(1)->name, "front desk");
  EXPECT_EQ(graph.graph.find(1)->category, "dock");
  EXPECT_EQ(graph.graph.find(2)->T_map_landmark, (Pose2{4.0, 6.0, 0.0}));
  const Route& route = *graph.graph.find_route(3);
  EXPECT_EQ(route.from, 1);
  EXPECT_EQ(route.to, 2);
  EXPECT_EQ(route.cost_m, 7.25);
  EXPECT_EQ(route.speed_limit_mps, 0.4);
  EXPECT_THAT(graph.warnings, IsEmpty());
}

TEST(Nav2Routes, AnEdgeIsALineStringOrAMultiLineStringOfOneOrSeveralLines) {
  const auto edge_of = [](const std::string& type, const std::string& coordinates) {
    return R"({"type": "Feature", "properties": {"id": 3, "startid": 1, "endid": 2}, "geometry": {"type": ")" + type +
           R"(", "coordinates": )" + coordinates + "}}";
  };
  for (const auto& [type, coordinates] :
       std::vector<std::pair<std::string, std::string>>{{"LineString", "[[1, 2], [4, 6]]"},
                                                        {"MultiLineString", "[[[1, 2], [4, 6]]]"},
                                                        {"MultiLineString", "[[[1, 2], [2, 3]], [[2, 3], [4, 6]]]"}}) {
    const ImportedGraph graph = read({kTwoNodes, edge_of(type, coordinates)});
    ASSERT_NE(graph.graph.find_route(3), nullptr) << type << " " << coordinates;
    EXPECT_EQ(graph.graph.find_route(3)->from, 1);
    EXPECT_EQ(graph.graph.find_route(3)->to, 2);
    EXPECT_EQ(graph.graph.find_route(3)->cost_m, 5.0);
  }
}

TEST(Nav2Routes, ACostThatIsNotSetIsTheStraightLengthAndStaysNotSet) {
  const ImportedGraph graph = read({kTwoNodes, edge(R"("id": 3, "startid": 1, "endid": 2)"),
                                    edge(R"("id": 4, "startid": 2, "endid": 1, "cost": 0, "overridable": false)")});
  EXPECT_EQ(graph.graph.find_route(3)->cost_m, 5.0);
  EXPECT_EQ(graph.graph.find_route(4)->cost_m, 5.0);
  EXPECT_THAT(graph.warnings, ElementsAre("2 edges: no cost (absent or 0), the straight length is taken",
                                          "1 edge: no cost and not overridable, nav2 refuses to search such a graph"));
  auto written = features_of(nav2_routes_of(graph.graph).text);
  EXPECT_FALSE((written[{false, 3}]["properties"].contains("cost")));
  EXPECT_EQ((written[{false, 4}]["properties"]["cost"]), 0);
}

TEST(Nav2Routes, PropertiesComeOutAsTheyWentIn) {
  const std::string text = collection(
      {node(R"("id": 0, "frame": "odom", "metadata": {"region": {"x": [1.0, -1, 0.1]}, "n": 18446744073709551615},
               "operations": [{"type": "stop", "trigger": "NODE", "metadata": {"wait_for": 5.0}},
                              {"type": "stop", "trigger": "ON_EXIT"}])",
            "[0.1, 1e-7, 3.25]"),
       node(R"("id": 5, "colour": null)", "[0.30000000000000004, -123456789.123]"),
       edge(R"("id": 9, "startid": 5, "endid": 0, "cost": 1.5, "overridable": false, "metadata": {"speed_limit": 85},
               "operations": {"door": {"type": "open_door", "trigger": "ON_ENTER", "metadata": {"door_id": 54}},
                              "bell": {"type": "open_door", "trigger": "ON_EXIT"}})",
            "[[[0.5, 0], [1, 1], [2, 2.5]]]")});
  const LandmarkGraph graph = parse_nav2_routes(text, "a").graph;
  EXPECT_EQ(graph.find(6)->name, "0") << "node 0";
  EXPECT_EQ(features_of(nav2_routes_of(graph).text), features_of(text));
}

TEST(Nav2Routes, WhatHasChangedSinceIsWritten) {
  LandmarkGraph graph =
      read({node(R"("id": 1, "metadata": {"name": "gate", "class": "door", "floor": 3})"), node(R"("id": 2)"),
            edge(R"("id": 3, "startid": 1, "endid": 2, "cost": 2, "metadata": {"abs_speed_limit": 0.5})")})
          .graph;
  graph.find(1)->name = "north gate";
  graph.find(1)->category.clear();
  graph.find(2)->name = "dock";
  Route faster = *graph.find_route(3);
  faster.id = 0;
  faster.cost_m = 1.25;
  faster.speed_limit_mps.reset();
  graph.add_route(faster);
  auto written = features_of(nav2_routes_of(graph).text);
  EXPECT_EQ((written[{true, 1}]["properties"]),
            json::parse(R"({"id": 1, "metadata": {"floor": 3, "name": "north gate"}})"));
  EXPECT_EQ((written[{true, 2}]["properties"]["metadata"]["name"]), "dock");
  EXPECT_EQ((written[{false, 4}]["properties"]), json::parse(R"({"id": 4, "startid": 1, "endid": 2, "cost": 1.25})"));
}

TEST(Nav2Routes, IdsAreUniqueAcrossNodesAndEdges) {
  const ImportedGraph graph =
      read({kTwoNodes, edge(R"("id": 2, "startid": 1, "endid": 2)"), edge(R"("id": 7, "startid": 1, "endid": 2)"),
            edge(R"("id": 7, "startid": 2, "endid": 1)"), edge(R"("id": 0, "startid": 2, "endid": 1)")});
  EXPECT_EQ(graph.graph.find_route(8)->from, 2) << "the second edge 7";
  EXPECT_EQ(graph.graph.find_route(9)->from, 2) << "edge 0";
  EXPECT_THAT(graph.warnings, Contains("2 edges: id 0 or an id that an earlier edge has, a new id is given"));
  const ExportedGraph written = nav2_routes_of(graph.graph);
  std::vector<std::int64_t> ids;
  const json all = json::parse(written.text);
  for (const json& feature : all.at("features")) ids.push_back(feature["properties"]["id"]);
  EXPECT_THAT(ids, ElementsAre(1, 2, 10, 7, 8, 0));
  EXPECT_THAT(written.warnings,
              ElementsAre("1 edge: the id is a node's, so it got one above all others: nav2 wants them unique"));
}

TEST(Nav2Routes, NamesAndCategoriesHoldNoControlCharacters) {
  EXPECT_EQ(refused(node(R"("id": 3, "name": "a\u001b[2J")")),
            "4:53: the name \"a\\x1b[2J\" holds a control character");
  EXPECT_EQ(refused(node(R"("id": 3, "metadata": {"class": "\u202edock"})")),
            "4:67: the category \"\\u202edock\" holds a control character");
}

TEST(Nav2Routes, EdgesHaveRealCoordinates) {
  LandmarkGraph graph = read({kTwoNodes}).graph;
  graph.add_route({3, 1, 2, 5.0, {}, false, false, 0});
  graph.add_route({4, 2, 1, 6.0, {{4, 6, 1}, {0.1, 9, 1}, {1, 2, 1}}, false, false, 0});
  graph.add_route({5, 2, 1, 6.0, {}, false, true, 0});
  const ExportedGraph written = nav2_routes_of(graph);
  auto features = features_of(written.text);
  EXPECT_EQ((features[{false, 3}]["geometry"]["coordinates"]), json::parse("[[[1.0, 2.0], [4.0, 6.0]]]"));
  EXPECT_EQ((features[{false, 4}]["geometry"]["coordinates"]), json::parse("[[[4.0, 6.0], [0.1, 9.0], [1.0, 2.0]]]"));
  EXPECT_EQ(features.size(), 4U) << "a closed route is left out";
  EXPECT_THAT(written.warnings,
              ElementsAre("1 route: closed, and so left out: whoever reads the file would drive there"));
  EXPECT_EQ(json::parse(written.text)["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::3857");
}

TEST(Nav2Routes, IdsThatMessagesCannotNameAreAWarning) {
  LandmarkGraph graph;
  Landmark far;
  far.id = 65536;
  graph.add(far);
  EXPECT_THAT(nav2_routes_of(graph).warnings,
              ElementsAre("1 feature: the id is above 65535, which nav2's messages cannot name",
                          "there is no edge: nav2 refuses such a graph"));
}

TEST(Nav2Routes, OtherCrsAndHeightsAreAcceptedByRule) {
  const std::string with_edge =
      edge(R"("id": 3, "startid": 1, "endid": 2, "cost": 1, "operation": {}, "frame": "odom")");
  EXPECT_THAT(read({kTwoNodes, with_edge, node(R"("id": 4)", "[0, 0, 7]")}, "").warnings,
              ElementsAre("there is no crs: coordinates are taken as metres in the map frame",
                          "1 node: the third coordinate is kept, but not used",
                          "1 feature: the frame is not \"map\"; coordinates are taken as they are",
                          "1 feature: nav2 reads \"operations\", not \"operation\""));
  EXPECT_THAT(read({kTwoNodes}, R"("crs": {"type": "name", "properties": {"name": "EPSG:25832"}},)").warnings,
              Contains("crs is \"EPSG:25832\", not EPSG:3857: coordinates are taken as metres in the map frame"));
  EXPECT_THAT(read({kTwoNodes}, R"("crs": null,)").warnings, Contains(HasSubstr("there is no crs")));
}

TEST(Nav2Routes, RefusesDegrees) {
  for (const char* name : {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326"})
    EXPECT_EQ(
        refusal_of(parse_nav2_routes, collection({kTwoNodes}, R"("crs": {"type": "name", "properties": {"name": ")" +
                                                                  std::string(name) + "\"}},")),
        "1:95: crs \"" + std::string(name) +
            "\" has degrees of longitude and latitude; a map needs metres in its own frame");
}

TEST(Nav2Routes, RefusesBadIds) {
  EXPECT_EQ(refused(node(R"("id": -3)")), "4:42: id -3 is not a whole number of 0 to 9007199254740991");
  EXPECT_EQ(refused(node(R"("id": 3.0)")), "4:42: id 3.0 is not a whole number of 0 to 9007199254740991");
  EXPECT_EQ(refused(node(R"("id": "3")")), "4:42: id \"3\" is not a whole number of 0 to 9007199254740991");
  EXPECT_EQ(refused(node(R"("id": 9007199254740992)")),
            "4:42: id 9007199254740992 is not a whole number of 0 to 9007199254740991");
  EXPECT_EQ(refused(node("")), "4:35: the feature has no id");
  EXPECT_EQ(refused(node(R"("id": 2)")), "4:42: node 2 is there already, in line 3");
  EXPECT_EQ(refused(edge(R"("id": 3, "startid": 1)")), "4:35: the feature has no endid");
  EXPECT_EQ(refused(edge(R"("id": 3, "startid": 1, "endid": 9)")), "4:68: endid: there is no node 9");
  EXPECT_EQ(refused(edge(R"("id": 3, "startid": 0, "endid": 1)")), "4:56: startid: there is no node 0");
}

TEST(Nav2Routes, RefusesBadProperties) {
  const std::string ends = R"("id": 3, "startid": 1, "endid": 2, )";
  EXPECT_EQ(refused(edge(ends + R"("cost": -1)")), "4:79: cost -1 is not allowed: it must not be negative");
  EXPECT_EQ(refused(edge(ends + R"("cost": "dear")")), "4:79: cost must be a number, is string");
  EXPECT_THAT(refused(edge(ends + R"("cost": NaN)")), StartsWith("4:79: is not JSON: syntax error"));
  EXPECT_THAT(refused(edge(ends + R"("cost": 1e999)")), HasSubstr("4:1: is not accepted: number overflow"));
  EXPECT_EQ(refused(edge(ends + R"("overridable": 1)")), "4:86: overridable must be true or false, is number");
  EXPECT_EQ(refused(node(R"("id": 3, "metadata": [])")), "4:57: metadata must be an object, is array");
  EXPECT_EQ(refused(node(R"("id": 3, "frame": 4)")), "4:54: frame must be a text, is number");
  EXPECT_EQ(refused(edge(ends + R"("metadata": {"abs_speed_limit": -1})")),
            "4:103: abs_speed_limit -1 is not a speed in m/s: it must be a number that is not negative");
  EXPECT_EQ(refused(node(R"("id": 3, "id": 4)")), "4:45: the key \"id\" is in this object twice");
}

TEST(Nav2Routes, RefusesBadOperations) {
  EXPECT_EQ(refused(node(R"("id": 3, "operations": "stop")")),
            "4:59: operations must be an object or an array, is string");
  EXPECT_EQ(refused(node(R"("id": 3, "operations": [{"trigger": "NODE"}])")),
            "4:60: an operation is an object with a type, a text");
  EXPECT_EQ(refused(node(R"("id": 3, "operations": {"a": {"type": "stop", "trigger": "ON_ENTR"}})")),
            "4:93: unknown trigger \"ON_ENTR\" (did you mean \"ON_ENTER\"?): allowed are NODE, ON_ENTER and ON_EXIT");
  EXPECT_EQ(refused(node(R"("id": 3, "operations": {"a": {"type": "stop"}})")),
            "4:65: an operation needs a trigger: NODE, ON_ENTER or ON_EXIT");
}

TEST(Nav2Routes, RefusesBadGeometry) {
  const std::string numbers = "a point must be 2 or 3 numbers, [x_m, y_m] or [x_m, y_m, z_m], is ";
  EXPECT_EQ(refused(node(R"("id": 3)", "[1]")), "4:91: " + numbers + "\"[1]\"");
  EXPECT_EQ(refused(node(R"("id": 3)", "[1, 2, 3, 4]")), "4:91: " + numbers + "\"[1,2,3,4]\"");
  EXPECT_EQ(refused(node(R"("id": 3)", "[1, null]")), "4:91: " + numbers + "\"[1,null]\"");
  EXPECT_EQ(refused(node(R"("id": 3)", "[1, -1e300]")),
            "4:91: the coordinate -1e+300 is not allowed: it must be within 1e+09 m");
  EXPECT_EQ(refused(edge(R"("id": 3, "startid": 1, "endid": 2)", "[[[1, 2], [3]]]")), "4:137: " + numbers + "\"[3]\"");
  EXPECT_EQ(refused(edge(R"("id": 3, "startid": 1, "endid": 2)", "[[[1, 2], [3, 4]], 7]")),
            "4:146: a line must be an array of points");
  EXPECT_EQ(refused(R"({"type": "Feature", "properties": {"id": 4}, "geometry": {"type": "Polygon"}})"),
            "4:67: geometry of type \"Polygon\": allowed are Point (a node), LineString and MultiLineString (an edge)");
  EXPECT_EQ(refused(R"({"type": "Feature", "properties": {"id": 4}, "geometry": null})"),
            "4:58: a feature needs geometry, an object");
  EXPECT_EQ(refused(R"({"type": "Feature", "geometry": {}})"), "4:1: a feature needs properties, an object");
  EXPECT_EQ(refused("[1]"), "4:1: a feature must be an object, is array");
  EXPECT_EQ(refused(R"({"type": "feature"})"), "4:10: the type of a feature must be \"Feature\"");
}

TEST(Nav2Routes, RefusesWhatIsNoFeatureCollection) {
  const auto refused_text = [](const std::string& text) { return refusal_of(parse_nav2_routes, text); };
  EXPECT_EQ(refused_text(""), "1:1: expected an object, {...}; the file ends here, it may have been cut");
  EXPECT_EQ(refused_text("[]"), "1:1: expected an object, {...}, found \"[]\"");
  EXPECT_EQ(refused_text("{}"), "1:1: is not a FeatureCollection: \"type\": \"FeatureCollection\" is missing");
  EXPECT_EQ(refused_text(R"({"type": "Feature"})"), "1:10: type must be \"FeatureCollection\", is \"\"Feature\"\"");
  EXPECT_EQ(refused_text(R"({"type": "FeatureCollection"})"), "1:1: has no \"features\"");
  EXPECT_EQ(refused_text(R"({"type": "FeatureCollection", "features": []})"), "1:43: holds no node (a Point feature)");
  EXPECT_EQ(refused_text(R"({"type": "FeatureCollection", "features": {}})"),
            "1:43: expected an array, [...], found \"{}}\"");
  EXPECT_EQ(refused_text(collection({kTwoNodes}) + "x"), "5:1: nothing may follow the closing bracket");
  EXPECT_EQ(refused_text(collection({kTwoNodes + " " + kTwoNodes})), "3:100: expected , or ], found \"{\"");
}

TEST(Nav2Routes, DeepNestingIsRefusedAndNotFollowed) {
  const std::string deep(100'000, '[');
  EXPECT_EQ(refused(node(R"("id": 3, "metadata": {"a": )" + deep)), "4:122: nests deeper than 64 brackets");
  EXPECT_EQ(refused(node(R"("id": 3, "metadata": {"a": )" + std::string(59, '[') + std::string(59, ']') + "}")),
            "accepted");
}

TEST(Nav2Routes, AFileCutAnywhereIsRefused) {
  const std::string whole = collection({kTwoNodes, edge(R"("id": 3, "startid": 1, "endid": 2)")});
  for (std::size_t size = 0; size < whole.size() - 2; ++size)
    EXPECT_NE(refusal_of(parse_nav2_routes, whole.substr(0, size)), "accepted") << size;
  EXPECT_THAT(refusal_of(parse_nav2_routes, whole.substr(0, 200)),
              testing::EndsWith("; the file ends here, it may have been cut"));
}

TEST(Nav2Routes, WhatIsWrittenReadsBackTheSame) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 200; ++round) {
    LandmarkGraph graph = random_graph(random);
    for (auto& [id, landmark] : graph.landmarks())
      if (random() % 3 == 0) graph.find(id)->category = "dock";
    const ExportedGraph written = nav2_routes_of(graph);
    const LandmarkGraph again = parse_nav2_routes(written.text, "a").graph;
    ASSERT_EQ(again.landmarks().size(), graph.landmarks().size());
    for (const auto& [id, landmark] : graph.landmarks()) {
      ASSERT_NE(again.find(id), nullptr);
      EXPECT_EQ(again.find(id)->name, landmark.name);
      EXPECT_EQ(again.find(id)->category, landmark.category);
      EXPECT_EQ(again.find(id)->T_map_landmark, landmark.T_map_landmark);
    }
    auto route = again.routes().begin();
    std::vector<std::tuple<LandmarkId, LandmarkId, double>> routes;
    std::vector<std::tuple<LandmarkId, LandmarkId, double>> routes_again;
    for (const auto& [id, r] : graph.routes())
      if (r.cost_m > 0.0) routes.emplace_back(r.from, r.to, r.cost_m);
    for (; route != again.routes().end(); ++route) {
      const json properties = json::parse(route->second.annotations)["nav2"].value("properties", json::object());
      if (properties.value("cost", 0.0) > 0.0)
        routes_again.emplace_back(route->second.from, route->second.to, route->second.cost_m);
    }
    EXPECT_THAT(routes_again, testing::UnorderedElementsAreArray(routes));
    EXPECT_EQ(features_of(nav2_routes_of(again).text), features_of(written.text));
    ASSERT_FALSE(HasFailure()) << written.text;
  }
}

TEST(Nav2Routes, AnnotationsThatAreNoObjectAreABug) {
  LandmarkGraph graph;
  Landmark landmark;
  landmark.annotations = "[1]";
  graph.add(landmark);
  EXPECT_THROW(static_cast<void>(nav2_routes_of(graph)), std::invalid_argument);
}

TEST(Nav2Routes, TheGraphsOfNav2ItselfSurviveARoundTrip) {
  if (!std::filesystem::exists(nav2_folder()))
    GTEST_SKIP() << "needs graphs/nav2_route of the data folder (CAIRN_DATA)";
  for (const char* name : {"sample_graph.geojson", "turtlebot3_sandbox_graph.geojson", "depot_graph.geojson"}) {
    const std::string text = file_text(nav2_folder() / name);
    const LandmarkGraph graph = parse_nav2_routes(text, name).graph;
    const auto before = json::parse(text)["features"];
    const auto after = json::parse(nav2_routes_of(graph).text)["features"];
    EXPECT_EQ(before.size(), after.size()) << name;
    const std::string written = nav2_routes_of(parse_nav2_routes(nav2_routes_of(graph).text, name).graph).text;
    EXPECT_EQ(written, nav2_routes_of(graph).text) << name;
    if (std::string(name).starts_with("depot")) continue;  // it has six edge ids twice
    auto expected = features_of(text);
    for (const auto& [id, feature] : features_of(nav2_routes_of(graph).text))
      EXPECT_EQ(feature["properties"], expected[id]["properties"]) << name;
  }
}

}  // namespace
}  // namespace cairn
