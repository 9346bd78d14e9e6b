// A module ends the process in the middle of a mission: the robot is stopped first, and people learn where.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/scenario/program.hpp"

namespace {

using cairn::testing_program::Finished;
using cairn::testing_program::run_cairn;
using testing::HasSubstr;

class FatalEnds : public testing::Test {
 protected:
  FatalEnds() { std::filesystem::create_directories(folder_); }
  ~FatalEnds() override { std::filesystem::remove_all(folder_); }

  void write_mission(const std::string& step, const std::string& localizer,
                     const std::string& sensor = "counting_sensor, readings: 1000") const {
    std::ofstream(folder_ / "mission.yaml")
        << "mission: fatal\nrobot: " << CAIRN_SOURCE_DIR
        << "/config/robots/pioneer1.yaml\n"
           "sensor: {plugin: "
        << sensor << "}\nmap: {plugin: empty_map}\nwatchdog_s: 1\nlocalizer: {plugin: " << localizer << "}\nsteps: ["
        << step << "]\n";
  }
  [[nodiscard]] Finished run(const std::string& step, const std::string& localizer = "still_localizer",
                             const std::vector<std::string>& command = {"run"}) const {
    write_mission(step, localizer);
    std::vector<std::string> words = command;
    words.insert(words.end(), {(folder_ / "mission.yaml").string(), "--plugins",
                               std::string(CAIRN_BINARY_DIR) + "/tests/plugin/faulty", "--json"});
    if (command.front() == "run") words.insert(words.end(), {"--out", folder_.string()});
    return run_cairn(words);
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_fatal_ends_" + std::to_string(getpid()));
};

TEST_F(FatalEnds, ACrashStopsTheRobotAndNamesModuleAndStage) {
  const Finished finished = run("crash");
  EXPECT_NE(finished.exit_status, 0);
  EXPECT_THAT(finished.err, HasSubstr("cairn: SIGSEGV in stage behaviour of module crash; the robot was stopped\n"));
}

TEST_F(FatalEnds, AnOverflowOfTheStackDoesToo) {
  const Finished finished = run("overflow");
  EXPECT_NE(finished.exit_status, 0);
  EXPECT_THAT(finished.err, HasSubstr(" in stage behaviour of module overflow; the robot was stopped\n"));
}

TEST_F(FatalEnds, AnExceptionThatNobodyCatchesDoesToo) {
  const Finished finished = run("terminate");
  EXPECT_NE(finished.exit_status, 0);
  EXPECT_THAT(
      finished.err,
      HasSubstr("cairn: SIGABRT in another thread, while the mission was in stage behaviour of module terminate; "
                "the robot was stopped\n"));
}

TEST_F(FatalEnds, ASignalThatNobodyHandlesDoesToo) {
  const Finished finished = run("alarm");
  EXPECT_NE(finished.exit_status, 0);
  EXPECT_THAT(finished.err, HasSubstr("cairn: SIGALRM while the mission was in stage behaviour of module alarm; the "
                                      "robot was stopped\n"));
}

TEST_F(FatalEnds, AModuleThatCallsExitWhileItIsMadeEndsNoCommandWithSuccess) {
  for (const std::vector<std::string>& command : {std::vector<std::string>{"run"}, {"mission", "check"}}) {
    const Finished finished = run("endless", "exiting_constructor", command);
    EXPECT_EQ(finished.exit_status, 1) << command.front();
    EXPECT_THAT(finished.err, HasSubstr("cairn: exit() was called while module exiting_constructor was being made\n"));
  }
}

TEST_F(FatalEnds, AModuleThatCrashesWhileItIsMadeIsNamed) {
  const Finished finished = run("endless", "crashing_constructor");
  EXPECT_NE(finished.exit_status, 0);
  EXPECT_THAT(finished.err, HasSubstr("cairn: SIGSEGV while module crashing_constructor was being made\n"));
}

TEST_F(FatalEnds, AModuleThatIsNeverMadeIsGivenUp) {
  const Finished finished = run("endless", "hanging_constructor");
  EXPECT_EQ(finished.exit_status, 2);
  EXPECT_THAT(finished.err,
              HasSubstr("cairn: module hanging_constructor has not been made within 10 s and was given up\n"));
}

TEST_F(FatalEnds, AModuleThatIsNeverMadeDoesNotKeepTheUserFromEndingTheProgram) {
  write_mission("endless", "hanging_constructor");
  const Finished finished = cairn::testing_program::interrupt_cairn(
      {"run", (folder_ / "mission.yaml").string(), "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/faulty",
       "--out", folder_.string(), "--set", "watchdog_s=0"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, HasSubstr("cancelled by the user before the mission began: module hanging_constructor was "
                                      "still being made"));
}

TEST_F(FatalEnds, NorFromEndingTheOtherCommandsThatMakeModules) {
  std::ofstream(folder_ / "experiment.yaml") << "experiment: missions\nmissions: [mission.yaml]\nseeds: {count: 2}\n";
  const auto expect_ended = [&](const std::string& module, std::vector<std::string> words) {
    words.insert(words.end(), {"--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/faulty"});
    const Finished finished = cairn::testing_program::interrupt_cairn(words);
    EXPECT_EQ(finished.exit_status, 1) << words.front();
    EXPECT_EQ(finished.err, "cairn: module " + module + " was still being made\n") << words.front();
  };
  const std::string mission = (folder_ / "mission.yaml").string();
  write_mission("endless", "hanging_constructor");
  expect_ended("hanging_constructor",
               {"experiment", (folder_ / "experiment.yaml").string(), "--out", folder_.string()});
  write_mission("endless", "still_localizer", "hanging_sensor");
  expect_ended("hanging_sensor", {"base", mission, "--listen", (folder_ / "base.sock").string()});
  expect_ended("hanging_sensor", {"doctor", "live", mission});
}

TEST_F(FatalEnds, AModuleThatCallsExitInAThreadOfItsOwnEndsTheMissionAsAFaultToo) {
  const Finished finished = run("exit_elsewhere");
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.err, HasSubstr("cairn: exit() was called in another thread, while the mission was in stage "
                                      "behaviour of module exit_elsewhere; the robot was stopped\n"));
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary.at("outcome"), "module_fault");
  EXPECT_EQ(summary.at("reason"), "exit() was called in a thread of a module's own");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "fatal.cairn"));
}

TEST_F(FatalEnds, AModuleThatCallsExitEndsTheMissionAsAFaultAndTheMapIsSaved) {
  for (const std::string step : {"exit_well", "exit_quickly"}) {
    const Finished finished = run(step);
    EXPECT_EQ(finished.exit_status, 1);
    const auto summary = nlohmann::json::parse(finished.out);
    EXPECT_EQ(summary.at("outcome"), "module_fault");
    EXPECT_EQ(summary.at("reason"), "module " + step + " called exit() in stage behaviour");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "fatal.cairn"));
    std::filesystem::remove(folder_ / "fatal.cairn");
  }
}

}  // namespace
