#include "framework/experiments/trials/table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;
using testing::Not;

GoalVerdict goal(GoalEnd end, bool reachable = true, bool mapped = true, bool struck = false, bool displaced = false) {
  GoalVerdict verdict;
  verdict.path = "2/1";
  verdict.goal = "goto (1.00, 2.00)";
  verdict.end = end;
  verdict.reason = "no way | at all";
  verdict.is_reachable = reachable;
  verdict.is_mapped = mapped;
  verdict.is_struck = struck;
  verdict.is_displaced = displaced;
  return verdict;
}

ExperimentConfig config_of_trials() {
  ExperimentConfig config;
  config.experiment = ExperimentKind::trials;
  config.variants = {{"as_is", {}}};
  config.at_least_ratio = 0.5;
  return config;
}

ExperimentRow row_with(const std::vector<GoalVerdict>& goals) {
  ExperimentRow row;
  row.mission = "trials";
  row.variant = "as_is";
  row.seed = 12;
  row.trial.emplace();
  row.trial->goals = goals;
  return row;
}

TEST(TrialFigures, CountByHand) {
  const ExperimentRow row = row_with({goal(GoalEnd::reached), goal(GoalEnd::failed), goal(GoalEnd::false_success),
                                      goal(GoalEnd::reached, false), goal(GoalEnd::failed, true, false),
                                      goal(GoalEnd::failed, true, true, true), goal(GoalEnd::reached, true, true, true),
                                      goal(GoalEnd::failed, true, true, false, true)});
  const TrialFigures f = trial_figures({}, {&row});
  EXPECT_EQ(f.goals, 8);
  EXPECT_EQ(f.reachable, 7);
  EXPECT_DOUBLE_EQ(f.reached.value, 2.0 / 7.0);
  EXPECT_DOUBLE_EQ(f.reached_unstruck.value, 1.0 / 5.0);
  EXPECT_EQ(f.unfaulted, 4);
  EXPECT_DOUBLE_EQ(f.reached_fairly.value, 1.0 / 4.0);
  EXPECT_EQ(f.unmapped, 1);
  EXPECT_DOUBLE_EQ(f.reached_mapped.value, 1.0 / 3.0);
  EXPECT_EQ(f.false_success, 1);
}

TEST(BrokenLimits, AreReportedOneByOne) {
  const ExperimentConfig config = config_of_trials();
  ExperimentRow row = row_with({goal(GoalEnd::reached)});
  EXPECT_THAT(broken_limits(config, {row}), testing::IsEmpty());
  row.trial->goals.assign(3, goal(GoalEnd::failed));
  row.trial->fast_contacts.push_back({3.5, {0.2, true}});
  row.trial->stand = {5.0, 121.0};
  row.trial->silences = {1, 3};
  row.result.outcome = MissionOutcome::module_fault;
  EXPECT_THAT(broken_limits(config, {row}),
              testing::ElementsAre("as_is: 0.0000 of the goals reached, asked for are 0.5",
                                   "as_is: 1 fast contacts that could be seen, allowed are 0",
                                   "as_is: ordered to stand in tick 3 without readings, allowed is 2", "as_is: 1 hangs",
                                   "as_is: 1 missions ended by a fault of a module or sensor",
                                   "as_is: 1 missions ended without a reason"));
}

TEST(BrokenLimits, AGoalThatWasNeverExploredCountsAsMissed) {
  const GoalVerdict reached = goal(GoalEnd::reached);
  const GoalVerdict unmapped = goal(GoalEnd::failed, true, false);
  EXPECT_THAT(broken_limits(config_of_trials(), {row_with({reached, unmapped})}), testing::IsEmpty());
  EXPECT_THAT(broken_limits(config_of_trials(), {row_with({reached, unmapped, unmapped})}),
              testing::ElementsAre("as_is: 0.3333 of the goals reached, asked for are 0.5"));
  const GoalVerdict struck = goal(GoalEnd::failed, true, true, true);
  EXPECT_THAT(broken_limits(config_of_trials(), {row_with({struck})}), testing::IsEmpty()) << "nothing to judge by";
}

TEST(TrialsTable, ListsEveryCaseToLookInto) {
  ExperimentRow row = row_with({goal(GoalEnd::failed), goal(GoalEnd::failed, false)});
  row.trial->fast_contacts.push_back({3.5, {0.2, true}});
  const std::string table = trials_table(config_of_trials(), {row});
  EXPECT_THAT(table, HasSubstr("| 12 | 3.5 | fast contact | 0.200 m/s |"));
  EXPECT_THAT(table, HasSubstr("| 12 | 2/1 | goto (1.00, 2.00) | 0 to 0 | failed |  | no way / at all |"));
  EXPECT_EQ(table.find("| 12 | 2/1 |"), table.rfind("| 12 | 2/1 |")) << "what cannot be reached is not missed";
  EXPECT_THAT(table, HasSubstr("Limits that are not kept:\n- as_is: 0.0000 of the goals"));
}

TEST(TrialsTable, TheWallClockIsInNoFileButIsReportedAsAHang) {
  const ExperimentConfig config = config_of_trials();
  ExperimentRow row = row_with({goal(GoalEnd::reached)});
  const std::string table = trials_table(config, {row});
  const std::string json = json_of(config, {row});
  row.wall_s = 301.0;
  row.tick.median_us = 123.0;
  EXPECT_EQ(trials_table(config, {row}), table);
  EXPECT_EQ(json_of(config, {row}), json);
  EXPECT_THAT(table, HasSubstr("All limits are kept."));
  EXPECT_THAT(too_long(config, {row}),
              testing::ElementsAre("as_is: seed 12 took 301 s of wall clock, allowed are 300: a hang"));
  EXPECT_THAT(trial_times_table(config, {row}), HasSubstr("| as_is | 301.0 | 301.0 | 123 | 123 |"));
}

TEST(TrialsTable, ARunThatWasCancelledBeforeItBeganIsNoMission) {
  ExperimentRow row;
  row.variant = "as_is";
  EXPECT_THAT(trials_table(config_of_trials(), {row}), HasSubstr("| missions | 0 |"));
}

}  // namespace
}  // namespace cairn
