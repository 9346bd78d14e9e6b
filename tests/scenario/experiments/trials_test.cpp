// Random missions in random worlds, as the program runs them.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kShipped = source_folder() + "/config/experiments/missions.yaml";

std::vector<std::string> short_look(const std::filesystem::path& out, const std::string& from,
                                    const std::string& count) {
  return {"experiment", kShipped,
          "--set",      "seeds.from=" + from,
          "--set",      "seeds.count=" + count,
          "--set",      "trials.explore_at_most_s=120",
          "--set",      "trials.min_goals=2",
          "--set",      "trials.max_goals=2",
          "--set",      "trials.goal_at_most_s=120",
          "--set",      "trials.faults_per_hour.silent=60",
          "--out",      out.string(),
          "--json"};
}

TEST(Trials, EveryMissionEndsWithItsGoalsJudged) {
  const auto folder = fresh_folder("trials");
  const Finished finished = run_cairn(short_look(folder / "out", "9001", "3"));
  ASSERT_LE(finished.exit_status, 1) << finished.err;
  const json all = json::parse(finished.out);
  ASSERT_EQ(all["rows"].size(), 3U);
  int silences = 0;
  for (const json& row : all["rows"]) {
    EXPECT_THAT(row["outcome"], testing::AnyOf("done", "step_failed")) << row["reason"];
    const json& trial = row["trial"];
    EXPECT_GE(trial["goals"].size(), 1U);
    for (const json& goal : trial["goals"]) EXPECT_FALSE(goal["reason"].get<std::string>().empty()) << goal;
    EXPECT_LE(trial["worst_stop_ticks"], 2) << "stale data stops the robot";
    EXPECT_LE(trial["longest_stand_s"], 120.0);
    EXPECT_TRUE(trial["fast_contacts"].empty()) << trial;
    silences += trial["silences"].get<int>();
  }
  EXPECT_GT(silences, 0) << "otherwise nothing was shown";
  EXPECT_EQ(finished.exit_status, all["broken_limits"].empty() ? 0 : 1);
  EXPECT_THAT(text_of_file(folder / "out/table.md"), HasSubstr("| missions | 3 |"));
}

TEST(Trials, TheMissionOfASeedGivesItsRunAgain) {
  const auto folder = fresh_folder("trials_again");
  ASSERT_LE(run_cairn(short_look(folder / "out", "9004", "1")).exit_status, 1);
  const auto mission = folder / "out/seed_9004/mission.yaml";
  const Finished again = run_cairn({"run", mission.string(), "--seed", "9004", "--out", (folder / "again").string()});
  ASSERT_LE(again.exit_status, 1) << again.err;
  const json first = json::parse(text_of_file(folder / "out/seed_9004/report.json"));
  const json second = json::parse(text_of_file(folder / "again/report.json"));
  for (const char* key : {"outcome", "reason", "time_s", "distance_m", "nodes", "node_runs", "contacts", "pose_error"})
    EXPECT_EQ(first[key], second[key]) << key;
}

Finished with(const std::string& name, const std::string& text) {
  const auto folder = fresh_folder(name);
  write_text(folder / "trials.yaml", text);
  return run_cairn({"experiment", (folder / "trials.yaml").string(), "--out", (folder / "out").string()});
}

TEST(Trials, BadFilesAreReportedWithTheirPlace) {
  const std::string config = source_folder() + "/config";
  const std::string robots = "  robots: [" + config + "/robots/pioneer1.yaml]\n  templates: " + config + "/templates\n";
  Finished bad = with("trials_bad", "experiment: trials\ntrials:\n" + robots + "  max_goal: 3\n");
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("trials.yaml:5:3: "));
  EXPECT_THAT(bad.err, HasSubstr("max_goals"));
  bad = with("trials_bad", "experiment: trials\ntrials:\n" + robots + "  min_goals: 9\n");
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("trials.yaml:5:14: min_goals must be at most max_goals, found 9 and 6"));
  bad = with("trials_bad", "experiment: trials\nmissions: [a.yaml]\ntrials:\n" + robots);
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("trials.yaml:2:11: an experiment of trials draws its missions and lists none"));
  bad = with("trials_bad", "experiment: trials\n");
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("must say under trials what it draws"));
  bad = with("trials_bad", "experiment: maps\nmissions: [" + config + "/missions/office.yaml]\ntrials:\n" + robots);
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("trials goes with experiment: trials"));
  bad = with("trials_bad", "experiment: maps\n");
  EXPECT_EQ(bad.exit_status, 2);
  EXPECT_THAT(bad.err, HasSubstr("lacks the key \"missions\""));
}

}  // namespace
}  // namespace cairn::testing_program
