// Missions whose modules fail: the robot stops, the outcome names the module, the map is saved.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/host/fence.hpp"
#include "framework/host/mission_runner.hpp"

namespace cairn {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class FencedMission : public testing::Test {
 protected:
  FencedMission() : folder_(fs::path(testing::TempDir()) / ("cairn_fenced_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }

  Mission mission_with(const std::string& localizer, const std::string& map, const std::string& steps) {
    std::ofstream(folder_ / "mission.yaml")
        << "mission: fenced\nrobot: " << CAIRN_SOURCE_DIR
        << "/config/robots/pioneer1.yaml\nsensor: {plugin: counting_sensor}\n"
        << "localizer: {plugin: " << localizer << "}\nmap: {plugin: " << map << "}\nsteps: " << steps << "\n";
    return load_mission(folder_ / "mission.yaml");
  }

  MissionResult run(const std::string& localizer, const std::string& map, const std::string& steps = "[endless]") {
    MissionRunner runner(mission_with(localizer, map, steps), library_, {folder_, false, nullptr});
    return runner.run();
  }

  const fs::path folder_;
  const ModuleLibrary library_{{fs::path(CAIRN_BINARY_DIR) / "tests" / "plugin" / "faulty"}};
};

TEST_F(FencedMission, AModuleThatThrowsInACallIsNamedAndTheMapIsSaved) {
  fs::remove(folder_ / "fenced.cairn");
  const MissionResult result = run("still_localizer", "throwing_map");
  EXPECT_EQ(result.outcome, MissionOutcome::module_fault);
  EXPECT_EQ(result.reason, "module throwing_map failed in stage map: the map is torn");
  EXPECT_EQ(result.map_file, "fenced.cairn");
  EXPECT_TRUE(fs::exists(folder_ / "fenced.cairn"));
}

TEST_F(FencedMission, SomethingThatIsNoExceptionIsFencedToo) {
  EXPECT_EQ(run("still_localizer", "number_throwing_map").reason,
            "module number_throwing_map failed in stage map: threw something that is no std::exception");
}

TEST_F(FencedMission, APoseThatIsNotANumberEndsTheMission) {
  EXPECT_EQ(run("nan_localizer", "empty_map").reason,
            "module nan_localizer failed in stage localizer: returned a pose that is not finite");
}

TEST_F(FencedMission, AConstructorThatThrowsIsNamed) {
  try {
    (void)run("throwing_constructor", "empty_map");
    FAIL() << "no error";
  } catch (const ModuleFault& fault) {
    EXPECT_STREQ(fault.what(), "module throwing_constructor failed in stage construction: no such device");
  }
}

TEST_F(FencedMission, AFailedStepEndsTheMissionWithItsReason) {
  const MissionResult result = run("still_localizer", "empty_map", "[fail, endless]");
  EXPECT_EQ(result.outcome, MissionOutcome::step_failed);
  EXPECT_EQ(result.reason, "step 1 (fail): does not feel like it");
}

TEST_F(FencedMission, DataThatEndsBeforeTheStepsIsAFailure) {
  const MissionResult result = run("still_localizer", "empty_map", "[endless]");
  EXPECT_EQ(result.outcome, MissionOutcome::step_failed);
  EXPECT_EQ(result.reason, "the sensor's data ended before the steps did");
}

TEST_F(FencedMission, CancelEndsTheMissionAndSavesTheMap) {
  const std::atomic<bool> cancel{true};
  MissionRunner runner(mission_with("still_localizer", "empty_map", "[endless]"), library_, {folder_, false, &cancel});
  const MissionResult result = runner.run();
  EXPECT_EQ(result.outcome, MissionOutcome::cancelled);
  EXPECT_EQ(result.map_file, "fenced.cairn");
}

TEST_F(FencedMission, AnUnknownStepIsAnErrorWithItsPlace) {
  try {
    (void)run("still_localizer", "empty_map", "[endles]");
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("mission.yaml:6:"),
                                    HasSubstr("unknown behaviour plugin \"endles\" (did you mean \"endless\"?)")));
  }
}

}  // namespace
}  // namespace cairn
