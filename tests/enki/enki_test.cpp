// A Pioneer in a world that is not ours, by its serial protocol and on a ROS 2 network: looked at, driven, and left
// alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tests/enki/enki_robot.hpp"
#include "tests/scenario/missions/base_process.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kStands_s = 0.5;
constexpr double kStart_m = 0.5;  // in x and y, as both missions have it

class DrivenEnkiRobot : public EnkiRobot {
 protected:
  [[nodiscard]] std::vector<std::string> of_mission(const std::string& command, const std::string& steps) const {
    write_text(folder_ / "mission.yaml",
               "mission: enki\nrobot: " + source_folder() +
                   "/config/robots/pioneer3dx_serial.yaml\nsensor: " + sensor_ +
                   "\nlocalizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\ncollision_monitor: {blind_s: 0.4}\n"
                   "steps:\n  - " +
                   steps + "\n");
    if (command == "run") return {"run", (folder_ / "mission.yaml").string(), "--out", (folder_ / "out").string()};
    return {"doctor", "live", (folder_ / "mission.yaml").string(), "--json"};
  }
  void expect_to_arrive() const;
  void expect_to_stand_when_the_mission_cannot_drive() const;
  [[nodiscard]] bool is_driving() const {
    const std::vector<EnkiTick> all = ticks();
    return !all.empty() && all.back().v_mps > 0.1;
  }

  std::string sensor_;
};

class EnkiPioneer : public DrivenEnkiRobot {
 protected:
  void SetUp() override {
    sensor_ = "{plugin: p2os_robot, device: " + line_.string() + "}";
    begin_at_the_line();
  }
};

class EnkiOnRos2 : public DrivenEnkiRobot {
 protected:
  void SetUp() override {
    std::string frames = "sonar_0";
    for (int i = 1; i < 16; ++i) frames += ", sonar_" + std::to_string(i);
    sensor_ = "{plugin: ros2_robot, domain: " + domain_ +
              ", network: localhost, odometry: /odom, mounting: file, ranges: [{topic: /sonar, frames: [" + frames +
              "]}]}";
    begin_in_the_domain();
  }
};

TEST_F(EnkiPioneer, TheDoctorSeesAndWigglesIt) {
  std::vector<std::string> arguments = of_mission("doctor", "wait: 1");
  arguments.insert(arguments.end(), {"--for", "2", "--wiggle"});
  const Finished finished = run_cairn(arguments);
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  const json said = json::parse(finished.out);
  EXPECT_TRUE(said["ok"]);
  ASSERT_EQ(said["findings"].size(), 18U);
  const json& line = said["findings"][1];
  EXPECT_EQ(line["what"], line_.string());
  EXPECT_EQ(line["values"]["subclass"], "\"p3dx-sh\"");
  EXPECT_EQ(line["values"]["wrong checksums"], "0");
  EXPECT_THAT(line["text"].get<std::string>(), HasSubstr("a second"));
  EXPECT_THAT(finished.out, HasSubstr("16 of 16 transducers were read"));
  const std::string silence = said["findings"].back()["text"];
  double stood_s = 0.0;
  ASSERT_EQ(std::sscanf(silence.c_str(), "the base itself stood %lf s", &stood_s), 1) << silence;
  EXPECT_NEAR(stood_s, 2.0, 0.4);  // its watchdog, between two packets of a tenth of a second
  const EnkiTick last = ticks().back();
  EXPECT_NEAR(last.x_m, kStart_m, 0.06);
  EXPECT_NEAR(last.y_m, kStart_m, 0.05);
}

void DrivenEnkiRobot::expect_to_arrive() const {
  const Finished finished = run_cairn(of_mission("run", "drive: {points_m: [[0, 0], [0, 1.2]], speed_mps: 0.3}"));
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  const EnkiTick last = ticks().back();
  EXPECT_NEAR(last.x_m, kStart_m, 0.1);
  EXPECT_NEAR(last.y_m, kStart_m + 1.2, 0.15);
  EXPECT_EQ(last.touches, 0.0);
}

void DrivenEnkiRobot::expect_to_stand_when_the_mission_cannot_drive() const {
  for (const int signal : {SIGSTOP, SIGKILL}) {
    const Background mission(
        of_mission("run", "drive: {points_m: [[0, 0], [0, 1.8], [0, 0], [0, 1.8]], speed_mps: 0.3}"),
        folder_ / "mission.txt");
    ASSERT_TRUE(wait_for([&] { return is_driving(); })) << mission.output();
    const double moment_s = monotonic_s();
    mission.send(signal);
    ASSERT_TRUE(wait_for([&] { return monotonic_s() > moment_s + 1.0; }));
    double stood_s = 0.0;
    for (const EnkiTick& tick : ticks())
      if (std::abs(tick.v_mps) > 0.01) stood_s = tick.monotonic_s;
    EXPECT_LT(stood_s - moment_s, kStands_s) << signal;
    mission.send(SIGKILL);
  }
}

TEST_F(EnkiPioneer, DrivesWhereItIsToAndTouchesNothing) {
  expect_to_arrive();
}

TEST_F(EnkiOnRos2, DrivesWhereItIsToAndTouchesNothing) {
  expect_to_arrive();
}

TEST_F(EnkiPioneer, StandsWhenTheMissionIsKilledOrHalted) {
  expect_to_stand_when_the_mission_cannot_drive();
}

TEST_F(EnkiOnRos2, StandsWhenTheMissionIsKilledOrHalted) {
  expect_to_stand_when_the_mission_cannot_drive();
}

}  // namespace
}  // namespace cairn::testing_program
