// Graphs of other tools in and out, and names, as a user sees them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

void write_compressed(const std::string& file, const std::string& text) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(file.c_str(), "wb"), gzclose);
  ASSERT_EQ(gzwrite(out.get(), text.data(), static_cast<unsigned>(text.size())), static_cast<int>(text.size()));
}

class Exchange : public testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return (folder_ / name).string(); }
  // Runs `cairn map ...`, expects the exit status and gives standard error.
  static std::string refused(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "map");
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, 2) << finished.err;
    EXPECT_EQ(finished.out, "");
    return finished.err;
  }
  static json done(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "map");
    arguments.emplace_back("--json");
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, 0) << finished.err;
    return json::parse(finished.out, nullptr, false);
  }
  void import_roads() const {
    write_text(file("roads.graph"), "node 17 1 2\nnode 4 4 6 front desk\nnode 0 0 0\nedge 17 4 5\nedge 4 17 7.5\n");
    done({"import", file("roads.graph"), "-o", file("g.cairn")});
  }
  [[nodiscard]] LandmarkGraph graph() const { return load_map(file("g.cairn")).graph; }

  const std::filesystem::path folder_ = fresh_folder("exchange");
};

TEST_F(Exchange, ImportSaysWhatCameIn) {
  write_text(file("roads.graph"), "node 17 1 2\nnode 4 4 6\nnode 0 0 0\nedge 17 4 5");
  const json reported = done({"import", file("roads.graph"), "-o", file("g.cairn")});
  EXPECT_EQ(reported, (json{{"map", file("g.cairn")},
                            {"landmarks", 3},
                            {"routes", 1},
                            {"warnings",
                             {file("roads.graph") + ": the last line has no line end: the file may have been cut",
                              file("roads.graph") + ": node 0 is landmark L18: ids of landmarks begin at 1"}}}));
  EXPECT_EQ(graph().find(17)->T_map_landmark.position(), Point(1.0, 2.0));
}

TEST_F(Exchange, WhatGoesOutComesInAgain) {
  import_roads();
  for (const char* name : {"again.graph", "again.graphml"}) {
    done({"export", file("g.cairn"), "-o", file(name)});
    done({"import", file(name), "-o", file("again.cairn")});
    EXPECT_EQ(load_map(file("again.cairn")).graph, graph()) << name;
  }
  EXPECT_EQ(done({"export", file("g.cairn"), "-o", file("again.geojson")})["routes"], 2);
  EXPECT_EQ(done({"import", file("again.geojson"), "-o", file("again.cairn")})["landmarks"], 3);
  EXPECT_EQ(done({"export", file("g.cairn"), "-o", file("g.png")})["warnings"], json::array());
  EXPECT_EQ(text_of_file(file("g.png")).substr(1, 3), "PNG");
}

TEST_F(Exchange, RefusesExtensionsThatItDoesNotKnow) {
  EXPECT_EQ(
      refused({"import", "a.grph", "-o", file("g.cairn")}),
      "cairn: a.grph: cannot be imported: unknown extension \".grph\" (did you mean \".graph\"?); known are .graph, "
      ".geojson, .json, .graphml, .tntp, .map, .yaml, .yml, .png, .pgm, .bmp\n");
  EXPECT_EQ(refused({"export", file("g.cairn"), "-o", "a"}),
            "cairn: a: cannot be exported to: it has no extension; known are .graph, .geojson, .json, .graphml, .png, "
            ".yaml, .yml\n");
}

TEST_F(Exchange, ABadFileIsRefusedWithItsPlaceAndNothingIsWritten) {
  write_text(file("roads.graph"), "node 1 0 0\nedge 1 2 5\n");
  EXPECT_EQ(refused({"import", file("roads.graph"), "-o", file("g.cairn")}),
            "cairn: " + file("roads.graph") + ":2:8: there is no node 2\n");
  EXPECT_FALSE(std::filesystem::exists(file("g.cairn")));
  EXPECT_EQ(refused({"import", file("none.graph"), "-o", file("g.cairn")}),
            "cairn: " + file("none.graph") + ": no such file\n");
}

TEST_F(Exchange, AMovingAiGridBecomesAMapWithCellsOfOneMetre) {
  write_text(file("small.map"), "type octile\nheight 2\nwidth 3\nmap\n.@.\n...\n");
  EXPECT_EQ(done({"import", file("small.map"), "-o", file("g.cairn")}), (json{{"map", file("g.cairn")},
                                                                              {"size_cells", {3, 2}},
                                                                              {"cell_m", 1.0},
                                                                              {"landmarks", 0},
                                                                              {"routes", 0},
                                                                              {"warnings", json::array()}}));
  const SavedMap map = load_map(file("g.cairn"));
  EXPECT_EQ(map.grid.state(map.grid.cell_at({1.5, 1.5})), CellState::occupied);
  EXPECT_EQ(map.properties.at("imported_from"), "small.map");
  done({"import", file("small.map"), "-o", file("g.cairn"), "--cell-m", "0.5"});
  EXPECT_EQ(load_map(file("g.cairn")).grid.cell_m(), 0.5);
}

TEST_F(Exchange, AMapServerGridKeepsItsPlaceAndItsUnknown) {
  write_text(file("m.pgm"), "P2 3 1 255 0 205 254\n");
  write_text(file("m.yaml"),
             "image: m.pgm\nresolution: 0.1\norigin: [-2, 1, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
             "free_thresh: 0.25\n");
  EXPECT_EQ(
      done({"import", file("m.yaml"), "-o", file("g.cairn")})["warnings"],
      (json{file("m.yaml") + ": grey 205, by which map_server means unknown, counts as free by these thresholds"}));
  const OccupancyGrid grid = load_map(file("g.cairn")).grid;
  EXPECT_EQ(grid.state(grid.cell_at({-1.95, 1.05})), CellState::occupied);
  EXPECT_EQ(grid.state(grid.cell_at({-1.75, 1.05})), CellState::free);
  write_text(file("m.pgm"), "P2 3 1 255 0 2x5 254\n");
  EXPECT_EQ(refused({"import", file("m.yaml"), "-o", file("g.cairn")}),
            "cairn: " + file("m.pgm") + ":1:14: a pixel \"2x5\" is not a whole number of 0 to 255\n");
  std::filesystem::remove(file("m.pgm"));
  EXPECT_EQ(refused({"import", file("m.yaml"), "-o", file("g.cairn")}),
            "cairn: " + file("m.yaml") + ":1:8: image: " + file("m.pgm") + ": no such file\n");
}

TEST_F(Exchange, APictureAloneNeedsTheSizeOfItsPixels) {
  write_text(file("m.pgm"), "P2 3 1 255 0 205 254\n");
  EXPECT_EQ(refused({"import", file("m.pgm"), "-o", file("g.cairn")}),
            "cairn: map import: " + file("m.pgm") +
                " is a picture: --cell-m must give the side of a pixel in metres; 0.05 is usual\n");
  done({"import", file("m.pgm"), "-o", file("g.cairn"), "--cell-m", "0.1"});
  const OccupancyGrid grid = load_map(file("g.cairn")).grid;
  EXPECT_EQ(grid.cell_m(), 0.1);
  EXPECT_EQ(grid.state(grid.cell_at({0.05, 0.05})), CellState::occupied);
  EXPECT_EQ(grid.state(grid.cell_at({0.15, 0.05})), CellState::unknown);
  EXPECT_EQ(grid.state(grid.cell_at({0.25, 0.05})), CellState::free);
}

TEST_F(Exchange, CompressedFilesComeInToo) {
  write_compressed(file("roads.graph.gz"), "node 1 0 0\nnode 2 3 4\nedge 1 2 5\n");
  EXPECT_EQ(done({"import", file("roads.graph.gz"), "-o", file("g.cairn")})["routes"], 1);
  write_compressed(file("m.pgm.gz"), "P2 3 1 255 0 205 254\n");
  write_text(file("m.yaml"),
             "image: m.pgm\nresolution: 0.1\norigin: [-2, 1, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
             "free_thresh: 0.196\n");
  EXPECT_EQ(done({"import", file("m.yaml"), "-o", file("g.cairn")})["size_cells"], (json{3, 1}));
  const std::string whole = text_of_file(file("roads.graph.gz"));
  write_text(file("cut.graph.gz"), whole.substr(0, whole.size() - 10));
  EXPECT_EQ(refused({"import", file("cut.graph.gz"), "-o", file("g.cairn")}),
            "cairn: " + file("cut.graph.gz") + ": the compressed file is cut off\n");
  EXPECT_THAT(refused({"export", file("g.cairn"), "-o", file("out.graph.gz")}), HasSubstr("unknown extension \".gz\""));
}

TEST_F(Exchange, ARoadNetworkIsReadFromItsTwoFiles) {
  write_text(file("town_net.tntp"),
             "<NUMBER OF LINKS> 1\n<FIRST THRU NODE> 2\n<END OF METADATA>\n~ a b c d ;\n"
             "\t1\t2\t900\t5.5\t1 ;\n");
  EXPECT_EQ(refused({"import", file("town_net.tntp"), "-o", file("g.cairn")}),
            "cairn: " + file("town_net.tntp") + ": its nodes are missing: there is no town_node.tntp beside it\n");
  write_text(file("town_node.tntp"), "Node X Y ;\n1 0 0 ;\n2 300 400 ;\n");
  EXPECT_EQ(refused({"import", file("town_node.tntp"), "-o", file("g.cairn")}),
            "cairn: " + file("town_node.tntp") +
                ": a road network is named by its links, NAME_net.tntp; its nodes are "
                "read from NAME_node.tntp beside it\n");
  EXPECT_EQ(done({"import", file("town_net.tntp"), "-o", file("g.cairn")})["warnings"],
            (json{file("town_net.tntp") + ": 1 zone: nodes below the first through node, 2, are passed like others"}));
  EXPECT_EQ(graph().find_route(1)->cost_m, 5.5);
  EXPECT_EQ(graph().find(1)->category, "zone");
}

TEST_F(Exchange, ABadGridIsRefusedWithItsPlace) {
  write_text(file("bad.map"), "type octile\nheight 1\nwidth 3\nmap\n.x.\n");
  EXPECT_EQ(refused({"import", file("bad.map"), "-o", file("g.cairn")}),
            "cairn: " + file("bad.map") + ":5:2: unknown cell \"x\": free are . G S, blocked are @ O T W\n");
  write_text(file("roads.graph"), "node 1 0 0\n");
  EXPECT_EQ(refused({"import", file("roads.graph"), "-o", file("g.cairn"), "--cell-m", "0.5"}),
            "cairn: map import: --cell-m is for Moving AI grids (*.map) and pictures; " + file("roads.graph") +
                " says itself how large it is\n");
  EXPECT_FALSE(std::filesystem::exists(file("g.cairn")));
}

TEST_F(Exchange, NamesOfClustersThatNoFormatHoldsAreToldOf) {
  write_text(file("two.graph"), "node 1 0 0\nnode 2 1 0\n");
  done({"import", file("two.graph"), "-o", file("g.cairn")});
  SavedMap map = load_map(file("g.cairn"));
  map.clusters.cluster_of = {{1, 1}, {2, 1}};
  map.clusters.clusters = {{1, {1, 1, 0, 1, "kitchen"}}};
  map.clusters.next_id = 2;
  save_map(file("g.cairn"), map);
  for (const char* name : {"out.graphml", "out.geojson"})
    EXPECT_THAT(done({"export", file("g.cairn"), "-o", file(name)})["warnings"].dump(),
                HasSubstr("1 name of clusters: not written"));
}

TEST_F(Exchange, InfoShowsTheLevelsAndTheFirstOfMany) {
  std::string text;
  for (int i = 1; i <= 60; ++i) text += "node " + std::to_string(i) + " 0 0\n";
  write_text(file("many.graph"), text);
  done({"import", file("many.graph"), "-o", file("g.cairn")});
  SavedMap map = load_map(file("g.cairn"));
  map.graph.add_route({0, 1, 60, 1.0, {}, false, false, 0});
  for (LandmarkId id = 1; id <= 60; ++id) map.clusters.cluster_of[id] = id == 60 ? 2 : 1;
  map.clusters.clusters = {{1, {1, 1, 3, 1, ""}}, {2, {2, 1, 3, 60, ""}}, {3, {3, 2, 0, 1, "all"}}};
  map.clusters.next_id = 4;
  save_map(file("g.cairn"), map);
  EXPECT_EQ(done({"info", file("g.cairn")})["levels"],
            (json{{{"clusters", 2}, {"boundary", 2}}, {{"clusters", 1}, {"boundary", 0}}}));
  const std::string shown = run_cairn({"map", "info", file("g.cairn")}).out;
  EXPECT_THAT(shown, HasSubstr("60 landmarks, 1 route (one way)\n"));
  EXPECT_THAT(shown, HasSubstr("level 1: 2 clusters, 2 landmarks on their boundaries\n"));
  EXPECT_THAT(shown, HasSubstr("L50 "));
  EXPECT_THAT(shown, testing::Not(HasSubstr("L51 ")));
  EXPECT_THAT(shown, HasSubstr("... and 10 more landmarks\n"));
}

TEST_F(Exchange, NamesAreGivenAndTakenAway) {
  import_roads();
  SavedMap map = load_map(file("g.cairn"));
  map.clusters.cluster_of = {{4, 1}, {17, 1}, {18, 1}};
  map.clusters.clusters = {{1, {1, 1, 0, 17, ""}}};
  map.clusters.next_id = 2;
  save_map(file("g.cairn"), map);
  EXPECT_EQ(done({"name", file("g.cairn"), "L17", "loading bay"}),
            (json{{"map", file("g.cairn")}, {"id", "L17"}, {"name", "loading bay"}}));
  EXPECT_EQ(graph().find(17)->name, "loading bay");
  done({"name", file("g.cairn"), "loading bay", "dock"});
  EXPECT_EQ(graph().find(17)->name, "dock");
  EXPECT_EQ(done({"name", file("g.cairn"), "C1:dock", "ground floor"})["id"], "C1:L17");
  EXPECT_EQ(load_map(file("g.cairn")).clusters.clusters.at(1).name, "ground floor");
  done({"name", file("g.cairn"), "ground floor", ""});
  done({"name", file("g.cairn"), "dock", ""});
  EXPECT_EQ(load_map(file("g.cairn")).clusters.clusters.at(1).name, "");
  EXPECT_EQ(graph().find(17)->name, "");
}

TEST_F(Exchange, NamesThatMeanSomethingElseAreRefused) {
  import_roads();
  const auto refused_name = [&](const std::string& name) {
    const std::string text = refused({"name", file("g.cairn"), "L17", name});
    return text.substr(0, text.size() - 1);
  };
  const auto cannot = [](const std::string& shown) { return "cairn: the name \"" + shown + "\" cannot be given: "; };
  EXPECT_EQ(refused_name("front desk"), cannot("front desk") + "landmark L4 has it");
  for (const char* name : {"L4", "L999", "C1:L17"}) EXPECT_EQ(refused_name(name), cannot(name) + "it looks like an id");
  for (const char* name : {"1,2", "1, 2, 90", "nearest square"})
    EXPECT_EQ(refused_name(name), cannot(name) + "it reads as a place: x,y or nearest CATEGORY");
  EXPECT_EQ(refused_name(" dock"), cannot(" dock") + "it begins or ends with a blank");
  EXPECT_EQ(refused_name("a\tb"), cannot("a\\x09b") + "it holds a control character");
  EXPECT_EQ(
      refused({"name", file("g.cairn"), "front dsk", "x"}),
      "cairn: there is no landmark and no cluster \"front dsk\" (did you mean \"front desk\"?): give a landmark's "
      "id or name (L17), or a cluster's (C1:L17)\n");
  EXPECT_EQ(graph().find(17)->name, "");
}

}  // namespace
}  // namespace cairn::testing_program
