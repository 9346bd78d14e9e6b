// Clusters of a mission's landmarks, from outside.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

// Two rooms of 7 x 6 m, joined by a door of 1.1 m.
const std::string kWorld = R"(bounds_m: [[0, 0], [14, 6]]
walls:
  - {points_m: [[0, 0], [14, 0], [14, 6], [0, 6], [0, 0]], surface: rough}
  - {points_m: [[7, 0], [7, 2.4]], surface: rough}
  - {points_m: [[7, 3.5], [7, 6]], surface: rough}
objects:
  - {template: square, at_m: [1.5, 4.5], angle_deg: 30}
  - {template: circle, at_m: [3.5, 4.5], angle_deg: 0}
  - {template: triangle, at_m: [5.5, 4.4], angle_deg: 20}
  - {template: circle, at_m: [3.2, 1.6], angle_deg: 0}
  - {template: square, at_m: [5.4, 1.6], angle_deg: 10}
  - {template: circle, at_m: [8.5, 4.5], angle_deg: 0}
  - {template: square, at_m: [10.5, 4.5], angle_deg: 65}
  - {template: triangle, at_m: [12.5, 4.4], angle_deg: 75}
  - {template: square, at_m: [12.4, 1.6], angle_deg: 40}
  - {template: circle, at_m: [10.2, 1.6], angle_deg: 0}
)";

std::string mission(const std::string& more_steps = "") {
  const std::string config = source_folder() + "/config";
  return "mission: two_rooms\nseed: 7\nrobot: " + config +
         "/robots/pioneer1.yaml\nworld: world.yaml\nstart: {at_m: [0.7, 0.7], angle_deg: 0}\n"
         "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
         "map: {plugin: muriel, cell_m: 0.05}\ndetector: {plugin: template_matcher, templates: " +
         config +
         "/templates, coarse_cells: 5}\nplanner: {plugin: hybrid}\nat_most_s: 3000\n"
         "steps:\n  - explore: {until_known_ratio: 1.0, at_most_s: 1200}\n" +
         more_steps;
}

class Clusters : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = fresh_folder("clusters");
    write_text(folder() / "world.yaml", kWorld);
    write_text(folder() / "mission.yaml", mission("  - save: explored.cairn\n"));
    run() = run_cairn({"run", (folder() / "mission.yaml").string(), "--out", folder().string(), "--json"});
  }
  static std::filesystem::path& folder() {
    static std::filesystem::path path;
    return path;
  }
  static Finished& run() {
    static Finished finished;
    return finished;
  }
  static std::string map_file() { return (folder() / "two_rooms.cairn").string(); }
};

TEST_F(Clusters, OfAMissionWithEightLandmarksAreInItsMapAndItsReport) {
  ASSERT_EQ(run().exit_status, 0) << run().err;
  const SavedMap map = load_map(map_file());
  ASSERT_GE(map.graph.landmarks().size(), 8U);
  EXPECT_EQ(map.clusters.cluster_of.size(), map.graph.landmarks().size());
  const json info = json::parse(run_cairn({"map", "info", map_file(), "--json"}).out);
  ASSERT_EQ(info["levels"].size(), 1U);
  EXPECT_GE(info["levels"][0]["clusters"], 2);
  EXPECT_LE(info["levels"][0]["clusters"], 4) << "a cluster is a room, not a landmark or two";
  EXPECT_EQ(json::parse(run().out)["levels"], info["levels"]);
}

TEST_F(Clusters, DoNotReachThroughTheDoor) {
  const SavedMap map = load_map(map_file());
  for (const auto& [id, cluster] : map.clusters.clusters) {
    std::set<bool> sides;
    for (const LandmarkId member : members_of(map.clusters, id))
      sides.insert(map.graph.find(member)->T_map_landmark.x_m < 7.0);
    EXPECT_EQ(sides.size(), 1U) << label_of(cluster, map.graph);
  }
}

TEST_F(Clusters, AreGivenNamesByAMissionThatItsLaterStepsAndItsMapKnow) {
  const std::string explored = (Clusters::folder() / "explored.cairn").string();
  const SavedMap before = load_map(explored);
  ASSERT_FALSE(before.clusters.clusters.empty());
  const Cluster& cluster = before.clusters.clusters.rbegin()->second;
  const std::string id = "C1:L" + std::to_string(cluster.anchor);
  const std::filesystem::path folder = fresh_folder("clusters_named");
  write_text(folder / "world.yaml", kWorld);
  write_text(folder / "mission.yaml", mission("  - save: explored.cairn\n  - name: {landmark: " + id +
                                              ", as: lounge}\n  - goto: lounge\n  - save: named.cairn\n"));
  const Finished named =
      run_cairn({"run", (folder / "mission.yaml").string(), "--resume", explored, "--out", folder.string(), "--json"});
  ASSERT_EQ(named.exit_status, 0) << named.err << named.out;
  const SavedMap map = load_map(folder / "named.cairn");
  const Cluster* const lounge = find_cluster(map.clusters, map.graph, "lounge");
  ASSERT_NE(lounge, nullptr);
  EXPECT_EQ(lounge->id, cluster.id);
  EXPECT_EQ(map.graph.find_by_name("lounge"), nullptr) << "no landmark got the name";
  const json steps = json::parse(text_of_file(folder / "report.json"))["steps"];
  EXPECT_EQ(steps[1]["reason"], id + " is now lounge") << steps;
  EXPECT_THAT(steps[2]["reason"].get<std::string>(), ::testing::StartsWith("at L")) << steps;
}

TEST_F(Clusters, AreGivenNamesThatPlansTake) {
  SavedMap map = load_map(map_file());
  ASSERT_FALSE(map.clusters.clusters.empty());
  const Cluster cluster = map.clusters.clusters.begin()->second;
  const std::string id = "C1:L" + std::to_string(cluster.anchor);
  ASSERT_EQ(run_cairn({"map", "name", map_file(), id, "kitchen"}).exit_status, 0);
  EXPECT_THAT(run_cairn({"map", "info", map_file()}).out, ::testing::HasSubstr(id + " kitchen, "));
  for (const std::string& name : {id, std::string("kitchen")}) {
    const Finished plan = run_cairn({"plan", map_file(), "--from", "9,3", "--to", name, "--json"});
    ASSERT_EQ(plan.exit_status, 0) << plan.err << plan.out;
    const std::string last = json::parse(plan.out)["landmarks"].back();
    EXPECT_THAT(members_of(map.clusters, cluster.id), ::testing::Contains(std::stoll(last.substr(1)))) << name;
  }
}

}  // namespace
}  // namespace cairn::testing_program
