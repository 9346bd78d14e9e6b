// What the tests of the saved map share: a small map with something in every table, and a folder.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <fstream>
#include <iterator>
#include <random>

#include "maps/store/map_store.hpp"

namespace cairn {

namespace fs = std::filesystem;

inline std::string bytes_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const fs::path& file, const std::string& bytes) {
  fs::remove(file);  // some file systems wait for the disk when a file is overwritten
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

inline void run_sql(const fs::path& file, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
  const std::string quickly = "PRAGMA synchronous = OFF; PRAGMA journal_mode = OFF; ";
  char* message = nullptr;
  EXPECT_EQ(sqlite3_exec(database, (quickly + sql).c_str(), nullptr, nullptr, &message), SQLITE_OK) << message;
  sqlite3_close(database);
}

// What load_map says against the file, without the file's name in front.
inline std::string refusal_of(const fs::path& file) {
  try {
    static_cast<void>(load_map(file));
  } catch (const StoreError& error) {
    const std::string prefix = file.string() + ": ";
    EXPECT_THAT(error.what(), testing::StartsWith(prefix));
    return std::string(error.what()).substr(prefix.size());
  }
  return "loaded";
}

inline void expect_equal(const SavedMap& a, const SavedMap& b) {
  EXPECT_EQ(a.grid, b.grid);
  EXPECT_EQ(a.grid.clamp_nat(), b.grid.clamp_nat());
  EXPECT_EQ(a.graph, b.graph);
  EXPECT_EQ(a.clusters, b.clusters);
  EXPECT_EQ(a.driven_path, b.driven_path);
  EXPECT_EQ(a.properties, b.properties);
  EXPECT_EQ(a.progress, b.progress);
  EXPECT_EQ(a.submaps, b.submaps);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (std::size_t i = 0; i < a.shapes.size(); ++i) {
    EXPECT_EQ(a.shapes[i].category, b.shapes[i].category);
    EXPECT_EQ(a.shapes[i].contour, b.shapes[i].contour);
  }
}

inline OccupancyGrid small_grid() {
  OccupancyGrid grid(0.05, 4.0, {-1.25, 0.1});
  grid.include({{-70, -3}, {90, 70}});
  std::mt19937_64 random(7);
  for (int i = 0; i < 900; ++i) {
    // One draw a line: compilers differ in the order of arguments, the stored files do not.
    const auto value = static_cast<LogOdds>(static_cast<int>(random() % 2049) - 1024);
    const int x = static_cast<int>(random() % 150) - 68;
    const int y = static_cast<int>(random() % 60) - 2;
    grid.set_log_odds({x, y}, value);
  }
  return grid;
}

inline LandmarkGraph small_graph() {
  LandmarkGraph graph;
  Landmark square;
  square.name = "dock \"3\"; --";
  square.category = "square";
  square.T_map_landmark = {1.0 / 3.0, -2.5, 0.1};
  square.degree = 0.742;
  square.templates = {{"square", 0.2617993877991494, 0.742}, {"circle", 0.0, 0.71}};
  square.sightings = 12;
  square.access = Pose2{0.9, -2.5, 3.1};
  graph.add(square);
  Landmark place;
  place.T_map_landmark = {4.0, 1e-300, -1.0};
  place.level = 2;
  graph.add(place);
  graph.add(place);
  Route route{0, 1, 2, 5.25, {{0.9, -2.5, 3.1}, {2.0, 0.1, -0.7}, {4.0, 0.0, 0.0}}, true, false, 1};
  graph.add_route(route);
  graph.add_route({0, 2, 1, 0.0, {}, false, true, 0});
  graph.add_route({0, 3, 1, 1.0, {}, false, false, 0});
  graph.remove(3);  // its id and its route's stay retired
  return graph;
}

inline SavedMap small_map() {
  SavedMap map;
  map.grid = small_grid();
  map.graph = small_graph();
  map.shapes = {{"square", Contour::polygon_in_place({{0, 0}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}})},
                {"circle", Contour::circle(0.55)},
                {"wedge", Contour::polygon_in_place({{0, 0}, {1.0 / 3.0, 0}, {0.1, 0.7}})}};
  map.driven_path = {{0, 0, 0}, {0.1, 0.2, 0.3}, {-1e9, 1e-9, -3.0}};
  map.properties = {{"mission", "office"}, {"seed", "7"}, {"note", "two\nlines, \xC3\xA4"}, {"empty", ""}};
  return map;
}

// With all that its landmarks and routes may have.
inline SavedMap map_with_clusters() {
  SavedMap map = small_map();
  map.graph.find(1)->annotations = R"({"nav2":{"properties":{"frame":"map"}}})";
  map.graph.retire(2, "seen free");
  Landmark gate;
  gate.name = "gate";
  gate.T_map_landmark = {7.0, 1.5, 0.0};
  map.graph.add(gate);
  Landmark lift = gate;
  lift.annotations = "{}";
  lift.name = "lift";
  map.graph.add(lift);
  map.graph.retire(5, "rebuilt");
  Route slow{0, 1, 4, 8.5, {}, false, false, 0};
  slow.speed_limit_mps = 0.3;
  slow.annotations = R"({"lane":3})";
  map.graph.add_route(slow);
  map.clusters.clusters = {{2, {2, 1, 5, 1, ""}}, {3, {3, 1, 5, 4, "front desk"}}, {5, {5, 2, 0, 1, "ground floor"}}};
  map.clusters.cluster_of = {{1, 2}, {4, 3}};
  map.clusters.next_id = 8;
  return map;
}

inline SavedMap map_of_a_mission() {
  SavedMap map = map_with_clusters();
  MissionProgress progress{12.5, 1, "goto", {1.0 / 3.0, -2.0, 0.5}, Pose2{0.3, -2.1, 0.4}, 7.25, 1200, 17, 1, {}};
  Landmark maybe;
  maybe.category = "circle";
  maybe.T_map_landmark = {2.0, 0.1, 0.0};
  maybe.sightings = 1;
  maybe.templates = {{"circle", 0.0, 0.66}};
  maybe.evidence = {{"circle", 2, 0.61, 0.66, 0.5}};
  progress.candidates.add(maybe);
  progress.candidates.add(maybe);
  progress.candidates.remove(1);
  map.progress = progress;
  return map;
}

// The bytes of some say steps, those of others doubles.
inline SavedMap map_with_trajectories() {
  SavedMap map = map_of_a_mission();
  map.graph.add_route({0, 4, 1, 9.0, {{7.0, 1.5, 0.0}, {1.0 / 3.0, -2.5, -0.0}}, true, false, 0});
  map.graph.add_route({0, 1, 4, 9.0, {{-7.00001, 100.5, 3.14159}, {1.0, -2.5, 0.0}, {1.1, -2.5, 0.0}}, true, false, 0});
  return map;
}

class MapStore : public testing::Test {
 protected:
  MapStore() {
    std::string pattern = (fs::temp_directory_path() / "map_store_test_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~MapStore() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const char* name = "office.cairn") const { return folder_ / name; }
  // map_with_trajectories() as the first Cairn of schema version 1 saved it.
  [[nodiscard]] static fs::path stored_file() { return fs::path(CAIRN_SOURCE_DIR) / "tests/data/map_schema_1.cairn"; }
  // The saved small map, made once: to write it safely takes many times longer than to make it.
  [[nodiscard]] const std::string& small_map_bytes() const {
    static const std::string bytes = [this] {
      save_map(file("small.cairn"), small_map());
      return bytes_of(file("small.cairn"));
    }();
    return bytes;
  }
  // A saved small map after an edit of its tables that nothing has checked.
  [[nodiscard]] std::string refusal_after(const std::string& sql) const {
    write_bytes(file(), small_map_bytes());
    run_sql(file(), sql);
    return refusal_of(file());
  }

  fs::path folder_;
};

}  // namespace cairn
