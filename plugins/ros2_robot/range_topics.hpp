// The topics that ranges come by, of all kinds, as readings of the robot's transducers.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/endpoints.hpp"
#include "plugins/ros2_robot/messages.hpp"
#include "plugins/ros2_robot/pose_history.hpp"
#include "plugins/ros2_robot/sensor_places.hpp"

namespace cairn::ros2_robot {

// As the setting `stamp` has it.
[[nodiscard]] double stamp_s(const Config& config, const Header& header, double arrived_s);

class RangeTopics {
 public:
  // Both must outlive it.
  RangeTopics(const Config& config, const RobotModel& robot) : config_(config), robot_(robot) {}

  void open(const Participant& participant);
  // What has come. Throws std::runtime_error with the topic and what about it cannot be.
  void take(SensorPlaces& places);
  // The readings up to that stamp, each as seen from where the robot is then. Those that are a little ahead wait.
  [[nodiscard]] std::vector<RangeReading> seen_from(double stamp_s, const Pose2& T_odom_robot,
                                                    const PoseHistory& poses);
  void clear() { heard_.clear(); }

 private:
  struct RangeReader {
    const RangeTopic* topic = nullptr;
    Entity reader;
  };
  struct HeardRange {
    double stamp_s = 0.0;
    RangeReading reading;
  };
  void take_from(const RangeReader& from, SensorPlaces& places);
  void take_range(const RangeTopic& topic, const Range& range, double arrived_s, SensorPlaces& places);
  void take_scan(const RangeTopic& topic, const LaserScan& scan, double arrived_s, SensorPlaces& places);
  // A point a sonar, in the frame of the header.
  void take_points(const RangeTopic& topic, const Header& header, const std::vector<Point>& points_m, double arrived_s,
                   SensorPlaces& places);
  // The sonar that a message is of; throws std::runtime_error when the settings do not name it.
  [[nodiscard]] int sonar_of(const RangeTopic& topic, const std::string& frame) const;

  const Config& config_;
  const RobotModel& robot_;
  std::vector<RangeReader> readers_;
  std::vector<HeardRange> heard_;
};

}  // namespace cairn::ros2_robot
