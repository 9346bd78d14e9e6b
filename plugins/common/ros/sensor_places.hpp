// Where a robot's sensors are: what its file says and what its static frames say, as the setting `mounting` has it.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "plugins/common/frames/static_frames.hpp"
#include "plugins/common/ros/settings.hpp"

namespace cairn::ros {

class SensorPlaces {
 public:
  explicit SensorPlaces(const RobotTopics& topics)
      : mounting_(topics.mounting), topic_(topics.static_frames), base_(topics.base_frame) {}

  // As StaticFrames::add().
  bool add(const std::string& parent, const std::string& child, const Eigen::Vector3d& position_m,
           const Eigen::Quaterniond& rotation) {
    return frames_.add(parent, child, position_m, rotation);
  }
  // The robot's frame, unless the settings name one.
  void found_base(const std::string& frame) {
    if (base_.empty()) base_ = frame;
  }
  // Of the sensor of a frame that the robot's file puts there. None: not known yet. now_s: by a clock that does not
  // step. Throws std::runtime_error when file and frames differ, or when the frame has not become known for 5 s.
  [[nodiscard]] std::optional<frames::Mounted> of_sensor(const std::string& frame, const Pose2& T_robot_sensor,
                                                         double now_s);
  // Of a frame that points are given in; the robot's own is always known. The same otherwise.
  [[nodiscard]] std::optional<frames::Mounted> of_frame(const std::string& frame, double now_s);

 private:
  void wait_for(const std::string& frame, double now_s);

  Mounting mounting_;
  std::string topic_;
  std::string base_;
  frames::StaticFrames frames_;
  std::map<std::string, double> waiting_since_s_;  // frames that are not known yet
};

}  // namespace cairn::ros
