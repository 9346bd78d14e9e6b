// Missions whose modules fail: the robot stops, the outcome names the module, the map is saved.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>
#include <tuple>

#include "framework/mission/runner.hpp"
#include "framework/modules/fence.hpp"
#include "framework/reporting/report.hpp"

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

  Mission mission_with(const std::string& localizer, const std::string& map, const std::string& steps,
                       const std::string& more = "") {
    std::ofstream(folder_ / "mission.yaml")
        << "mission: fenced\nrobot: " << CAIRN_SOURCE_DIR
        << "/config/robots/pioneer1.yaml\nsensor: {plugin: counting_sensor}\n"
        << "localizer: {plugin: " << localizer << "}\nmap: {plugin: " << map << "}\nsteps: " << steps << "\n"
        << more;
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

TEST_F(FencedMission, AnOdometryThatIsNotANumberEndsTheMission) {
  (void)mission_with("still_localizer", "empty_map", "[endless]");
  const Mission mission = load_mission(folder_ / "mission.yaml", {"sensor={plugin: nan_sensor}"});
  const MissionResult result = MissionRunner(mission, library_, {folder_, false, nullptr}).run();
  EXPECT_EQ(result.reason,
            "module nan_sensor failed in stage sensor: returned a stamp or an odometry that is not finite");
}

TEST_F(FencedMission, AnOdometryThatLeapsEndsTheMissionAndTheMapIsSaved) {
  (void)mission_with("still_localizer", "empty_map", "[endless]");
  const Mission mission = load_mission(folder_ / "mission.yaml", {"sensor={plugin: leaping_sensor}"});
  const MissionResult result = MissionRunner(mission, library_, {folder_, false, nullptr}).run();
  EXPECT_EQ(result.reason,
            "module leaping_sensor failed in stage sensor: returned an odometry that leaps by 1e+12 m within 0.04 s");
  EXPECT_TRUE(fs::exists(folder_ / result.map_file));
}

TEST_F(FencedMission, ADetectionThatIsNotANumberEndsTheMission) {
  const Mission mission =
      mission_with("still_localizer", "empty_map", "[endless]", "detector: {plugin: nan_detector}\n");
  const MissionResult result = MissionRunner(mission, library_, {folder_, false, nullptr}).run();
  EXPECT_EQ(result.reason, "module nan_detector failed in stage detector: returned a detection that is not finite");
  EXPECT_TRUE(fs::exists(folder_ / result.map_file));
}

TEST_F(FencedMission, AVelocityThatIsNotANumberEndsTheMission) {
  EXPECT_EQ(run("still_localizer", "empty_map", "[drive_nan]").reason,
            "module drive_nan failed in stage behaviour: asked for a velocity that is not finite");
}

class FencedLoopClosing : public FencedMission {
 protected:
  // Of a mission whose localizer asks this loop closer at each observation.
  std::string reason_with(const std::string& closer, const std::string& more = "") {
    MissionRunner runner(
        mission_with("asking_localizer", "empty_map", "[endless]", "loop_closer: {plugin: " + closer + "}\n" + more),
        library_, {folder_, false, nullptr});
    const MissionResult result = runner.run();
    EXPECT_EQ(result.outcome, MissionOutcome::module_fault);
    EXPECT_TRUE(fs::exists(folder_ / result.map_file));
    return result.reason;
  }
};

TEST_F(FencedLoopClosing, WhatALoopCloserThrowsInAnotherThreadNamesIt) {
  EXPECT_EQ(reason_with("throwing_closer"),
            "module throwing_closer failed in stage loop closer: no memory of this place");
  EXPECT_EQ(reason_with("number_throwing_closer"),
            "module number_throwing_closer failed in stage loop closer: threw something that is no std::exception");
}

TEST_F(FencedLoopClosing, AProposalThatCannotBeEndsTheMission) {
  EXPECT_EQ(reason_with("nan_closer"),
            "module nan_closer failed in stage loop closer: proposed a loop that is not finite");
  EXPECT_EQ(reason_with("elsewhere_closer"),
            "module elsewhere_closer failed in stage loop closer: proposed a loop with submap 2 of 1");
}

TEST_F(FencedLoopClosing, ALoopCloserThatNeverReturnsIsNamedNotTheLocalizerThatWaitsForIt) {
  EXPECT_EQ(reason_with("hanging_closer", "watchdog_s: 0.2\n"),
            "module hanging_closer has not returned from stage loop closer for 200 ms and was given up");
}

TEST_F(FencedLoopClosing, ALoopCloserThatIsMissingIsAnErrorOfThatKey) {
  try {
    (void)reason_with("nan_closr");
    FAIL() << "no error";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(),
                AllOf(HasSubstr("mission.yaml:7:"),
                      HasSubstr("unknown loop_closer plugin \"nan_closr\" (did you mean \"nan_closer\"?)")));
  }
}

class ThrowingListener : public Listener {
 public:
  void on(const Event&, const MissionView&) override { throw std::runtime_error("no paper"); }
};

TEST_F(FencedMission, ListenersInAnyOrderOrFailingChangeNothing) {
  const auto result_with = [&](const std::vector<Listener*>& listeners) {
    MissionRunner runner(mission_with("still_localizer", "empty_map", "[fail]"), library_, {folder_, false, nullptr});
    for (Listener* listener : listeners) runner.subscribe(*listener);
    const MissionResult result = runner.run();
    return std::tuple(result.outcome, result.reason, result.time_s, runner.listener_faults().size());
  };
  ThrowingListener throwing;
  RunReport first, second, alone;
  const auto plain = result_with({&alone});
  EXPECT_EQ(result_with({&first, &throwing}),
            std::tuple(std::get<0>(plain), std::get<1>(plain), std::get<2>(plain), 1U));
  EXPECT_EQ(result_with({&throwing, &second}),
            std::tuple(std::get<0>(plain), std::get<1>(plain), std::get<2>(plain), 1U));
  const Mission mission = mission_with("still_localizer", "empty_map", "[fail]");
  const LandmarkGraph none;
  EXPECT_EQ(first.report_json(mission, {}, none, {}), alone.report_json(mission, {}, none, {}));
  EXPECT_EQ(second.report_json(mission, {}, none, {}), alone.report_json(mission, {}, none, {}));
}

// A mission whose module hangs, given up after 0.2 s.
class HangingMission : public FencedMission {
 protected:
  MissionRunner runner_of(const std::string& map, const std::string& steps) {
    return {mission_with("still_localizer", map, steps, "watchdog_s: 0.2\n"), library_, {folder_, false, nullptr}};
  }
};

TEST_F(HangingMission, ABehaviourThatNeverReturnsIsGivenUpAndTheMapIsSaved) {
  fs::remove(folder_ / "fenced.cairn");
  MissionRunner runner = runner_of("empty_map", "[hang]");
  const auto begin = std::chrono::steady_clock::now();
  const MissionResult result = runner.run();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
  EXPECT_TRUE(runner.gave_up());
  EXPECT_EQ(result.outcome, MissionOutcome::module_fault);
  EXPECT_EQ(result.reason, "module hang has not returned from stage behaviour for 200 ms and was given up");
  EXPECT_EQ(result.steps.at(0).status.state, StepState::failure);
  EXPECT_TRUE(fs::exists(folder_ / "fenced.cairn"));
  EXPECT_NE(runner.grid(), nullptr);
}

class CountingListener : public Listener {
 public:
  void on(const Event&, const MissionView&) override { ++reported; }
  std::atomic<int> reported = 0;
};

TEST_F(HangingMission, WhatComesBackAfterItWasGivenUpTouchesNothingMore) {
  CountingListener listener;
  MissionRunner runner = runner_of("empty_map", "[late, endless]");
  runner.subscribe(listener);
  const MissionResult result = runner.run();
  EXPECT_EQ(result.reason, "module late has not returned from stage behaviour for 200 ms and was given up");
  EXPECT_EQ(result.nodes.at(0).status.state, StepState::failure);
  const int reported = listener.reported;
  std::this_thread::sleep_for(std::chrono::milliseconds(800));
  EXPECT_EQ(listener.reported, reported);
}

TEST_F(HangingMission, TheMapOfAMapperThatNeverReturnsIsLeftAlone) {
  fs::remove(folder_ / "fenced.cairn");
  MissionRunner runner = runner_of("hanging_map", "[endless]");
  const MissionResult result = runner.run();
  EXPECT_THAT(result.reason, testing::StartsWith("module hanging_map has not returned from stage map for 200 ms"));
  EXPECT_EQ(runner.grid(), nullptr);
  EXPECT_FALSE(fs::exists(folder_ / "fenced.cairn"));
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
