// What a user sees who gets it wrong: exit status 2 (or an outcome) and a sentence with the place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string config(const std::string& path) { return source_folder() + "/config/" + path; }

// A mission file with one thing changed from a good one.
class BadMission : public testing::Test {
 protected:
  Finished run(const std::string& from, const std::string& to) {
    std::string text = "mission: bad\nrobot: " + config("robots/pioneer1.yaml") + "\nworld: " + config("worlds/office.yaml") +
                       "\nstart: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: {plugin: simulated_robot}\n"
                       "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes_map, cell_m: 0.05}\n"
                       "detector: {plugin: template_matcher, templates: " + config("templates") + ", coarse_cells: 5}\n"
                       "planner: {plugin: hybrid}\nsteps:\n  - wait: {for_s: 1}\n";
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    write_text(folder_ / "bad.yaml", text);
    return run_cairn({"run", (folder_ / "bad.yaml").string(), "--out", (folder_ / "out").string()});
  }
  std::string place(const std::string& line_and_column) const { return "cairn: " + (folder_ / "bad.yaml").string() + ":" + line_and_column; }

  const std::filesystem::path folder_ = fresh_folder("bad_mission");
};

TEST_F(BadMission, AGoodOneRuns) { EXPECT_EQ(run("for_s: 1", "for_s: 1").exit_status, 0); }

TEST_F(BadMission, AMisspeltKeyNamesItsPlaceAndTheNearestKey) {
  const Finished finished = run("localizer:", "localiser:");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("6:1: ")), HasSubstr("localiser"), HasSubstr("did you mean \"localizer\"?")));
}

TEST_F(BadMission, AMisspeltKeyOfAModuleDoesToo) {
  const Finished finished = run("cell_m: 0.05", "cel_m: 0.05");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("7:26: ")), HasSubstr("cel_m"), HasSubstr("did you mean \"cell_m\"?")));
}

TEST_F(BadMission, AWrongTypeSaysWhatIsExpected) {
  const Finished finished = run("cell_m: 0.05", "cell_m: small");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("7:34: ")), HasSubstr("cell_m"), HasSubstr("number"), HasSubstr("small")));
}

TEST_F(BadMission, AValueOutOfRangeSaysWhatIsAllowed) {
  const Finished finished = run("cell_m: 0.05", "cell_m: -1");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("7:34: ")), HasSubstr("cell_m"), HasSubstr("-1")));
}

TEST_F(BadMission, AMissingFileIsNamed) {
  const Finished finished = run("pioneer1.yaml", "pioneer9.yaml");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("pioneer9.yaml"), HasSubstr("no such file")));
}

TEST_F(BadMission, AnUnknownPluginNamesTheNearestOne) {
  const Finished finished = run("plugin: bayes_map", "plugin: bayes_mop");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("7:")), HasSubstr("unknown map plugin \"bayes_mop\" (did you mean \"bayes_map\"?)")));
}

TEST_F(BadMission, AnUnknownStepNamesTheNearestOne) {
  const Finished finished = run("- wait:", "- wiat:");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("unknown behaviour plugin \"wiat\" (did you mean \"wait\"?)"));
}

TEST_F(BadMission, CoarseCellsLargerThanTheSmallestLandmarkAreRefused) {
  const Finished finished = run("coarse_cells: 5", "coarse_cells: 50");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("coarse_cells"), HasSubstr("50")));
}

TEST_F(BadMission, AStartInsideAWallIsAnOutcome) {
  const Finished finished = run("at_m: [0.6, 0.6]", "at_m: [0.0, 0.6]");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("outcome     sensor_fault"), HasSubstr("start")));
}

TEST_F(BadMission, AnUnreachableGoalIsAnOutcomeWithItsReason) {
  const Finished finished = run("- wait: {for_s: 1}", "- goto: {at_m: [30, 30]}");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("outcome     step_failed: step 1 (goto)"), HasSubstr("30")));
}

TEST_F(BadMission, ASettingOnTheCommandLineIsCheckedLikeOneInTheFile) {
  const Finished finished =
      run_cairn({"run", config("missions/office.yaml"), "--set", "map.cell_m=huge", "--out", folder_.string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("--set map.cell_m"), HasSubstr("huge")));
}

TEST(BadCommand, AMissingMissionFileIsNamed) {
  const Finished finished = run_cairn({"run", "/nowhere/mission.yaml"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("/nowhere/mission.yaml"), HasSubstr("no such file")));
}

TEST(BadCommand, AnUnknownCommandIsWrongUsage) { EXPECT_EQ(run_cairn({"runn"}).exit_status, 2); }

TEST(BadCommand, APlanWithoutPlacesIsWrongUsage) {
  EXPECT_EQ(run_cairn({"plan", "x.cairn"}).exit_status, 2);
}

TEST(BadCommand, AMapThatIsNoMapIsNamed) {
  const auto folder = fresh_folder("no_map");
  write_text(folder / "text.cairn", "hello");
  const Finished finished = run_cairn({"map", "info", (folder / "text.cairn").string()});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("text.cairn"));
}

TEST(BadCommand, AnUnknownModuleNamesTheNearestOne) {
  const Finished finished = run_cairn({"plugins", "info", "hybird"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("did you mean \"hybrid\"?"));
}

TEST(BadPlugin, ALibraryThatIsNoModuleIsToldAndTheOthersStayUsable) {
  const Finished finished = run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/not_a_module"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, HasSubstr("not_a_module.so: is no Cairn module"));
  EXPECT_THAT(finished.out, HasSubstr("simulated_robot"));
}

TEST(BadPlugin, AnotherAbiStampIsToldWithBothSides) {
  const Finished finished = run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/wrong_stamp"});
  EXPECT_THAT(finished.err, AllOf(HasSubstr("wrong_stamp.so: was built with another ABI"), HasSubstr("gcc 99.0")));
}

// Recorded tables that are wrong, each in its own way.
class BadLog : public testing::Test {
 protected:
  Finished run(const std::string& table) {
    write_text(folder_ / "log.txt", table);
    write_text(folder_ / "log.yaml",
               "mission: log\nrobot: " + config("robots/pioneer1.yaml") +
                   "\nsensor:\n  plugin: table_log\n" + kSensor +
                   "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes_map}\n");
    return run_cairn({"run", (folder_ / "log.yaml").string(), "--out", (folder_ / "out").string()});
  }

  static const char* const kSensor;
  const std::filesystem::path folder_ = fresh_folder("bad_log");
};

}  // namespace
}  // namespace cairn::testing_program
