#include "framework/files/rmf_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "maps/exchange/graphs/rmf_nav_graph.hpp"
#include "tests/framework/config/config_test_support.hpp"

namespace cairn {
namespace {

using config_test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr const char* kNav = R"(building_name: "lab 1"
levels:
  L1:
    vertices:
      - [0, 0, {name: dock, is_charger: true, mutex: "7"}]
      - [3, 4, {name: ""}]
      - [3.5, -4.25]
    lanes:
      - [0, 1, {speed_limit: 0.5, dock_name: d, orientation_constraint: forward}]
      - [1, 0, {speed_limit: 0.0}]
      - [1, 2, {is_bidirectional: true}]
  upper:
    vertices:
      - [0, 0, {name: desk, is_holding_point: true, lift: lift1}]
    lanes: []
doors: {d1: {endpoints: [[0, 1], [1, 1]], map: L1}}
lifts: {lift1: {position: [1, 2, 0.5], dims: [2.0, 3]}}
)";

ImportedGraph read(const std::string& text) {
  return rmf_graph_of(parse_config_text(text, "nav.yaml"));
}
std::string refusal(const std::string& text) {
  return error_of([&] {
    const ConfigValue root = parse_config_text(text, "nav.yaml");
    if (is_rmf(root)) static_cast<void>(rmf_graph_of(root));
  });
}
std::string changed(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

TEST(RmfNavGraph, VerticesAreLandmarksAndLanesAreRoutes) {
  const ImportedGraph imported = read(kNav);
  EXPECT_THAT(imported.warnings, IsEmpty());
  const LandmarkGraph& graph = imported.graph;
  ASSERT_EQ(graph.landmarks().size(), 4U);
  EXPECT_EQ(graph.find(1)->name, "dock");
  EXPECT_EQ(graph.find(1)->category, "charger");
  EXPECT_EQ(graph.find(3)->T_map_landmark, (Pose2{3.5, -4.25, 0.0}));
  EXPECT_EQ(graph.find(4)->level, 1);
  EXPECT_EQ(graph.find(4)->category, "holding_point");
  ASSERT_EQ(graph.routes().size(), 4U);
  EXPECT_EQ(graph.find_route(1)->cost_m, 5.0);
  EXPECT_EQ(graph.find_route(1)->speed_limit_mps, 0.5);
  EXPECT_EQ(graph.find_route(2)->speed_limit_mps, std::nullopt);
  EXPECT_EQ(graph.find_route(4)->from, 3);
}

TEST(RmfNavGraph, FloorsOfOneNameAreDistinguished) {
  LandmarkGraph graph;
  for (const int level : {0, 1, 2}) {
    Landmark landmark;
    landmark.level = level;
    if (level != 1) landmark.annotations = R"({"rmf": {"level": "L2"}})";  // as the second floor is called unasked
    graph.add(landmark);
  }
  const std::string text = rmf_nav_graph_of(graph, "").text;
  for (const char* const name : {"\n  L2:\n", "\n  L2_1:\n", "\n  L2_2:\n"}) EXPECT_THAT(text, HasSubstr(name));
  EXPECT_EQ(read(text).graph.landmarks().size(), 3U);
}

TEST(RmfNavGraph, GoesOutAsItCameIn) {
  const ImportedGraph once = read(kNav);
  const ExportedGraph written = rmf_nav_graph_of(once.graph, once.properties.at("rmf"));
  EXPECT_THAT(written.warnings, IsEmpty());
  EXPECT_EQ(written.text, R"(building_name: "lab 1"
levels:
  L1:
    lanes:
      - [0, 1, {dock_name: d, orientation_constraint: forward, speed_limit: 0.5}]
      - [1, 0, {speed_limit: 0.0}]
      - [1, 2, {}]
      - [2, 1, {}]
    vertices:
      - [0.0, 0.0, {name: dock, is_charger: true, mutex: "7"}]
      - [3.0, 4.0, {name: ""}]
      - [3.5, -4.25, {name: ""}]
  upper:
    lanes: []
    vertices:
      - [0.0, 0.0, {name: desk, is_holding_point: true, lift: lift1}]
doors: {d1: {endpoints: [[0, 1], [1, 1]], map: L1}}
lifts: {lift1: {position: [1, 2, 0.5], dims: [2.0, 3]}}
)");
  const ImportedGraph again = read(written.text);
  EXPECT_EQ(again.graph, once.graph);
  EXPECT_EQ(again.properties, once.properties);
}

TEST(RmfNavGraph, NumbersWithAPlusSignGoOutAsNumbers) {
  const ImportedGraph once = read(changed(kNav, "speed_limit: 0.0", "speed_limit: +.0, seats: +4, sign: +-4"));
  const std::string written = rmf_nav_graph_of(once.graph, once.properties.at("rmf")).text;
  EXPECT_THAT(written, HasSubstr("{speed_limit: 0.0, seats: 4, sign: \"+-4\"}"));
  EXPECT_EQ(read(written).graph, once.graph);
}

TEST(RmfNavGraph, ReportsWhatItCannotHold) {
  LandmarkGraph graph;
  for (int i = 0; i < 3; ++i) {
    Landmark landmark;
    landmark.category = i == 0 ? "square" : "charger";
    landmark.level = i / 2;
    landmark.T_map_landmark = {static_cast<double>(i), 0.0, 0.0};
    graph.add(landmark);
  }
  graph.add_route({0, 1, 2, 1.5, {}, false, false, 0});
  graph.add_route({0, 1, 3, 2.0, {}, false, false, 0});
  graph.add_route({0, 2, 1, 1.0, {}, false, true, 0});
  const ExportedGraph written = rmf_nav_graph_of(graph, "");
  EXPECT_THAT(written.warnings,
              ElementsAre(HasSubstr("1 route: closed, and so left out"), "1 landmark: the category is not written",
                          "1 route: the cost is not written; to Open-RMF a lane is straight",
                          "1 route: it leads to another floor, and so is left out: lanes stay on theirs"));
  EXPECT_THAT(written.text, HasSubstr("- [1.0, 0.0, {name: \"\", is_charger: true}]"));
  EXPECT_THAT(written.text, HasSubstr("  L2:\n    lanes: []\n"));
  EXPECT_EQ(read(written.text).graph.routes().size(), 1U);
  EXPECT_THROW(static_cast<void>(rmf_nav_graph_of(graph, "[1]")), std::invalid_argument);
}

TEST(RmfNavGraph, FaultsAreRefusedWithTheirPlace) {
  EXPECT_EQ(refusal(changed(kNav, "[1, 0,", "[1, 3,")),
            "nav.yaml:10:13: there is no vertex 3: the level has 3, the first is 0");
  EXPECT_EQ(refusal(changed(kNav, "orientation_constraint: forward", "orientation_constraint: foward")),
            "nav.yaml:9:73: orientation_constraint must be one of forward, backward, found \"foward\" (did you mean "
            "\"forward\"?)");
  EXPECT_EQ(refusal(changed(kNav, "vertices:", "vertexes:")),
            "nav.yaml:4:5: unknown key \"vertexes\" (did you mean \"vertices\"?) in the level \"L1\"");
  EXPECT_EQ(refusal(changed(kNav, "levels:", "levles:")),
            "nav.yaml:2:1: unknown key \"levles\" (did you mean \"levels\"?)");
  EXPECT_EQ(refusal(changed(kNav, "[3, 4,", "[.nan, 4,")).substr(0, 14), "nav.yaml:6:10:");
  EXPECT_EQ(refusal(changed(kNav, "speed_limit: 0.5", "speed_limit: -1")).substr(0, 14), "nav.yaml:9:30:");
  EXPECT_THAT(refusal(changed(kNav, "name: desk", "name: \"a\\nb\"")),
              testing::MatchesRegex("nav.yaml:[0-9]+:[0-9]+: name \"a.nb\" holds the control character .x0a"));
  EXPECT_THAT(refusal("levels: [1]"), HasSubstr("nav.yaml:1:9: levels must be a map"));
  EXPECT_THAT(refusal("levels: {L1: {vertices: [], lanes: []}}"), HasSubstr("the levels hold no vertex"));
  EXPECT_THAT(refusal("levels: {L1: {vertices: [[1]], lanes: []}}"), HasSubstr("a vertex must be [x, y, {...}]"));
}

TEST(RmfNavGraph, ASlipInAPropertyIsKeptAndReported) {
  EXPECT_THAT(read(changed(kNav, "is_charger", "is_chargr")).warnings,
              ElementsAre("nav.yaml:5:29: the property \"is_chargr\" (did you mean \"is_charger\"?) is kept as it is"));
}

// The upper drawing is turned by a quarter, twice as fine and shifted: its vertices lie over those of the first.
constexpr const char* kBuilding = R"(name: house
coordinate_system: reference_image
levels:
  L1:
    elevation: 0
    measurements: [[0, 1, {distance: [3, 5]}]]
    fiducials: [[0, 0, a], [100, 0, b], [0, 50, c]]
    lanes: [[0, 1, {bidirectional: [4, true], orientation: [1, forward], graph_idx: [2, 0], mutex: [1, ""]}],
            [1, 2, {bidirectional: [4, false], speed_limit: [3, 0.4]}]]
    vertices: [[10, 20, 0, dock, {is_charger: [4, true]}], [110, 20, 0, ""], [10, 60, 0, ""], [9, 9, 0, ""]]
  L2:
    elevation: 3
    fiducials: [[500, 0, c], [600, 0, a], [600, 200, b]]
    lanes: [[0, 1, {}]]
    vertices: [[560, 20, 0, ""], [560, 220, 0, ""]]
lifts: {}
)";

TEST(RmfBuilding, PixelsBecomeMetresAndLevelsLieOverEachOther) {
  const ImportedGraph imported = read(kBuilding);
  const LandmarkGraph& graph = imported.graph;
  ASSERT_EQ(graph.landmarks().size(), 5U);
  EXPECT_THAT(imported.warnings,
              ElementsAre("level \"L1\": 1 vertex without name and lane, of walls and floors: no landmark"));
  EXPECT_NEAR(graph.find(1)->T_map_landmark.x_m, 0.5, 1e-12);
  EXPECT_NEAR(graph.find(1)->T_map_landmark.y_m, -1.0, 1e-12);
  EXPECT_EQ(graph.find(1)->category, "charger");
  for (const LandmarkId id : {1, 2}) {
    EXPECT_NEAR(graph.find(id)->T_map_landmark.x_m, graph.find(id + 3)->T_map_landmark.x_m, 1e-9) << id;
    EXPECT_NEAR(graph.find(id)->T_map_landmark.y_m, graph.find(id + 3)->T_map_landmark.y_m, 1e-9) << id;
    EXPECT_EQ(graph.find(id + 3)->level, 1);
  }
  ASSERT_EQ(graph.routes().size(), 4U);
  EXPECT_NEAR(graph.find_route(1)->cost_m, 5.0, 1e-12);
  EXPECT_THAT(graph.find_route(1)->annotations, HasSubstr(R"("orientation_constraint":"forward")"));
  EXPECT_THAT(graph.find_route(2)->annotations, HasSubstr(R"("orientation_constraint":"backward")"));
  EXPECT_EQ(graph.find_route(3)->speed_limit_mps, 0.4);
  const ExportedGraph written = rmf_nav_graph_of(graph, imported.properties.at("rmf"));
  EXPECT_TRUE(written.text.starts_with("building_name: house\n"));
  EXPECT_EQ(read(written.text).graph, graph);
}

TEST(RmfBuilding, WhatCannotBePlacedIsRefusedOrReported) {
  EXPECT_EQ(refusal(changed(kBuilding, "reference_image", "wgs84")),
            "nav.yaml:2:20: the coordinate system wgs84 is not of metres: a map needs metres");
  EXPECT_THAT(refusal(changed(kBuilding, "reference_image", "cartesian_meter")), HasSubstr("did you mean"));
  EXPECT_THAT(refusal(changed(kBuilding, "[0, 1, {distance", "[0, 9, {distance")),
              HasSubstr("nav.yaml:6:24: there is no vertex 9"));
  EXPECT_THAT(refusal(changed(kBuilding, "[4, true]", "true")), HasSubstr("must be [type, value]"));
  EXPECT_THAT(refusal(changed(kBuilding, "vertices", "vertises")), HasSubstr("did you mean \"vertices\""));
  EXPECT_THAT(read(changed(kBuilding, "[500, 0, c], [600, 0, a], [600, 200, b]", "[1, 1, z]")).warnings[1],
              HasSubstr("has no two fiducials in common"));
}

TEST(RmfBuilding, MeasurementsThatPutAVertexAnywhereAreRefused) {
  const auto refusal_at = [](const std::string& near) {
    return refusal("name: b\nlevels:\n  L1:\n    measurements: [[0, 1, {distance: [3, 9]}]]\n    vertices:\n" +
                   ("      - [0, 0, 0, a]\n      - [" + near + ", 0, 0, b]\n      - [1, 0, 0, c]\n"));
  };
  EXPECT_EQ(refusal_at("0.00001"), "no ConfigError");
  for (const char* const near : {"0.000008", "1e-150"})
    EXPECT_EQ(refusal_at(near),
              "nav.yaml:8:9: by the level's measurements and fiducials the vertex is more than 1000 km away");
  EXPECT_EQ(refusal_at("1e-200"), "nav.yaml:4:20: a measurement between two vertices of one place");
}

TEST(RmfBuilding, RecordedBuildingsAreRead) {
  const char* const named = std::getenv("CAIRN_DATA");
  const std::filesystem::path folder =
      (named != nullptr ? std::filesystem::path(named) : std::filesystem::path(CAIRN_SOURCE_DIR) / "../shared/data") /
      "graphs/open_rmf";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "needs graphs/open_rmf of the data folder (CAIRN_DATA)";
  int files = 0;
  for (const char* const name : {"office", "hotel", "battle_royale", "triple_H"}) {
    const ConfigValue root = read_config_file(folder / (std::string(name) + ".building.yaml"));
    ASSERT_TRUE(is_rmf(root));
    const ImportedGraph imported = rmf_graph_of(root);
    EXPECT_GT(imported.graph.routes().size(), 20U) << name;
    const ExportedGraph written = rmf_nav_graph_of(imported.graph, imported.properties.at("rmf"));
    EXPECT_EQ(read(written.text).graph, imported.graph) << name;
    ++files;
  }
  EXPECT_EQ(files, 4);
}

}  // namespace
}  // namespace cairn
