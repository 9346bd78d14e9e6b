// What a robot says by ROS's messages, as observations: one at each odometry, with the readings since the last.
#pragma once

#include <atomic>
#include <optional>
#include <vector>

#include "framework/live/continuity.hpp"
#include "plugins/common/ros/heard_topics.hpp"
#include "plugins/common/ros/range_buffer.hpp"

namespace cairn::ros {

class RobotObserver {
 public:
  // Both must outlive it.
  RobotObserver(const RobotTopics& topics, const RobotModel& robot);

  // What comes next may be of a robot that has started again.
  void interrupt() { continuity_.interrupt(); }
  // Readings that still wait are of before a gap.
  void forget_readings() { ranges_.clear(); }

  // Messages, at arrived_s by a clock that does not step. All throw std::runtime_error with the topic and what cannot
  // be.
  void take(const RangeTopic& topic, const Range& range, double arrived_s);
  void take(const RangeTopic& topic, const Scan& scan, double arrived_s);
  void take(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m, double arrived_s);
  void take_compass(const Header& header, const std::optional<double>& heading_rad, double arrived_s);
  void take_battery(const Header& header, double percentage, double arrived_s);
  void take_bumper(std::size_t number, bool is_touched, double arrived_s);
  void take_emergency(bool is_on, double arrived_s);
  void take_frame(const std::string& parent, const std::string& child, const Eigen::Vector3d& position_m,
                  const Eigen::Quaterniond& rotation) {
    (void)places_.add(parent, child, position_m, rotation);
  }
  // None: it is no pose, or it is older than one that has come already.
  [[nodiscard]] std::optional<Observation> take(const Odometry& odometry, double arrived_s);

  // From any thread: the wheels must stand.
  [[nodiscard]] bool is_emergency() const { return is_emergency_; }
  // From any thread: of the base's clock to now_s(); 0: not known.
  [[nodiscard]] double base_ahead_s() const { return base_ahead_s_; }
  [[nodiscard]] HeardTopics& heard() { return heard_; }
  [[nodiscard]] const HeardTopics& heard() const { return heard_; }

 private:
  void mark(const std::string& topic, const Header& header, double arrived_s);
  [[nodiscard]] bool is_overtaken(double stamp_s) const;

  const RobotTopics& topics_;
  RangeBuffer ranges_;
  SensorPlaces places_;
  PoseHistory poses_;
  live::Continuity continuity_;
  HeardTopics heard_;
  std::optional<double> last_stamp_s_;  // of the odometry
  std::optional<double> compass_rad_;
  std::optional<double> battery_ratio_;
  std::vector<char> bumped_;  // each bumper's last word
  std::atomic<bool> is_emergency_{false};
  std::atomic<double> base_ahead_s_{0.0};
};

}  // namespace cairn::ros
