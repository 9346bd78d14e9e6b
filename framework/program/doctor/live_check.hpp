// What a robot says of itself while nobody drives it, what it is connected to, and whether its wheels do what they are
// told.
#pragma once

#include <atomic>
#include <map>
#include <string>
#include <vector>

#include "framework/contracts/optional/connection_report.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"

namespace cairn {

struct Finding {
  bool is_good = true;
  std::string what;  // one or two words
  std::string text;  // for people, with what helps where it is not good
  std::vector<ConnectionValue> values{};
};

// A finding a part of what a sensor is connected to.
[[nodiscard]] std::vector<Finding> findings_of(const std::vector<ConnectionPart>& parts);

// What has been seen of a sensor for a while.
class LiveCheck {
 public:
  // The robot is stopped without a reading for blind_s, and without an observation for stop_after_s.
  LiveCheck(const RobotModel& robot, double blind_s, double stop_after_s)
      : robot_(robot), blind_s_(blind_s), stop_after_s_(stop_after_s) {}

  // Sees for so long by the clock, at most until `end` is set. Never commands anything.
  void watch(Sensor& sensor, double for_s, const std::atomic<bool>& end);
  // In the order in which they are to be read.
  [[nodiscard]] std::vector<Finding> findings(bool can_drive) const;

 private:
  struct Seen {
    double arrived_s = 0.0;
    Observation observation;
  };
  [[nodiscard]] Finding pace() const;
  [[nodiscard]] Finding clock() const;
  [[nodiscard]] Finding odometry() const;
  [[nodiscard]] Finding transducers() const;
  [[nodiscard]] Finding echoes() const;
  [[nodiscard]] Finding readings() const;
  [[nodiscard]] Finding compass() const;
  [[nodiscard]] Finding battery() const;
  [[nodiscard]] Finding bumper() const;

  const RobotModel& robot_;
  double blind_s_;
  double stop_after_s_;
  std::vector<Seen> seen_;
  std::string fault_;
};

// 5 cm ahead and back, 10 degrees to the left and back; then a velocity whose time passes without another.
[[nodiscard]] std::vector<Finding> wiggled(Sensor& sensor, const std::atomic<bool>& end);

}  // namespace cairn
