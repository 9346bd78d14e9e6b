// Missions whose modules are written in Python, by the program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "maps/store/map_store.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

const std::string kExamples = source_folder() + "/docs/examples/python_modules";

Finished run_of(const std::filesystem::path& mission, const std::filesystem::path& out,
                const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{"run", mission.string(), "--out", out.string(), "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_cairn(arguments);
}

// A mission whose one step is the class It of this text.
std::filesystem::path mission_with_step(const std::filesystem::path& folder, const std::string& text) {
  write_text(folder / "it.py", text);
  write_text(folder / "mission.yaml", "mission: python\nrobot: " + source_folder() +
                                          "/config/robots/pioneer1.yaml\nworld: " + kExamples +
                                          "/pillars_world.yaml\nstart: {at_m: [1, 1.2]}\n"
                                          "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                          "map: {plugin: bayes, cell_m: 0.05}\n"
                                          "steps:\n  - python: {file: it.py, class: It}\n");
  return folder / "mission.yaml";
}

std::string step(const std::string& body) {
  return "import os, sys, time\n"
         "class It:\n"
         "  def __init__(self, context): self.ticks = 0\n"
         "  def tick(self, world, ask):\n"
         "    self.ticks += 1\n" +
         body + "    return 'running', 'on its way'\n";
}

TEST(PythonMission, ADetectorFindsThePillarsAndAStepVisitsThem) {
  const auto out = fresh_folder("python_pillars");
  const Finished run = run_of(kExamples + "/pillars.yaml", out);
  ASSERT_EQ(run.exit_status, 0) << run.out << run.err;
  const json report = json::parse(run.out);
  ASSERT_EQ(report["landmarks"].size(), 2U) << report["landmarks"].dump(1);
  std::vector<double> x_m;
  for (const json& landmark : report["landmarks"]) {
    EXPECT_EQ(landmark["category"], "pillar");
    EXPECT_NEAR(landmark["y_m"].get<double>(), 2.0, 0.1);
    x_m.push_back(landmark["x_m"].get<double>());
  }
  std::sort(x_m.begin(), x_m.end());
  EXPECT_NEAR(x_m[0], 1.8, 0.1);
  EXPECT_NEAR(x_m[1], 4.2, 0.1);
  const auto again = fresh_folder("python_pillars_again");
  ASSERT_EQ(run_of(kExamples + "/pillars.yaml", again).exit_status, 0);
  EXPECT_EQ(text_of_file(out / "pillars.cairn"), text_of_file(again / "pillars.cairn"))
      << "the same seed, the same bytes";
}

TEST(PythonMission, ASensorPlaysACsvFile) {
  const auto out = fresh_folder("python_corridor");
  const Finished run = run_of(kExamples + "/corridor.yaml", out);
  ASSERT_EQ(run.exit_status, 0) << run.out << run.err;
  const json report = json::parse(run.out);
  EXPECT_NEAR(report["distance_m"].get<double>(), 5.0, 0.2);
  const OccupancyGrid grid = load_map(out / "corridor.cairn").grid;
  EXPECT_EQ(grid.state(grid.cell_at({3.0, 1.0})), CellState::free);
}

TEST(PythonMission, AnExceptionStopsTheMissionIsReportedWithItsTraceAndTheMapIsSaved) {
  const auto folder = fresh_folder("python_exception");
  const auto mission = mission_with_step(folder, step("    ask.drive(0.1)\n    if self.ticks == 40: self.halted\n"));
  const Finished run = run_of(mission, folder / "out");
  EXPECT_EQ(run.exit_status, 1);
  const json report = json::parse(run.out);
  EXPECT_EQ(report["outcome"], "module_fault");
  EXPECT_THAT(report["reason"].get<std::string>(),
              AllOf(ContainsRegex(
                        "^module python failed in stage behaviour: [^\n]*/it.py:7:[0-9]+: AttributeError: 'It' object "
                        "has no attribute 'halted'\nTraceback"),
                    HasSubstr("line 7, in tick")));
  EXPECT_NO_THROW((void)load_map(folder / "out" / "python.cairn"));
}

TEST(PythonMission, TheEndOfTheProgramIsAFault) {
  for (const std::string end : {"sys.exit(0)", "raise KeyboardInterrupt", "exit()"}) {
    const auto folder = fresh_folder("python_exit");
    const Finished run = run_of(mission_with_step(folder, step("    " + end + "\n")), folder / "out");
    EXPECT_EQ(run.exit_status, 1) << end;
    EXPECT_EQ(json::parse(run.out)["outcome"], "module_fault") << end << run.out;
  }
}

TEST(PythonMission, ALoopWithoutEndIsGivenUpAndTheMapIsSaved) {
  for (const std::string loop : {"while True: pass", "time.sleep(1000)"}) {
    const auto folder = fresh_folder("python_loop");
    const auto mission = mission_with_step(folder, step("    if self.ticks == 20:\n      " + loop + "\n"));
    const Finished run = run_of(mission, folder / "out", {"--set", "watchdog_s=0.5"});
    EXPECT_EQ(run.exit_status, 1);
    const json report = json::parse(run.out);
    EXPECT_EQ(report["outcome"], "module_fault");
    EXPECT_THAT(report["reason"].get<std::string>(), HasSubstr("has not returned from stage behaviour"));
    EXPECT_NO_THROW((void)load_map(folder / "out" / "python.cairn"));
  }
}

TEST(PythonMission, CtrlCEndsTheMissionNotTheModule) {
  const auto folder = fresh_folder("python_interrupt");
  const auto mission = mission_with_step(folder, step("    ask.drive(0.0)\n"));
  const Finished run = interrupt_cairn({"run", mission.string(), "--out", (folder / "out").string(), "--realtime"});
  EXPECT_EQ(run.exit_status, 1) << run.err;
  EXPECT_THAT(run.out, HasSubstr("cancelled by the user"));
  EXPECT_NO_THROW((void)load_map(folder / "out" / "python.cairn"));
}

TEST(PythonMission, WhatAModulePrintsLeavesTheReportAlone) {
  const auto folder = fresh_folder("python_print");
  const auto mission = mission_with_step(folder, step("    print('ping\\x1b[32m')\n    return 'success', 'done'\n"));
  const Finished run = run_of(mission, folder / "out");
  EXPECT_EQ(run.exit_status, 0) << run.err;
  EXPECT_TRUE(json::accept(run.out)) << run.out;
  EXPECT_THAT(run.err, HasSubstr("ping\\x1b[32m\n")) << "and steers no terminal";
}

TEST(PythonMission, AMistakeIsFoundBeforeTheMissionBegins) {
  const auto folder = fresh_folder("python_mistake");
  const auto mission = mission_with_step(folder, "class If:\n  def tick(self, world, ask): pass\n");
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"run", mission.string(), "--out", (folder / "out").string()},
        std::vector<std::string>{"mission", "check", mission.string()}}) {
    const Finished run = run_cairn(command);
    EXPECT_EQ(run.exit_status, 2) << run.out;
    EXPECT_THAT(run.out + run.err, ContainsRegex("mission.yaml:9:34: [^\n]*it.py has no class \"It\" \\(did you mean "
                                                 "\"If\"\\?\\)"));
  }
}

TEST(PythonMission, TheProgramDescribesTheModulesOfAllThreeKinds) {
  const Finished info = run_cairn({"plugins", "info", "python"});
  EXPECT_EQ(info.exit_status, 0) << info.err;
  for (const char* kind : {"python: sensor", "python: detector", "python: behaviour"})
    EXPECT_THAT(info.out, HasSubstr(kind));
  const Finished as_json = run_cairn({"plugins", "info", "python", "--json"});
  EXPECT_EQ(json::parse(as_json.out)["modules"].size(), 3U);
}

}  // namespace
}  // namespace cairn::testing_program
