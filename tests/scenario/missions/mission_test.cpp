// `cairn mission check` and `cairn mission show`, and a mission that is a tree.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
}

// Three files: the mission, with these steps, runs sub.yaml.
std::filesystem::path mission_in(const std::filesystem::path& folder, const std::string& steps) {
  write_text(folder / "sub.yaml", "parameters: {for_s: 1}\nsteps:\n  - wait: {for_s: $for_s}\n");
  write_text(folder / "tree.yaml", "mission: tree\nrobot: " + config("robots/pioneer1.yaml") +
                                       "\nworld: " + config("worlds/mapping_smooth_hallway.yaml") +
                                       "\nstart: {at_m: [1.727, 1.774]}\nsensor: {plugin: simulated_robot}\n"
                                       "localizer: {plugin: odometry_compass}\nmap: {plugin: bayes}\nsteps:\n" +
                                       steps);
  return folder / "tree.yaml";
}

TEST(MissionCommand, EveryShippedMissionOfTheSimulatorIsFine) {
  const Finished finished =
      run_cairn({"mission", "check", config("missions/office.yaml"), config("missions/patrol_or_wait.yaml")});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("office.yaml: fine, 3 steps, 3 nodes\n"),
                                  HasSubstr("patrol_or_wait.yaml: fine, 3 steps, ")));
}

TEST(MissionCommand, CheckReportsAllErrorsOfTheTreeAndOfTheModules) {
  const auto folder = fresh_folder("mission_check");
  const std::filesystem::path file = mission_in(folder,
                                                "  - retry: {times: 0, do: wait}\n"
                                                "  - fallback: [{goto: {landmrk: L1}}, {wait: {for_s: -1}}]\n"
                                                "  - sequnce: [wait]\n"
                                                "  - mission: {file: sub.yaml, with: {for_s: long}}\n"
                                                "  - goto: {}\n");
  const Finished finished = run_cairn({"mission", "check", file.string(), config("missions/office.yaml"), "--json"});
  EXPECT_EQ(finished.exit_status, 2);
  const auto rows = nlohmann::json::parse(finished.out)["missions"];
  EXPECT_EQ(rows[1]["outcome"], "fine");
  ASSERT_EQ(rows[0]["errors"].size(), 6U) << rows[0].dump(1);
  const std::string place = file.string() + ":";
  const std::vector<std::string> expected = {place + "9:20: times must be",
                                             place +
                                                 "10:24: unknown key \"landmrk\" in plugin goto (did you mean "
                                                 "\"landmark\"?)",
                                             place + "10:54: for_s",
                                             place +
                                                 "11:5: unknown behaviour plugin \"sequnce\" (did you mean "
                                                 "\"sequence\"?)",
                                             place + "12:45: for_s must be a number",
                                             place + "13:5: goto: needs a landmark"};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_THAT(rows[0]["errors"][i].get<std::string>(), HasSubstr(expected[i]));
    EXPECT_THAT(finished.err, HasSubstr(expected[i]));
  }
}

TEST(MissionCommand, CheckFindsAStartThatTheWorldHasNoRoomFor) {
  const auto folder = fresh_folder("mission_start");
  const std::string file = mission_in(folder, "  - wait: 1\n").string();
  for (const auto& [at, why] : {std::pair("[3, 0.7]", "it would overlap"), std::pair("[-30, 2]", "lies outside")}) {
    const Finished finished = run_cairn({"mission", "check", file, "--set", std::string("start.at_m=") + at});
    EXPECT_EQ(finished.exit_status, 2) << at;
    EXPECT_THAT(finished.err, AllOf(HasSubstr("--set start.at_m: the robot cannot start at ("), HasSubstr(why)));
  }
  write_text(file, text_of_file(file).replace(text_of_file(file).find("1.727"), 5, "-9.99"));
  EXPECT_THAT(run_cairn({"mission", "check", file}).err, HasSubstr(file + ":4:15: the robot cannot start at (-9.99, "));
}

TEST(MissionCommand, CheckNamesMissingFilesWhereTheMissionDoes) {
  const auto folder = fresh_folder("mission_elsewhere");
  std::filesystem::create_directories(folder / "copied");
  const std::string file = (folder / "copied/office.yaml").string();
  std::filesystem::copy_file(config("missions/office.yaml"), file);
  const Finished finished = run_cairn({"mission", "check", file});
  EXPECT_EQ(finished.exit_status, 2);
  for (const char* named : {"robots/pioneer1.yaml: no such file", "worlds/office.yaml: no such file",
                            "templates: no such folder of templates"})
    EXPECT_THAT(finished.err, HasSubstr((folder / named).string()));
  EXPECT_THAT(finished.err, AllOf(HasSubstr(file + ":"), HasSubstr(": robot: "), HasSubstr(": world: ")));
}

TEST(MissionCommand, CheckReportsWhatCannotBeReadAtAll) {
  const Finished finished = run_cairn({"mission", "check", config("missions/ofice.yaml")});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("no such file (did you mean \"office.yaml\"?)"));
  EXPECT_EQ(run_cairn({"mission", "check"}).exit_status, 2);
  EXPECT_THAT(run_cairn({"mission", "chekc"}).err, HasSubstr("did you mean \"check\"?"));
}

TEST(MissionCommand, ShowPrintsAndDrawsTheTreeWithItsSubMissions) {
  const auto folder = fresh_folder("mission_show");
  const std::filesystem::path file =
      mission_in(folder, "  - name: both\n    parallel: [{mission: sub.yaml}, {wait: 3}]\n");
  const std::string picture = (folder / "tree.png").string();
  const Finished shown = run_cairn({"mission", "show", file.string(), "--picture", picture});
  EXPECT_EQ(shown.exit_status, 0) << shown.err;
  EXPECT_EQ(shown.out,
            "mission tree: 1 step, 4 nodes\n"
            "1      parallel \"both\"\n"
            "1/1      mission \"sub\"  sub.yaml\n"
            "1/1/1      wait         for_s: 1\n"
            "1/2      wait           3\n");
  EXPECT_EQ(text_of_file(picture).substr(1, 3), "PNG");
  const auto json = nlohmann::json::parse(run_cairn({"mission", "show", file.string(), "--json"}).out);
  const auto& wait = json["steps"][0]["children"][0]["children"][0];
  EXPECT_EQ(wait["path"], "1/1/1");
  EXPECT_EQ(wait["kind"], "wait");
  EXPECT_EQ(wait["settings"]["for_s"], 1);
  EXPECT_EQ(wait["place"], (folder / "sub.yaml").string() + ":3:5");
}

TEST(MissionCommand, ATreeRunsAndIsReportedAsItGoes) {
  const auto folder = fresh_folder("mission_tree");
  const std::filesystem::path file = mission_in(folder,
                                                "  - fallback: [{landmark_known: square}, {mission: sub.yaml}]\n"
                                                "  - wait: 1\n");
  const Finished finished = run_cairn({"run", file.string(), "--out", (folder / "out").string()});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_THAT(finished.out, AllOf(HasSubstr("s  step 1: fallback\n"), HasSubstr("s  step 1/2/1: wait\n"),
                                  HasSubstr("s  step 1/2/1: wait done (waited)\n"),
                                  HasSubstr("s  step 1: fallback done (waited)\n"), HasSubstr("s  step 2: wait\n")));
  const auto nodes = nlohmann::json::parse(text_of_file(folder / "out" / "report.json"))["nodes"];
  ASSERT_EQ(nodes.size(), 5U);
  EXPECT_EQ(nodes[1]["reason"], "no landmark \"square\" is known");
}

// A detector that reports nothing below its threshold leaves nothing to draw, which is no fault.
TEST(Run, DrawsEveryPictureOfAMissionWithoutLandmarks) {
  const auto folder = fresh_folder("mission_without_landmarks");
  const std::filesystem::path file = mission_in(folder,
                                                "  - drive: [[2.0, 1.774]]\n"
                                                "detector: {plugin: template_matcher, degrees: above_threshold, "
                                                "templates: " +
                                                    config("templates") + "}\n");
  const Finished finished = run_cairn({"run", file.string(), "--out", folder.string()});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_THAT(finished.out, testing::Not(HasSubstr("no picture")));
  EXPECT_TRUE(std::filesystem::exists(folder / "map.png"));
}

TEST(Run, WithoutAPlannerDrivesByItsOwnEyes) {
  const auto folder = fresh_folder("mission_without_planner");
  const std::filesystem::path file = mission_in(folder, "  - goto: {at_m: [2.1, 1.774]}\n");
  const Finished finished = run_cairn({"run", file.string(), "--out", folder.string()});
  EXPECT_EQ(finished.exit_status, 0) << finished.err;
  EXPECT_THAT(text_of_file(folder / "report.json"), HasSubstr("at (2.10, 1.77)"));
}

}  // namespace
}  // namespace cairn::testing_program
