// What a user sees who gets a command or a module wrong: exit status 2 and a sentence.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string config(const std::string& path) {
  return source_folder() + "/config/" + path;
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

TEST(PluginsInfo, ListsTheTopLevelAGroupOrAll) {
  const std::string top = run_cairn({"plugins", "info", "explore"}).out;
  EXPECT_THAT(top, HasSubstr("  driving  (map, a group of "));
  EXPECT_THAT(top, HasSubstr("`cairn plugins info explore "));
  EXPECT_THAT(top, Not(HasSubstr("max_in_a_row")));
  EXPECT_THAT(run_cairn({"plugins", "info", "explore", "--all"}).out, HasSubstr("max_in_a_row"));
  EXPECT_THAT(run_cairn({"plugins", "info", "explore", "exploring.blocked"}).out,
              AllOf(HasSubstr("max_in_a_row"), HasSubstr("`cairn plugins info explore exploring.blocked.back_up`")));
  const Finished unknown = run_cairn({"plugins", "info", "explore", "exploring.bloked"});
  EXPECT_EQ(unknown.exit_status, 2);
  EXPECT_THAT(unknown.err,
              HasSubstr("no group \"bloked\" of settings in explore.exploring (did you mean \"blocked\"?)"));
}

TEST(BadPlugin, ALibraryThatIsNoModuleIsReportedAndTheOthersStayUsable) {
  const Finished finished =
      run_cairn({"plugins", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/not_a_module"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, HasSubstr("not_a_module.so: is not a Cairn module"));
  EXPECT_THAT(finished.out, HasSubstr("simulated_robot"));
}

TEST(BadPlugin, AFolderOfModulesThatDoesNotExistIsRefused) {
  const Finished finished = run_cairn({"plugins", "--plugins", "/nowhere/at/all"});
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err, HasSubstr("--plugins /nowhere/at/all: no such folder"));
}

TEST(BadPlugin, CheckPrintsOneLineAFile) {
  const std::string module = std::string(CAIRN_BINARY_DIR) + "/lib/cairn/bayes_map.so";
  EXPECT_EQ(run_cairn({"plugins", "check", module}).out, module + ": ok: map bayes\n");
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
  const auto answer = nlohmann::json::parse(run_cairn({"plugins", "check", module, "--json"}).out);
  EXPECT_NE(answer["stamp"], "");
  EXPECT_EQ(answer["modules"][0]["kind"], "map");
  EXPECT_EQ(answer["modules"][0]["name"], "bayes");
  EXPECT_THAT(answer["faults"].dump(), HasSubstr("the name \\\"bayes\\\" is taken"));
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

}  // namespace
}  // namespace cairn::testing_program
