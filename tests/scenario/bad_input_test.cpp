// What a user sees who gets it wrong: exit status 2 (or an outcome) and a sentence with the place.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

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

TEST(BadCommand, AMissingMissionFileIsNamed) {
  const Finished finished = run_cairn({"run", "/nowhere/mission.yaml"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, AllOf(HasSubstr("/nowhere/mission.yaml"), HasSubstr("no such file")));
}

TEST(BadCommand, AnUnknownCommandIsWrongUsage) {
  EXPECT_EQ(run_cairn({"runn"}).exit_status, 2);
}

TEST(BadCommand, AMisspeltCommandNamesTheNearestOne) {
  const Finished finished = run_cairn({"plugins", "chek", "x.so"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("unknown command \"chek\" (did you mean \"check\"?)"));
}

TEST(BadCommand, APlanWithoutPlacesIsWrongUsage) {
  EXPECT_EQ(run_cairn({"plan", "x.cairn"}).exit_status, 2);
}

TEST(BadCommand, AMisspeltOptionIsNamedWithTheNearest) {
  const auto reported = [](const std::vector<std::string>& arguments) {
    const Finished finished = run_cairn(arguments);
    EXPECT_EQ(finished.exit_status, 2);
    return finished.err;
  };
  EXPECT_EQ(reported({"plan", "a.cairn", "--form=1,1", "--to", "2,2"}),
            "cairn: unknown option \"--form\" (did you mean \"--from\"?); cairn plan --help lists the options\n");
  EXPECT_EQ(reported({"map", "info", "a.cairn", "--jsn"}),
            "cairn: unknown option \"--jsn\" (did you mean \"--json\"?); cairn map info --help lists the options\n");
  EXPECT_THAT(reported({"plan", "a.cairn", "1,1"}), HasSubstr("1,1"));
}

TEST(BadCommand, AnswersThatCannotBeWrittenAreNotDone) {
  const std::filesystem::path reported = fresh_folder("full") / "told.txt";
  const std::string command = "'" CAIRN_BINARY_DIR "/bin/cairn' plugins > /dev/full 2> '" + reported.string() + "'";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  EXPECT_EQ(text_of_file(reported), "cairn: standard output cannot be written\n");
}

TEST(BadCommand, SeedsThatNoNumberHoldsAreRefused) {
  for (const std::string seed : {"99999999999999999999", "-1", "abc"}) {
    const Finished finished = run_cairn({"plan", "a.cairn", "--from", "1,1", "--to", "2,2", "--seed", seed});
    EXPECT_EQ(finished.exit_status, 2) << seed;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("--seed"), HasSubstr(seed)));
  }
}

TEST(BadCommand, NumbersOutsideTheirRangeAreRefusedAndNanIsOutsideEvery) {
  const std::vector<std::vector<std::string>> commands{
      {"plan", "x.cairn", "--from", "0,0", "--to", "1,1", "--radius-m"},
      {"plan", "x.cairn", "--from", "0,0", "--to", "1,1", "--budget-ms"},
      {"map", "lint", "x.cairn", "--radius-m"},
      {"map", "lint", "x.cairn", "--near-m"},
      {"template", "list", config("templates"), "--cell-m"},
      {"template", "list", config("templates"), "--step-deg"},
      {"template", "capture", "x.cairn", "--at", "L1", "--category", "c", "-o", "c.yaml", "--radius-m"}};
  for (const std::vector<std::string>& command : commands)
    for (const std::string value : {"nan", "-nan", "inf", "-1", "two"}) {
      std::vector<std::string> with_value = command;
      with_value.back() += "=" + value;
      const Finished finished = run_cairn(with_value);
      EXPECT_EQ(finished.exit_status, 2) << with_value.back();
      EXPECT_THAT(finished.err,
                  AllOf(HasSubstr(command.back() + ": must be a number from "), HasSubstr("found \"" + value + "\"")));
    }
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

TEST(BadPlugin, ALibraryThatIsNoModuleIsReportedAndTheOthersStayUsable) {
  const Finished finished =
      run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/not_a_module"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, HasSubstr("not_a_module.so: is not a Cairn module"));
  EXPECT_THAT(finished.out, HasSubstr("simulated_robot"));
}

TEST(BadPlugin, CheckNamesWhatASystemLibraryLacks) {
  const Finished finished = run_cairn({"plugins", "check", "/lib/x86_64-linux-gnu/libc.so.6"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, HasSubstr("libc.so.6: is not a Cairn module (it exports no cairn_abi_stamp"));
}

TEST(BadPlugin, CheckFindsAShippedModuleUsable) {
  const Finished finished =
      run_cairn({"plugins", "check", std::string(CAIRN_BINARY_DIR) + "/lib/cairn/bayes_map.so", "--json"});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  const auto answer = nlohmann::json::parse(finished.out);
  EXPECT_EQ(answer["modules"][0]["name"], "bayes");
  EXPECT_TRUE(answer["faults"].empty());
}

// Packages are stripped: of the symbols only the dynamic ones are left.
TEST(BadPlugin, AStrippedModuleIsStillOne) {
  const auto folder = fresh_folder("stripped");
  const std::string module = (folder / "bayes_map.so").string();
  std::filesystem::copy_file(std::string(CAIRN_BINARY_DIR) + "/lib/cairn/bayes_map.so", module);
  ASSERT_EQ(std::system(("strip --strip-all '" + module + "'").c_str()), 0);
  // Only its name is taken already, by the module that it is a copy of.
  EXPECT_THAT(run_cairn({"plugins", "check", module}).out,
              AllOf(HasSubstr("cairn_abi_stamp, cairn_register_module"), HasSubstr("registers map bayes"),
                    HasSubstr("the name \"bayes\" is taken")));
}

TEST(BadPlugin, AModuleCutShortIsReported) {
  const auto folder = fresh_folder("cut_short");
  const std::filesystem::path module = folder / "bayes_map.so";
  std::filesystem::copy_file(std::string(CAIRN_BINARY_DIR) + "/lib/cairn/bayes_map.so", module);
  for (const std::uintmax_t size : {4000U, 200U, 63U, 10U, 0U}) {
    std::filesystem::resize_file(module, size);
    EXPECT_EQ(run_cairn({"plugins", "check", module.string()}).exit_status, 1) << size;
  }
}

TEST(BadPlugin, AnotherAbiStampIsReportedWithBothSides) {
  const Finished finished =
      run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/wrong_stamp"});
  EXPECT_THAT(finished.err, AllOf(HasSubstr("wrong_stamp.so: was built with another ABI"), HasSubstr("gcc 99.0")));
}

// Recorded tables that are wrong, each in its own way: two sonars, a time and a pose a line.
class BadLog : public testing::Test {
 protected:
  Finished run(const std::string& table) {
    write_text(folder_ / "log.txt", table);
    write_text(folder_ / "log.yaml",
               "mission: log\nrobot: " + config("robots/pioneer1.yaml") +
                   "\nsensor:\n  plugin: table_log\n  file: log.txt\n  time_column: 1\n  x_column: 2\n  y_column: 3\n"
                   "  heading_column: 4\n  first_range_column: 5\n  compass_from_pose: true\n"
                   "  sonars:\n    - {angle_deg: 90}\n    - {angle_deg: -90}\n"
                   "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes}\n");
    return run_cairn({"run", (folder_ / "log.yaml").string(), "--out", (folder_ / "out").string()});
  }
  void expect_refused(const std::string& table, const std::string& line_and_column, const std::string& what) {
    const Finished finished = run(table);
    EXPECT_EQ(finished.exit_status, 2) << finished.out;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("log.txt:" + line_and_column), HasSubstr(what)));
  }

  const std::string good_ = "0.0 0 0 0 1.0 1.2\n0.1 0.02 0 0 1.0 1.2\n";
  const std::filesystem::path folder_ = fresh_folder("bad_log");
};

TEST_F(BadLog, AGoodOneRuns) {
  EXPECT_EQ(run(good_).exit_status, 0);
}

TEST_F(BadLog, AnEmptyOneIsRefused) {
  expect_refused("", " ", "the log holds no observation");
}

TEST_F(BadLog, TimeThatGoesBackwardsIsRefusedWithItsLine) {
  expect_refused(good_ + "0.05 0.04 0 0 1.0 1.2\n", "3:1: ", "time goes backwards, from 0.1 s to 0.05 s");
}

TEST_F(BadLog, APoseThatIsNoNumberIsRefusedWithItsPlace) {
  expect_refused(good_ + "0.2 nan 0 0 1.0 1.2\n", "3:5: ", "must be finite");
}

TEST_F(BadLog, ALineCutShortIsRefusedWithItsLine) {
  expect_refused(good_ + "0.2 0.04 0 0 1.0\n", "3:", "the line has 5 columns, but column 6 is to be the range 2");
}

// A sonar that failed once is no reason to lose the drive.
TEST_F(BadLog, ARangeThatIsNoNumberIsAnInvalidReading) {
  const Finished finished = run(good_ + "0.2 0.04 0 0 nan 1.2\n");
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
}

}  // namespace
}  // namespace cairn::testing_program
