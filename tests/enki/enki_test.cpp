// A Pioneer in a world that is not ours, by its serial protocol and on a ROS 2 network: looked at, driven, and left
// alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/scenario/missions/base_process.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

using nlohmann::json;
using testing::HasSubstr;

constexpr double kStands_s = 0.5;

struct Tick {
  double monotonic_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_deg = 0.0;
  double v_mps = 0.0;
  double touches = 0.0;
};

class EnkiRobot : public testing::Test {
 protected:
  // The program is there once its robot is.
  void begin(const std::string& name, const std::vector<std::string>& words, const std::filesystem::path& appears) {
    const std::string program = std::string(CAIRN_BINARY_DIR) + "/bin/" + name;
    if (!std::filesystem::exists(program))
      GTEST_SKIP() << name << " is not built: libenki-dev, or libfastrtps-dev and libfastcdr-dev, is not installed";
    std::vector<const char*> arguments{program.c_str()};
    for (const std::string& word : words) arguments.push_back(word.c_str());
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      ::execv(program.c_str(), const_cast<char* const*>(arguments.data()));
      ::_exit(127);
    }
    ASSERT_TRUE(wait_for([&] { return std::filesystem::exists(appears); }));
  }
  void TearDown() override {
    if (process_ > 0) ::kill(process_, SIGKILL);
    if (process_ > 0) ::waitpid(process_, nullptr, 0);
    std::filesystem::remove_all(folder_);
  }
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
  [[nodiscard]] std::vector<Tick> ticks() const {
    std::vector<Tick> all;
    std::ifstream file(log_);
    std::string text;
    std::getline(file, text);
    while (std::getline(file, text)) {
      std::istringstream line(text);
      Tick tick;
      char comma = 0;
      if (line >> tick.monotonic_s >> comma >> tick.x_m >> comma >> tick.y_m >> comma >> tick.angle_deg >> comma >>
          tick.v_mps >> comma >> tick.touches)
        all.push_back(tick);
    }
    return all;
  }
  void expect_to_arrive() const;
  void expect_to_stand_when_the_mission_cannot_drive() const;
  [[nodiscard]] bool is_driving() const {
    const std::vector<Tick> all = ticks();
    return !all.empty() && all.back().v_mps > 0.1;
  }

  const std::filesystem::path folder_ = fresh_folder("enki");
  const std::filesystem::path log_ = folder_ / "wheels.csv";
  std::string sensor_;
  pid_t process_ = -1;
};

class EnkiPioneer : public EnkiRobot {
 protected:
  void SetUp() override {
    sensor_ = "{plugin: p2os_robot, device: " + line_.string() + "}";
    begin("enki_pioneer", {line_.string(), log_.string()}, line_);
  }
  const std::filesystem::path line_ = folder_ / "pioneer";
};

class EnkiOnRos2 : public EnkiRobot {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(std::string(CAIRN_BINARY_DIR) + "/lib/cairn/ros2_robot.so"))
      GTEST_SKIP() << "cyclonedds-dev is not installed";
    const std::string domain = std::to_string(200 + ::getpid() % 30);
    std::string frames = "sonar_0";
    for (int i = 1; i < 16; ++i) frames += ", sonar_" + std::to_string(i);
    sensor_ = "{plugin: ros2_robot, domain: " + domain +
              ", network: localhost, odometry: /odom, mounting: file, ranges: [{topic: /sonar, frames: [" + frames +
              "]}]}";
    begin("enki_ros2", {domain, log_.string(), (folder_ / "latencies.txt").string()}, log_);
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
  const Tick last = ticks().back();
  EXPECT_NEAR(last.x_m, 0.7, 0.06);
  EXPECT_NEAR(last.y_m, 0.7, 0.05);
}

void EnkiRobot::expect_to_arrive() const {
  const Finished finished = run_cairn(of_mission("run", "drive: {points_m: [[0, 0], [0, 1.2]], speed_mps: 0.3}"));
  EXPECT_EQ(finished.exit_status, 0) << finished.out << finished.err;
  const Tick last = ticks().back();
  EXPECT_NEAR(last.x_m, 0.7, 0.1);
  EXPECT_NEAR(last.y_m, 1.9, 0.15);
  EXPECT_EQ(last.touches, 0.0);
}

void EnkiRobot::expect_to_stand_when_the_mission_cannot_drive() const {
  for (const int signal : {SIGSTOP, SIGKILL}) {
    const Background mission(of_mission("run", "drive: {points_m: [[0, 0], [0, 2], [0, 0], [0, 2]], speed_mps: 0.3}"),
                             folder_ / "mission.txt");
    ASSERT_TRUE(wait_for([&] { return is_driving(); })) << mission.output();
    const double moment_s = monotonic_s();
    mission.send(signal);
    ASSERT_TRUE(wait_for([&] { return monotonic_s() > moment_s + 1.0; }));
    double stood_s = 0.0;
    for (const Tick& tick : ticks())
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
