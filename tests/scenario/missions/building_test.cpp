// The building of seven rooms: explored through its doors, its landmarks clustered by rooms, paths answered over the
// clusters.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::StartsWith;

constexpr double kTolerance_m = 0.25;

class Building : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder() = fresh_folder("building");
    run() =
        run_cairn({"run", source_folder() + "/config/missions/building.yaml", "--out", folder().string(), "--json"});
  }
  static std::filesystem::path& folder() {
    static std::filesystem::path path;
    return path;
  }
  static Finished& run() {
    static Finished finished;
    return finished;
  }
  static std::string map_file() { return (folder() / "building.cairn").string(); }
  static json plan(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"plan", map_file(), "--json", "--explain"});
    return json::parse(run_cairn(arguments).out, nullptr, false);
  }
};

TEST_F(Building, AtLeastTwentyOfItsLandmarksAreFoundAndAllStepsAreDone) {
  ASSERT_EQ(run().exit_status, 0) << run().err;
  EXPECT_EQ(json::parse(run().out)["outcome"], "done");
  const SavedMap map = load_map(map_file());
  const World world = load_world(source_folder() + "/config/worlds/building.yaml",
                                 load_landmark_shapes(source_folder() + "/config/templates"));
  std::size_t found = 0;
  for (const auto& [id, landmark] : map.graph.landmarks())
    found += std::ranges::any_of(world.objects, [&](const auto& object) {
      return object.category == landmark.category &&
             (object.T_map_object.position() - landmark.T_map_landmark.position()).norm() < kTolerance_m;
    });
  EXPECT_GE(found, 20U);
}

TEST_F(Building, ItsLandmarksHaveClustersOfRoomsAndAreOneGraph) {
  const json info = json::parse(run_cairn({"map", "info", map_file(), "--json"}).out);
  ASSERT_GE(info["levels"].size(), 1U);
  EXPECT_GE(info["levels"][0]["clusters"], 6) << "seven rooms";
  EXPECT_LE(info["levels"][0]["clusters"], 12);
  EXPECT_EQ(info["components"], 1);
}

TEST_F(Building, APathAcrossRoomsIsAnsweredOverClusters) {
  for (const auto& [from, to] : {std::pair{"1.2,8.6", "15,2.4"}, std::pair{"15,2.4", "1.2,8.6"}}) {
    const json answer = plan({"--from", from, "--to", to});
    ASSERT_EQ(answer["outcome"], "solved") << answer;
    EXPECT_GE(answer["landmarks"].size(), 2U) << from << " to " << to << ": " << answer["reason"];
    EXPECT_THAT(answer["reason"].get<std::string>(), StartsWith("over ")) << from << " to " << to;
    EXPECT_THAT(answer["explanation"]["search"].get<std::string>(), HasSubstr("Boost.Graph"));
    EXPECT_GE(answer["explanation"]["search_level"], 1);
    EXPECT_THAT(run_cairn({"plan", map_file(), "--from", from, "--to", to}).out, HasSubstr(", planned over L"));
    ASSERT_GE(answer["explanation"]["clusters"].size(), 1U);
    EXPECT_GE(answer["explanation"]["clusters"][0].size(), 2U) << answer;
  }
}

// Step 3 drives from one end of the building to the other.
TEST_F(Building, TheMissionItselfDrivesAcrossRoomsOverLandmarks) {
  std::ifstream file(folder() / "report.json");
  const json report = json::parse(file, nullptr, false);
  std::vector<std::string> plans;
  bool is_third = false;
  for (const json& event : report["events"]) {
    const auto text = event.get<std::string>();
    if (text.find(" s: step ") != std::string::npos) is_third = text.find("step 3 (goto) begins") != std::string::npos;
    if (is_third && text.find("plan: ") != std::string::npos) plans.push_back(text);
  }
  ASSERT_FALSE(plans.empty());
  EXPECT_THAT(plans.front(), MatchesRegex(".* s: plan: solved, over [0-9]+ landmarks, .*"));
}

// They keep the room beside the robot that plans ask for.
TEST_F(Building, PlansTakeItsStoredRoutesAsTheyAre) {
  std::vector<std::string> labels;
  const SavedMap map = load_map(map_file());
  for (const auto& [id, landmark] : map.graph.landmarks()) labels.push_back("L" + std::to_string(id));
  std::string queries;
  for (std::size_t i = 0; i < labels.size(); ++i)
    queries += json{{"from", labels[i]}, {"to", labels[(i + 7) % labels.size()]}}.dump() + "\n";
  write_text(folder() / "queries.jsonl", queries);
  std::istringstream answers(
      run_cairn({"plan", map_file(), "--queries", (folder() / "queries.jsonl").string(), "--json"}).out);
  int stored = 0;
  int planned = 0;
  const std::regex legs("by ([0-9]+) stored and ([0-9]+) newly planned");
  for (std::string line; std::getline(answers, line);) {
    const json answer = json::parse(line);
    EXPECT_EQ(answer["outcome"], "solved") << line;
    const auto reason = answer["reason"].get<std::string>();
    EXPECT_EQ(reason.find("leaves too little room"), std::string::npos) << reason;
    std::smatch match;
    if (!std::regex_search(reason, match, legs)) continue;
    stored += std::stoi(match[1]);
    planned += std::stoi(match[2]);
  }
  EXPECT_GE(stored, 20);
  EXPECT_LE(planned, stored / 10);
}

TEST_F(Building, ANameOfAClusterIsAPlace) {
  const SavedMap map = load_map(map_file());
  ASSERT_FALSE(map.clusters.clusters.empty());
  const Cluster& first = map.clusters.clusters.begin()->second;
  const std::string id = "C" + std::to_string(first.level) + ":L" + std::to_string(first.anchor);
  ASSERT_EQ(run_cairn({"map", "name", map_file(), id, "kitchen"}).exit_status, 0);
  EXPECT_EQ(plan({"--from", "0.8,6", "--to", "kitchen"})["outcome"], "solved");
}

}  // namespace
}  // namespace cairn::testing_program
