// Ranges as they come, of all kinds, kept as readings of the robot's transducers until the odometry of their time.
#pragma once

#include <string>
#include <vector>

#include "plugins/common/ros/messages.hpp"
#include "plugins/common/ros/pose_history.hpp"
#include "plugins/common/ros/sensor_places.hpp"
#include "plugins/common/ros/settings.hpp"

namespace cairn::ros {

// As the setting `stamp` has it.
[[nodiscard]] double stamp_s(const RobotTopics& topics, const Header& header, double arrived_s);

class RangeBuffer {
 public:
  // Both must outlive it.
  RangeBuffer(const RobotTopics& topics, const RobotModel& robot) : topics_(topics), robot_(robot) {}

  // All throw std::runtime_error with the topic and what about the message cannot be.
  void add(const RangeTopic& topic, const Range& range, double arrived_s, SensorPlaces& places);
  void add(const RangeTopic& topic, const Scan& scan, double arrived_s, SensorPlaces& places);
  // A point a sonar, in the frame of the header.
  void add(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m, double arrived_s,
           SensorPlaces& places);
  // The readings up to that stamp, each as seen from where the robot is then. Those that are a little ahead wait.
  [[nodiscard]] std::vector<RangeReading> seen_from(double stamp_s, const Pose2& T_odom_robot,
                                                    const PoseHistory& poses);
  void clear() { heard_.clear(); }

 private:
  struct HeardRange {
    double stamp_s = 0.0;
    RangeReading reading;
  };
  // The sonar that a message is of; throws std::runtime_error when the settings do not name it.
  [[nodiscard]] int sonar_of(const RangeTopic& topic, const std::string& frame) const;
  void keep_room();

  const RobotTopics& topics_;
  const RobotModel& robot_;
  std::vector<HeardRange> heard_;
};

}  // namespace cairn::ros
