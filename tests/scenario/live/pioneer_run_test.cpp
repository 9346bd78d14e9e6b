// Whole runs of a Pioneer on a pseudo-terminal: a button that is pressed, a full disk, a base that drives on in
// silence.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tests/plugins/p2os_robot/pioneer_on_a_terminal.hpp"
#include "tests/scenario/missions/doctor_mission.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using p2os_robot::PioneerOnATerminal;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kStands_s = 0.5;
constexpr double kBegins_s = 20.0;

class PioneerRun : public testing::Test {
 protected:
  [[nodiscard]] std::filesystem::path mission(const std::string& name) const {
    return doctor_mission(name, "plugin: p2os_robot, device: " + pioneer.device());
  }
  [[nodiscard]] static std::vector<std::string> run_of(const std::filesystem::path& mission, const std::string& steps) {
    return {"run", mission.string(), "--set", "steps=" + steps, "--out", (mission.parent_path() / "out").string()};
  }

  PioneerOnATerminal pioneer;
};

TEST_F(PioneerRun, AStepWaitsWhileItsEmergencyButtonIsPressedAndGoesOnWhenItIsReleased) {
  std::thread people([this] {
    EXPECT_TRUE(pioneer.wait_for_wheels(true, kBegins_s));
    pioneer.flags = 0x20;
    EXPECT_TRUE(pioneer.wait_for_wheels(false, kStands_s));
    std::this_thread::sleep_for(std::chrono::seconds(4));  // longer than the step is patient
    pioneer.flags = 1;
  });
  const Finished finished =
      run_cairn(run_of(mission("pressed_button"), "[drive: {points_m: [[0.4, 0]], patience_s: 1}]"));
  people.join();
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  EXPECT_THAT(finished.out,
              AllOf(HasSubstr("the robot is stopped by its emergency button: it stands until that is released"),
                    HasSubstr("released by its emergency button after ")));
}

TEST_F(PioneerRun, OnAFullDiskItDrivesOnAndStandsAtItsEnd) {
  std::vector<std::string> run = run_of(mission("full_disk"), "[drive: [[0.6, 0]], wait: 1]");
  run.insert(run.end(), {"--set", "autosave={every_s: 0.5}"});
  const Finished finished = run_cairn(run, Circumstances{1024, false});
  EXPECT_TRUE(pioneer.wait_for_wheels(false, kStands_s));
  EXPECT_GT(pioneer.driven_m(), 0.5) << finished.out << finished.err;
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("map_not_saved"), HasSubstr("autosave failed, the mission continues"),
                                  HasSubstr("the map could not be saved")));
  EXPECT_THAT(finished.err, HasSubstr("full_disk.log.gz"));
}

TEST_F(PioneerRun, TheDoctorSaysWhetherTheBaseStopsByItself) {
  const auto look = [this](const std::string& name) {
    return run_cairn({"doctor", "live", mission(name).string(), "--for", "1", "--wiggle"});
  };
  const Finished good = look("stops_in_silence");
  EXPECT_EQ(good.exit_status, 0) << good.out << good.err;
  EXPECT_THAT(good.out, HasSubstr("ok  stops in silence the base itself stood "));
  pioneer.watchdog_s = 60.0;
  const Finished bad = look("drives_on_in_silence");
  EXPECT_EQ(bad.exit_status, 1) << bad.out << bad.err;
  EXPECT_THAT(bad.out,
              AllOf(HasSubstr("BAD stops in silence the wheels turned for 3 s after the last message: when the "
                              "cable is pulled or the network fails, nothing stops it; set the time-out of the "
                              "base's driver"),
                    HasSubstr("ok  stops by itself")));
  EXPECT_TRUE(pioneer.wait_for_wheels(false, kStands_s)) << "the doctor leaves it at rest";
}

TEST_F(PioneerRun, TheDoctorTurnsNoWheelWhileTheMotorsAreOff) {
  pioneer.flags = 0x20;
  const Finished finished = run_cairn({"doctor", "live", mission("motors_off").string(), "--for", "1", "--wiggle"});
  EXPECT_EQ(finished.exit_status, 1);
  EXPECT_THAT(finished.out, AllOf(HasSubstr("the robot is stopped by its emergency button: it would not move"),
                                  HasSubstr("no wheel was turned: mend what is BAD first")));
}

}  // namespace
}  // namespace cairn::testing_program
