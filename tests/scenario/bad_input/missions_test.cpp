// What a user sees whose mission, world or experiment is wrong: exit status 2 (or an outcome) and a sentence with the
// place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
}

// A mission file with one thing changed from a good one.
class BadMission : public testing::Test {
 protected:
  Finished run(const std::string& from, const std::string& to) {
    std::string text = "mission: bad\nrobot: " + config("robots/pioneer1.yaml") +
                       "\nworld: " + config("worlds/office.yaml") +
                       "\nstart: {at_m: [0.6, 0.6], angle_deg: 0}\nsensor: {plugin: simulated_robot}\n"
                       "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes, cell_m: 0.05}\n"
                       "detector: {plugin: template_matcher, templates: " +
                       config("templates") +
                       ", coarse_cells: 5}\n"
                       "planner: {plugin: hybrid}\nsteps:\n  - wait: {for_s: 1}\n";
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    write_text(folder_ / "bad.yaml", text);
    return run_cairn({"run", (folder_ / "bad.yaml").string(), "--out", (folder_ / "out").string()});
  }
  std::string place(const std::string& line_and_column) const {
    return "cairn: " + (folder_ / "bad.yaml").string() + ":" + line_and_column;
  }

  const std::filesystem::path folder_ = fresh_folder("bad_mission");
};

TEST_F(BadMission, AGoodOneRuns) {
  EXPECT_EQ(run("for_s: 1", "for_s: 1").exit_status, 0);
}

// The map is saved under the mission's name, the recording beside it.
TEST_F(BadMission, NothingIsWrittenOutsideTheOutputFolder) {
  for (const char* name : {"../bad", "/tmp/bad", "..", "\"a\\0b\"", "a/b"}) {
    const Finished finished = run("mission: bad", std::string("mission: ") + name);
    EXPECT_EQ(finished.exit_status, 2) << name;
    EXPECT_THAT(finished.err, StartsWith(place("1:10: mission must be a plain file name of up to 200 bytes"))) << name;
  }
  const Finished finished = run("mission: bad", "mission: bad\nrecord: ../a.log");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, StartsWith(place("2:9: record must be a plain file name")));
}

TEST_F(BadMission, AModuleIsNamedAndNeverAPath) {
  for (const char* name : {"../../evil.so", "/tmp/evil.so", "./simulated_robot.so", "\"simulated_robot\\0\""}) {
    const Finished finished = run("plugin: simulated_robot", std::string("plugin: ") + name);
    EXPECT_EQ(finished.exit_status, 2) << name;
    EXPECT_THAT(finished.err, AllOf(StartsWith(place("5:")), HasSubstr("unknown sensor plugin"))) << name;
  }
}

TEST_F(BadMission, ATemplateThatIsTooLargeOrTooSmallIsNamed) {
  std::filesystem::copy(config("templates"), folder_ / "templates");
  const auto with_circle = [&](const std::string& diameter_m) {
    write_text(folder_ / "templates" / "z.yaml", "category: z\ncircle: {diameter_m: " + diameter_m + "}\n");
    const Finished finished = run(config("templates"), (folder_ / "templates").string());
    EXPECT_EQ(finished.exit_status, 2) << diameter_m;
    return finished.err;
  };
  EXPECT_THAT(with_circle("9"),
              HasSubstr("the template \"z\" is 9 m across, larger than the mission's world of 6 x 5 m"));
  EXPECT_THAT(with_circle("5.5"), HasSubstr("the template \"z\" is 5.5 m across, larger than"));
  EXPECT_THAT(with_circle("0.1"),
              HasSubstr("the template \"z\" is 0.1 m across, smaller than one cell of OG2, 0.25 m"));
  EXPECT_THAT(with_circle("0.03"), HasSubstr("it is smaller than a cell of the map too"));
}

TEST_F(BadMission, AMisspeltKeyNamesItsPlaceAndTheNearestKey) {
  const Finished finished = run("localizer:", "localiser:");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              AllOf(StartsWith(place("6:1: ")), HasSubstr("localiser"), HasSubstr("did you mean \"localizer\"?")));
}

TEST_F(BadMission, AMisspeltKeyOfAModuleDoesToo) {
  const Finished finished = run("cell_m: 0.05", "cel_m: 0.05");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              AllOf(StartsWith(place("7:22: ")), HasSubstr("cel_m"), HasSubstr("did you mean \"cell_m\"?")));
}

TEST_F(BadMission, AWrongTypeSaysWhatIsExpected) {
  const Finished finished = run("cell_m: 0.05", "cell_m: small");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              AllOf(StartsWith(place("7:30: ")), HasSubstr("cell_m"), HasSubstr("number"), HasSubstr("small")));
}

TEST_F(BadMission, AValueOutOfRangeSaysWhatIsAllowed) {
  const Finished finished = run("cell_m: 0.05", "cell_m: -1");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("7:30: ")), HasSubstr("cell_m"), HasSubstr("-1")));
}

TEST_F(BadMission, AMissingFileIsNamed) {
  const Finished finished = run("pioneer1.yaml", "pioneer9.yaml");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("pioneer9.yaml"), HasSubstr("no such file")));
}

TEST_F(BadMission, AnUnknownPluginNamesTheNearestOne) {
  const Finished finished = run("plugin: bayes", "plugin: bayse");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              AllOf(StartsWith(place("7:")), HasSubstr("unknown map plugin \"bayse\" (did you mean \"bayes\"?)")));
}

TEST_F(BadMission, AnUnknownStepNamesTheNearestOne) {
  const Finished finished = run("- wait:", "- wiat:");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("unknown behaviour plugin \"wiat\" (did you mean \"wait\"?)"));
}

// Known from the templates before the robot has moved.
TEST_F(BadMission, ACategoryWithoutATemplateNamesTheNearestOne) {
  const std::string sentence =
      ": the mission has no template of category \"squar\" (did you mean \"square\"?); it has circle, square, triangle";
  const std::vector<std::array<std::string, 3>> cases = {
      {"goto", "goto: nearest squar", "11:11: "},
      {"goto", "goto: {landmark: nearest squar}", "11:22: "},
      {"tour", "tour: {places: [[1, 1], nearest squar]}", "11:29: "},
      {"patrol", "patrol: {rounds: 1, places: [nearest squar]}", "11:34: "},
      {"return_home", "return_home: nearest squar", "11:18: "},
      {"dock", "dock: {landmark: nearest squar, side: left}", "11:22: "},
      {"inspect", "inspect: nearest squar", "11:14: "},
      {"capture_template", "capture_template: {at: nearest squar, name: a}", "11:28: "},
      {"plan_query", "plan_query: {from: nearest squar, to: L1}", "11:24: "},
      {"plan_query", "plan_query: {to: L1, via: [nearest squar]}", "11:32: "},
      {"search", "search: squar", "11:13: "},
      {"landmark_known", "landmark_known: nearest squar", "11:21: "},
      {"at_place", "not: {at_place: {landmark: nearest squar}}", "11:32: "},
  };
  for (const auto& [name, step, at] : cases) {
    const Finished finished = run("wait: {for_s: 1}", step);
    EXPECT_EQ(finished.exit_status, 2) << step;
    EXPECT_THAT(finished.err, StartsWith(place(at + name + sentence))) << step;
    const Finished checked = run_cairn({"mission", "check", (folder_ / "bad.yaml").string()});
    EXPECT_EQ(checked.exit_status, 2) << step;
    EXPECT_THAT(checked.err, HasSubstr("bad.yaml:" + at + name + sentence)) << step;
  }
  EXPECT_THAT(run("- wait: {for_s: 1}", "- goto: ''").err,
              StartsWith(place("11:11: landmark: \"\" is not a landmark; one is an id")));
}

// Such a mission would be done at once, and take the place of a finished map.
TEST_F(BadMission, WithoutAStepNothingIsRun) {
  EXPECT_EQ(run("for_s: 1", "for_s: 1").exit_status, 0);
  const auto saved = std::filesystem::last_write_time(folder_ / "out" / "bad.cairn");
  const auto refused = [&](const std::string& steps, const std::string& error) {
    const Finished finished = run("steps:\n  - wait: {for_s: 1}\n", steps);
    EXPECT_EQ(finished.exit_status, 2) << steps;
    EXPECT_THAT(finished.err, StartsWith(place(error))) << steps;
    EXPECT_THAT(run_cairn({"mission", "check", (folder_ / "bad.yaml").string()}).err, HasSubstr(error)) << steps;
  };
  refused("steps: []\n", "10:8: steps: expected a list of at least one step, found an empty list");
  refused("steps:\n", "10:1: steps: expected a list of at least one step, found nothing");
  refused("", "5:9: the mission has no steps, and simulated_robot drives");
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out" / "bad.cairn"), saved);
}

TEST_F(BadMission, AWrongParameterIsReportedWhereItWasGivenAndWhereItIsUsed) {
  write_text(folder_ / "sub.yaml", "parameters: {for_s: }\nsteps:\n  - wait: $for_s\n");
  const Finished finished = run("wait: {for_s: 1}", "mission: {file: sub.yaml, with: {for_s: soon}}");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(StartsWith(place("11:45: ")), HasSubstr("wait: for_s must be a number"),
                                  HasSubstr("sub.yaml:3:5)")));
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

// An experiment file whose random worlds cannot be.
class BadWorlds : public testing::Test {
 protected:
  void expect_refused(const std::string& worlds, const std::string& column, const std::string& what) {
    write_text(folder_ / "bad.yaml", "experiment: recognition\nmissions: [" + config("missions/recognition.yaml") +
                                         "]\nworlds: {" + worlds + "}\n");
    const Finished finished = run_cairn({"experiment", (folder_ / "bad.yaml").string()});
    EXPECT_EQ(finished.exit_status, 2) << worlds;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("bad.yaml:3:" + column + ": "), HasSubstr(what)));
  }

  const std::filesystem::path folder_ = fresh_folder("bad_worlds");
};

TEST_F(BadWorlds, MoreLandmarksAtLeastThanAtMostAreRefused) {
  expect_refused("max_landmarks: 2, min_landmarks: 5", "43",
                 "min_landmarks must be at most max_landmarks, found 5 and 2");
  expect_refused("min_landmarks: 7", "25", "found 7 and 6");
  expect_refused("max_landmarks: 0", "25", "found 1 and 0");
}

TEST_F(BadWorlds, RoomsThatCannotBeAreRefused) {
  expect_refused("largest_room_m: [-3, 5]", "27", "x of largest_room_m must be a number from 1 to 100 m, found \"-3\"");
  expect_refused("largest_room_m: [8, 1e9]", "30", "y of largest_room_m must be a number from 1 to 100 m");
  expect_refused("smallest_room_m: [9, 4]", "27",
                 "x of smallest_room_m must be at most that of largest_room_m, found 9 and 8");
  expect_refused("start_m: [2, 5]", "19", "start_m must lie within the smallest room: its y is 5");
}

}  // namespace
}  // namespace cairn::testing_program
