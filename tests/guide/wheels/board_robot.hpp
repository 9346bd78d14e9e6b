// The sensor of docs/write-a-sensor.md: a robot behind a motor board that also reports what its wheels and sonars do.
#pragma once

#include <poll.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "framework/config/fields.hpp"
#include "wheels.hpp"

namespace wheels {

// What the board sends after each firing: where the wheels have come to, and what one sonar has heard.
struct Report {
  double stamp_s = 0.0;
  double x_m = 0.0;  // dead reckoning since the line was opened
  double y_m = 0.0;
  double theta_rad = 0.0;
  double range_m = 0.0;  // 0: no echo
  std::int32_t sonar = 0;
  std::int32_t bumped = 0;
};

struct Config {
  std::string device = "/dev/ttyUSB0";
  double silent_s = 1.0;

  static void describe(cairn::Fields<Config>& fields) {
    fields.text("device", &Config::device, "the line to the motor board");
    fields.number("silent_s", &Config::silent_s, {0.05, 60.0}, "s",
                  "a board that reports nothing for so long is faulty");
  }
};

class BoardRobot : public cairn::Sensor {
 public:
  // line: open for reading and writing, not blocking; it is closed at the end.
  BoardRobot(int line, const Config& config, const cairn::RobotModel& robot)
      : line_(line), config_(config), robot_(robot), wheels_(line, robot) {}
  BoardRobot(const BoardRobot&) = delete;
  BoardRobot& operator=(const BoardRobot&) = delete;
  ~BoardRobot() override {
    wheels_.stop();
    ::close(line_);
  }

  cairn::Drive* drive() override { return &wheels_; }

  // Waits for the board in short steps, so that a budget that is used up ends the call.
  cairn::SensorStep next(const cairn::Budget& budget) override {
    for (double waited_s = 0.0; waited_s < config_.silent_s; waited_s += kWait_s) {
      if (budget.exhausted()) return fault("asked to stop");
      if (receive()) return step_of(report_);
    }
    return fault("the motor board on " + config_.device + " is silent");
  }

 private:
  static constexpr double kWait_s = 0.01;

  // True when a report is whole. A line may deliver a part of one: the rest follows.
  [[nodiscard]] bool receive() {
    pollfd ready{line_, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(1e3 * kWait_s)) <= 0) return false;
    const ssize_t count = ::read(line_, reinterpret_cast<char*>(&report_) + filled_, sizeof report_ - filled_);
    if (count > 0) filled_ += static_cast<std::size_t>(count);
    if (filled_ < sizeof report_) return false;
    filled_ = 0;
    return true;
  }

  [[nodiscard]] cairn::SensorStep step_of(const Report& report) {
    if (report.stamp_s < last_stamp_s_) return fault("the motor board's clock went back");
    if (report.sonar < 0 || report.sonar >= std::ssize(robot_.sonars))
      return fault("the motor board reports sonar " + std::to_string(report.sonar) + ", which the robot file has not");
    last_stamp_s_ = report.stamp_s;
    cairn::SensorStep step;
    step.state = cairn::SensorState::observation;
    step.observation.stamp_s = report.stamp_s;
    step.observation.T_odom_robot = {report.x_m, report.y_m, report.theta_rad};
    step.observation.bumped = report.bumped != 0;
    step.observation.ranges.push_back(reading_of(report));
    return step;
  }

  // With the place and the beam of its transducer: nobody else reads the robot file for it.
  [[nodiscard]] cairn::RangeReading reading_of(const Report& report) const {
    const cairn::SonarModel& sonar = robot_.sonars[static_cast<std::size_t>(report.sonar)];
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    cairn::RangeReading reading{sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m,
                                sonar.max_m,         report.range_m,      report.sonar};
    if (report.range_m == 0.0 || report.range_m > sonar.max_m)
      reading.range_m = kInfinity;  // no echo
    else if (report.range_m < sonar.min_m)
      reading.range_m = -kInfinity;  // nearer than it can measure
    return reading;
  }

  [[nodiscard]] static cairn::SensorStep fault(const std::string& reason) {
    cairn::SensorStep step;
    step.state = cairn::SensorState::fault;
    step.reason = reason;
    return step;
  }

  int line_;
  Config config_;
  cairn::RobotModel robot_;
  Wheels wheels_;
  Report report_{};
  std::size_t filled_ = 0;  // bytes of report_
  double last_stamp_s_ = 0.0;
};

}  // namespace wheels
