// A base in a process of its own: whatever becomes of the program that drives it, its wheels stand when the time of the
// last command has passed; and the robot goes on by itself when the fault is over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "maps/store/map_store.hpp"
#include "tests/scenario/missions/base_process.hpp"
#include "tests/scenario/program.hpp"

namespace cairn::testing_program {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kCommandValid_s = 0.25;  // the default
constexpr double kTick_s = 0.04;
constexpr double kBraking_s = 0.15;  // from 0.3 m/s with 4 x 0.5 m/s2

class RemoteBase : public testing::Test {
 protected:
  RemoteBase() {
    const std::string robot = source_folder() + "/config/robots/pioneer1.yaml";
    write_text(folder_ / "world.yaml", "bounds_m: [[0, 0], [100, 4]]\n");
    const std::string both = "robot: " + robot + "\nstart: {at_m: [1, 2], angle_deg: 0}\n";
    write_text(folder_ / "base.yaml", "mission: base\nworld: world.yaml\n" + both +
                                          "sensor: {plugin: simulated_robot}\nlocalizer: {plugin: odometry_compass}\n"
                                          "map: {plugin: muriel}\nsteps: [wait: 1]\n");
    write_text(folder_ / "mission.yaml",
               "mission: remote\n" + both +
                   "sensor: {plugin: remote_base, socket: base.sock, reconnect_s: 20}\n"
                   "localizer: {plugin: odometry_compass}\nmap: {plugin: muriel}\nsteps: [straight]\n");
  }
  ~RemoteBase() override { fs::remove_all(folder_); }

  void start_base() {
    base_.reset();
    base_.emplace(std::vector<std::string>{"base", (folder_ / "base.yaml").string(), "--listen",
                                           (folder_ / "base.sock").string(), "--log", log_.string()},
                  folder_ / "base.txt");
  }
  void start_mission(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run",       (folder_ / "mission.yaml").string(),
                                       "--out",     (folder_ / "out").string(),
                                       "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/failing"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    mission_.emplace(arguments, folder_ / "mission.txt");
  }
  void start_both() {
    start_base();
    start_mission();
    ASSERT_TRUE(wait_until_driving(log_)) << base_->output() << mission_->output();
  }
  // By the base's clock: how long after that moment the wheels were ordered to turn, and turned.
  struct Stopped {
    double ordered_s = 0.0;
    double turned_s = 0.0;
  };
  [[nodiscard]] Stopped stopped_after(double moment_s) const {
    Stopped stopped;
    double begin_s = std::nan("");
    for (const WheelTick& tick : wheel_ticks(log_)) {
      if (tick.monotonic_s < moment_s) begin_s = tick.stamp_s;
      if (tick.monotonic_s < moment_s) continue;
      if (std::abs(tick.ordered_v_mps) > 0.0) stopped.ordered_s = tick.stamp_s - begin_s;
      if (std::abs(tick.driven_v_mps) > 0.005) stopped.turned_s = tick.stamp_s - begin_s;
    }
    return stopped;
  }

  const fs::path folder_ = fresh_folder("remote_base");
  const fs::path log_ = folder_ / "base.csv";
  std::optional<Background> base_;
  std::optional<Background> mission_;
};

TEST_F(RemoteBase, TheWheelsStandWhenTheProgramIsKilled) {
  start_both();
  const double killed_s = monotonic_s();
  mission_->send(SIGKILL);
  EXPECT_EQ(mission_->exit_status(), -SIGKILL);
  ASSERT_TRUE(wait_until_standing(log_, killed_s));
  const Stopped stopped = stopped_after(killed_s);
  EXPECT_LE(stopped.ordered_s, 4 * kTick_s + 1e-6) << "a client that is gone orders nothing more";
  EXPECT_LE(stopped.turned_s, kBraking_s + 5 * kTick_s + 1e-6);

  start_mission();
  EXPECT_TRUE(wait_until_driving(log_, monotonic_s())) << "the base waits for the next: " << mission_->output();
}

TEST_F(RemoteBase, ALinkInPlaceOfTheLogIsReplacedAndNotFollowed) {
  write_text(folder_ / "victim.txt", "mine");
  fs::create_symlink(folder_ / "victim.txt", log_);
  start_base();
  start_mission();
  ASSERT_TRUE(wait_until_driving(log_));
  EXPECT_FALSE(fs::is_symlink(log_));
  EXPECT_EQ(text_of_file(folder_ / "victim.txt"), "mine");
}

TEST_F(RemoteBase, AStoppedProgramGoesOnByItselfAndSaysWhatHappened) {
  start_both();
  const double stopped_s = monotonic_s();
  mission_->send(SIGSTOP);
  ASSERT_TRUE(wait_until_standing(log_, stopped_s));
  const Stopped stopped = stopped_after(stopped_s);
  EXPECT_LE(stopped.ordered_s, kCommandValid_s + 2 * kTick_s + 1e-6);
  EXPECT_LE(stopped.turned_s, kCommandValid_s + kBraking_s + 3 * kTick_s + 1e-6);
  const double continued_s = monotonic_s();
  mission_->send(SIGCONT);
  EXPECT_TRUE(wait_until_driving(log_, continued_s)) << mission_->output();
  mission_->send(SIGINT);
  EXPECT_EQ(mission_->exit_status(), 1) << "cancelled";
  EXPECT_THAT(mission_->output(), HasSubstr("the robot was stopped: this whole process had stood still for "));
  EXPECT_NO_THROW((void)load_map(folder_ / "out" / "remote.cairn"));
}

TEST_F(RemoteBase, ATerminalThatIsClosedEndsTheMissionInOrder) {
  start_both();
  mission_->send(SIGHUP);
  mission_->send(SIGHUP);
  EXPECT_EQ(mission_->exit_status(), 1);
  EXPECT_THAT(mission_->output(), HasSubstr("cancelled by the user"));
  EXPECT_NO_THROW((void)load_map(folder_ / "out" / "remote.cairn"));
}

TEST_F(RemoteBase, WhatEndsTheProcessAtOnceStopsTheWheelsFirst) {
  start_both();
  const double ended_s = monotonic_s();
  mission_->send(SIGQUIT);
  EXPECT_EQ(mission_->exit_status(), -SIGQUIT);
  ASSERT_TRUE(wait_until_standing(log_, ended_s));
  EXPECT_LE(stopped_after(ended_s).ordered_s, 4 * kTick_s + 1e-6) << "sooner than by the drive's own time";
  EXPECT_THAT(mission_->output(), HasSubstr("cairn: SIGQUIT while the mission was in stage "));
}

TEST_F(RemoteBase, AnOdometryThatLeapsIsAFaultOfTheSensorModule) {
  start_base();
  start_mission(
      {"--set", "sensor={plugin: failing_sensor, fault: leap, after_s: 1, of: {plugin: remote_base, socket: " +
                    (folder_ / "base.sock").string() + "}}"});
  EXPECT_EQ(mission_->exit_status(), 1);
  EXPECT_THAT(
      mission_->output(),
      HasSubstr("module_fault: module failing_sensor failed in stage sensor: returned an odometry that leaps "));
  EXPECT_NO_THROW((void)load_map(folder_ / "out" / "remote.cairn"));
}

TEST_F(RemoteBase, WhenTheBaseIsGoneTheMissionEndsWithItsMap) {
  start_base();
  start_mission({"--set", "sensor.reconnect_s=1"});
  ASSERT_TRUE(wait_until_driving(log_)) << base_->output() << mission_->output();
  base_->send(SIGKILL);
  EXPECT_EQ(mission_->exit_status(), 1);
  EXPECT_THAT(mission_->output(), HasSubstr("sensor_fault: no observation from the base at "));
  EXPECT_NO_THROW((void)load_map(folder_ / "out" / "remote.cairn"));
}

TEST_F(RemoteBase, ABaseThatComesBackIsDrivenOn) {
  start_both();
  base_->send(SIGKILL);
  (void)base_->exit_status();
  fs::remove(log_);
  const double gone_s = monotonic_s();
  ASSERT_TRUE(wait_for([&] { return monotonic_s() > gone_s + 1.0; })) << "long enough to be reported";
  start_base();
  EXPECT_TRUE(wait_until_driving(log_)) << base_->output() << mission_->output();
  mission_->send(SIGINT);
  EXPECT_EQ(mission_->exit_status(), 1);
  EXPECT_THAT(mission_->output(), HasSubstr("in stage sensor of module remote_base"));
}

TEST_F(RemoteBase, ABaseThatWasHeldUpIsDrivenOn) {
  start_both();
  base_->send(SIGSTOP);
  const double held_s = monotonic_s();
  ASSERT_TRUE(wait_for([&] { return monotonic_s() > held_s + 1.5; })) << "longer than it may be silent";
  const double continued_s = monotonic_s();
  base_->send(SIGCONT);
  EXPECT_TRUE(wait_until_driving(log_, continued_s + 0.5)) << base_->output() << mission_->output();
  mission_->send(SIGINT);
  EXPECT_EQ(mission_->exit_status(), 1);
}

TEST_F(RemoteBase, OneClientDrivesAtATime) {
  start_both();
  Background other({"run", (folder_ / "mission.yaml").string(), "--out", (folder_ / "other").string(), "--set",
                    "sensor.reconnect_s=0.5", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/failing"},
                   folder_ / "other.txt");
  EXPECT_EQ(other.exit_status(), 1);
  EXPECT_THAT(other.output(), HasSubstr("another client drives this base"));
}

TEST_F(RemoteBase, ABaseOfThirtyLinesOfPythonIsDriven) {
  const std::string page = text_of_file(source_folder() + "/docs/live.md");
  const std::string begin = "```python\n";
  const std::size_t at = page.find(begin);
  ASSERT_NE(at, std::string::npos);
  write_text(folder_ / "base.py",
             page.substr(at + begin.size(), page.find("```", at + begin.size()) - at - begin.size()));
  const pid_t python = fork();
  if (python == 0) {
    execlp("python3", "python3", (folder_ / "base.py").c_str(), (folder_ / "base.sock").c_str(), nullptr);
    _exit(127);
  }
  const Finished finished =
      run_cairn({"run", (folder_ / "mission.yaml").string(), "--out", (folder_ / "out").string(), "--set",
                 "at_most_s=3", "--json", "--plugins", std::string(CAIRN_BINARY_DIR) + "/tests/plugin/failing"});
  kill(python, SIGKILL);
  waitpid(python, nullptr, 0);
  const auto summary = nlohmann::json::parse(finished.out);
  EXPECT_EQ(summary.at("outcome"), "out_of_time") << finished.err;
  EXPECT_GT(summary.at("distance_m").get<double>(), 0.3) << finished.out;
}

TEST_F(RemoteBase, WhatCannotBeABaseIsRefused) {
  const std::string mission = (folder_ / "base.yaml").string();
  EXPECT_THAT(run_cairn({"base", mission, "--listen", "localhost:none"}).err, HasSubstr("a port is a number"));
  EXPECT_THAT(run_cairn({"base", mission}).err, HasSubstr("--listen is required"));
  EXPECT_THAT(run_cairn({"base", mission, "--listen", (folder_ / "no" / "base.sock").string()}).err,
              HasSubstr("No such file or directory"));
  write_text(folder_ / "log.txt", "");
  const Finished log = run_cairn(
      {"base", source_folder() + "/config/missions/freiburg_079.yaml", "--listen", (folder_ / "base.sock").string()});
  EXPECT_EQ(log.exit_status, 2);
}

}  // namespace
}  // namespace cairn::testing_program
