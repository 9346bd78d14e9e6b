// The demo, from outside: a mission, then questions to its map.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;

const std::filesystem::path& office_run() {
  static const std::filesystem::path folder = [] {
    const auto out = fresh_folder("office");
    const Finished run = run_cairn(
        {"run", source_folder() + "/config/missions/office.yaml", "--seed", "7", "--out", out.string(), "--json"});
    write_text(out / "stdout.json", run.out);
    write_text(out / "exit", std::to_string(run.exit_status) + run.err);
    return out;
  }();
  return folder;
}

json plan(const std::vector<std::string>& more) {
  std::vector<std::string> arguments{"plan", (office_run() / "office.cairn").string(), "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Finished run = run_cairn(arguments);
  json answer = json::parse(run.out);
  answer["exit_status"] = run.exit_status;
  return answer;
}

TEST(Office, TheMissionFindsTheThreeLandmarksAndNothingElse) {
  const json summary = json::parse(text_of_file(office_run() / "stdout.json"));
  EXPECT_EQ(summary["outcome"], "done") << text_of_file(office_run() / "exit");
  std::multiset<std::string> categories;
  for (const json& landmark : summary["landmarks"]) categories.insert(landmark["category"]);
  EXPECT_THAT(categories, testing::ElementsAre("circle", "square", "triangle"));
  EXPECT_EQ(summary["collisions"], 0);
}

TEST(Office, ThePicturesAndTheReportAreThere) {
  for (const char* file :
       {"map.png", "coarse.png", "degrees.png", "pose_error.png", "timeline.png", "report.json", "office.cairn"})
    EXPECT_GT(std::filesystem::file_size(office_run() / file), 500U) << file;
}

TEST(Office, TwoRunsWithOneSeedGiveTheSameBytes) {
  const auto out = fresh_folder("office_again");
  const Finished again =
      run_cairn({"run", source_folder() + "/config/missions/office.yaml", "--seed", "7", "--out", out.string()});
  ASSERT_EQ(again.exit_status, 0) << again.err;
  for (const char* file : {"report.json", "office.cairn", "map.png", "coarse.png"})
    EXPECT_TRUE(text_of_file(out / file) == text_of_file(office_run() / file)) << file << " differs";
}

TEST(Office, TheMapHoldsRoutesBetweenTheLandmarks) {
  const SavedMap map = load_map(office_run() / "office.cairn");
  EXPECT_EQ(map.graph.landmarks().size(), 3U);
  EXPECT_EQ(map.graph.routes().size(), 6U);
  for (const auto& [id, route] : map.graph.routes()) {
    EXPECT_FALSE(route.trajectory.empty());
    EXPECT_GT(route.cost_m, 0.3);
  }
}

TEST(Office, ARouteToTheNearestSquareIsSolved) {
  const auto picture = office_run() / "route.png";
  const json answer = plan({"--from", "0.5,0.5", "--to", "nearest square", "--picture", picture.string()});
  EXPECT_EQ(answer["exit_status"], 0);
  ASSERT_EQ(answer["outcome"], "solved") << answer["reason"];
  EXPECT_GT(answer["length_m"].get<double>(), 1.5);
  ASSERT_GE(answer["path"].size(), 2U);
  EXPECT_NEAR(answer["path"][0][0].get<double>(), 0.5, 1e-9);
  EXPECT_TRUE(std::filesystem::exists(picture));
}

TEST(Office, OneSeedGivesOnePath) {
  const std::vector<std::string> query{"--from", "0.6,0.6", "--to", "5.2,4.2", "--seed", "5"};
  EXPECT_EQ(plan(query)["path"], plan(query)["path"]);
}

TEST(Office, AGoalOutsideTheRoomIsNoSuccess) {
  const json answer = plan({"--from", "0.6,0.6", "--to", "40,40"});
  EXPECT_EQ(answer["exit_status"], 1);
  EXPECT_EQ(answer["outcome"], "goal_blocked");
  EXPECT_NE(answer["reason"], "");
}

TEST(Office, QueriesAreAnsweredALineEach) {
  const auto folder = fresh_folder("queries");
  write_text(
      folder / "q.jsonl",
      "{\"id\": \"a\", \"from\": \"0.6,0.6\", \"to\": \"L1\"}\n{\"id\": \"b\", \"from\": \"L1\", \"to\": \"L2\"}\n");
  const Finished run = run_cairn(
      {"plan", (office_run() / "office.cairn").string(), "--queries", (folder / "q.jsonl").string(), "--json"});
  EXPECT_EQ(run.exit_status, 0) << run.out << run.err;
  const std::size_t split = run.out.find('\n');
  EXPECT_EQ(json::parse(run.out.substr(0, split))["id"], "a");
  const json second = json::parse(run.out.substr(split + 1));
  EXPECT_EQ(second["id"], "b");
  EXPECT_EQ(second["landmarks"], (json{"L1", "L2"}));
}

TEST(Office, LintFindsNothingWrongWithTheMap) {
  const Finished finished = run_cairn({"map", "lint", (office_run() / "office.cairn").string()});
  EXPECT_EQ(finished.exit_status, 0) << finished.out;
}

TEST(Office, MapInfoAndRenderReadTheMap) {
  const Finished info = run_cairn({"map", "info", (office_run() / "office.cairn").string(), "--json"});
  const json map = json::parse(info.out);
  EXPECT_EQ(map["landmarks"], 3);
  EXPECT_EQ(map["cell_m"], 0.05);
  EXPECT_GT(map["explored_ratio"], 0.5);
  const auto picture = office_run() / "rendered.png";
  EXPECT_EQ(run_cairn({"map", "render", (office_run() / "office.cairn").string(), "-o", picture.string()}).exit_status,
            0);
  EXPECT_TRUE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace cairn::testing_program
