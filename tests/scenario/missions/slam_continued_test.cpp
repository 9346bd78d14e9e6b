// Laser SLAM that goes on with a saved map: by the graph of the runs before.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "maps/base/deflate.hpp"
#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr int kFirst_s = 150;
constexpr const char* kShortLook = "steps.0.force_success.explore.at_most_s=90";
const std::string kMission = source_folder() + "/config/missions/slam_patrol.yaml";

struct Continued {
  Finished finished;
  json report;
  SavedMap map;
};

Continued run_patrol(const std::string& name, int until_s, const std::vector<std::string>& more) {
  const auto folder = fresh_folder(name);
  std::vector<std::string> arguments{"run",           kMission, "--out",
                                     folder.string(), "--json", "--set",
                                     kShortLook,      "--set",  fmt::format("at_most_s={}", until_s)};
  arguments.insert(arguments.end(), more.begin(), more.end());
  Continued continued{run_cairn(arguments), {}, {}};
  EXPECT_TRUE(std::filesystem::exists(folder / "slam_patrol.cairn")) << continued.finished.err;
  continued.report = json::parse(text_of_file(folder / "report.json"));
  continued.map = load_map(folder / "slam_patrol.cairn");
  return continued;
}

// Once for all tests.
const Continued& first_run() {
  static const Continued first = run_patrol("slam_continued_first", kFirst_s, {});
  return first;
}

std::filesystem::path saved(const std::string& name, const SavedMap& map) {
  const auto file = fresh_folder(name) / "left.cairn";
  save_map(file, map);
  return file;
}

// The robot is believed to be where it is not.
std::string pushed_pose() {
  const Pose2 pose = first_run().map.progress->T_map_robot * Pose2{0.2, -0.2, radians(3.0)};
  return fmt::format("{:.3f},{:.3f},{:.2f}", pose.x_m, pose.y_m, degrees(pose.theta_rad));
}

double last_error_m(const Continued& run) {
  return run.report["pose_error"]["last_m"].get<double>();
}

TEST(SlamContinued, ARobotThatWasPushedIsPutRightByTheSubmapsOfTheRunBefore) {
  const KeptSubmaps& before = first_run().map.submaps;
  ASSERT_GT(before.submaps.size(), 3U);
  const Continued next =
      run_patrol("slam_continued_pushed", kFirst_s + 90,
                 {"--resume", saved("slam_continued_map", first_run().map).string(), "--pose", pushed_pose()});
  EXPECT_LT(last_error_m(next), last_error_m(first_run()) + 0.1);

  const std::int64_t last_before = before.nodes.back().number;
  EXPECT_GT(next.map.submaps.nodes.back().number, last_before + 10);
  std::size_t kept = 0;
  for (const KeptNode& node : next.map.submaps.nodes)
    kept += std::ranges::find(before.nodes, node) != before.nodes.end() ? 1 : 0;
  EXPECT_GT(kept, 10U) << "where they were";
  const auto ties_runs = [&](const KeptEdge& edge) {
    return edge.from <= last_before && edge.to > last_before && edge.is_closure && edge.is_believed;
  };
  EXPECT_GT(std::ranges::count_if(next.map.submaps.edges, ties_runs), 10);

  SavedMap without = first_run().map;
  without.submaps = {};
  const Continued alone =
      run_patrol("slam_continued_alone", kFirst_s + 90,
                 {"--resume", saved("slam_continued_no_graph", without).string(), "--pose", pushed_pose()});
  EXPECT_GT(last_error_m(alone), last_error_m(next) + 0.1) << "nothing puts it right";
}

TEST(SlamContinued, TenMinutesOfStandingAddNoSubmap) {
  const std::vector<std::string> stands{"--set", "steps=[{force_success: {explore: {at_most_s: 40}}}, {wait: 100000}]"};
  const Continued first = run_patrol("slam_standing_first", 60, stands);
  std::vector<std::string> goes_on = stands;
  goes_on.insert(goes_on.end(), {"--resume", saved("slam_standing_map", first.map).string()});
  const Continued next = run_patrol("slam_standing_next", 660, goes_on);
  EXPECT_GT(first.map.submaps.nodes.size(), 5U);
  EXPECT_EQ(next.map.submaps, first.map.submaps);
}

TEST(SlamContinued, AnAutosaveHoldsTheGraphThatItsRunBeganWith) {
  const auto folder = fresh_folder("slam_killed");
  const Killed killed = kill_cairn(
      {"run", kMission, "--out", folder.string(), "--set", kShortLook, "--set", "at_most_s=1000", "--set",
       "autosave.every_s=0.1", "--resume", saved("slam_killed_map", first_run().map).string(), "--pose", pushed_pose()},
      "autosaved", 0.2);
  ASSERT_FALSE(killed.has_ended);
  EXPECT_EQ(load_map(folder / "slam_patrol.autosave.cairn").submaps, first_run().map.submaps);
}

TEST(SlamContinued, ARobotInAMapThatIsLeftAloneIsPutRightToo) {
  const auto folder = fresh_folder("slam_localised");
  const auto file = saved("slam_localised_map", first_run().map);
  const std::string before = text_of_file(file);
  const Finished finished =
      run_cairn({"run", kMission, "--out", folder.string(), "--json", "--localize-in", file.string(), "--pose",
                 "0.8,2.45,3", "--set", "steps=[{goto: {at_m: [2.9, 2.6]}}, {goto: {at_m: [0.8, 2.6]}}]"});
  ASSERT_EQ(finished.exit_status, 0) << finished.err;
  const json report = json::parse(text_of_file(folder / "report.json"));
  EXPECT_GT(report["pose_error"]["worst_m"].get<double>(), 0.2) << "the pose that was given";
  EXPECT_LT(report["pose_error"]["last_m"].get<double>(), 0.15);
  EXPECT_EQ(text_of_file(file), before);
}

TEST(SlamContinued, SubmapsThatCannotBeTrueAreLeftOutAndTheRunSaysSo) {
  SavedMap map = first_run().map;
  map.submaps.nodes.back().T_map_node.x_m = 1e18;
  const Continued next =
      run_patrol("slam_impossible", kFirst_s + 5, {"--resume", saved("slam_impossible_map", map).string()});
  EXPECT_THAT(next.report["events"].dump(), HasSubstr("the submaps of the saved map are not used: node"));
  EXPECT_EQ(next.map.submaps.nodes.front().number, 0) << "a graph of its own";
}

TEST(SlamContinued, AMapOfWhichASubmapIsDamagedIsContinuedWithoutThem) {
  const auto file = saved("slam_damaged_map", first_run().map);
  const auto& echoes = first_run().map.submaps.submaps.front().echoes;
  const std::string packed = deflated(std::string(echoes.begin(), echoes.end()));
  std::string bytes = text_of_file(file);
  const std::size_t at = bytes.find(packed.substr(0, 24));
  ASSERT_NE(at, std::string::npos);
  bytes[at + 20] = static_cast<char>(bytes[at + 20] ^ 1);
  write_text(file, bytes);
  const Continued next = run_patrol("slam_damaged", kFirst_s + 5, {"--resume", file.string()});
  EXPECT_THAT(next.finished.err, HasSubstr("the run does without the submaps"));
  EXPECT_THAT(next.report["events"].dump(), Not(HasSubstr("the submaps of the saved map")));
}

}  // namespace
}  // namespace cairn::testing_program
