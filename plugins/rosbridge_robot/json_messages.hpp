// ROS's messages as rosbridge writes them in JSON: of ROS 1 or 2, with null for numbers that JSON does not have.
#pragma once

#include <Eigen/Geometry>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "plugins/common/ros/messages.hpp"
#include "plugins/rosbridge_robot/config.hpp"

namespace cairn::rosbridge_robot {

// All throw std::runtime_error with the field that is missing or is something else. null is NaN, except where null_m is
// given.
[[nodiscard]] ros::Header header_in(const nlohmann::json& msg);
[[nodiscard]] ros::Odometry odometry_in(const nlohmann::json& msg);
[[nodiscard]] ros::Range range_in(const nlohmann::json& msg, double null_m);
// The ranges are put into `ranges_m`, which must outlive it.
[[nodiscard]] ros::Scan scan_in(const nlohmann::json& msg, double null_m, std::vector<float>& ranges_m);
[[nodiscard]] std::vector<Point> points_in(const nlohmann::json& msg);
[[nodiscard]] ros::Imu imu_in(const nlohmann::json& msg);
[[nodiscard]] ros::MagneticField field_in(const nlohmann::json& msg);
[[nodiscard]] double percentage_in(const nlohmann::json& msg);
[[nodiscard]] bool bool_in(const nlohmann::json& msg);

struct FrameIn {
  std::string parent;
  std::string child;
  Eigen::Vector3d position_m;
  Eigen::Quaterniond rotation;
};
[[nodiscard]] std::vector<FrameIn> frames_in(const nlohmann::json& msg);

// "sensor_msgs/Range" as that version names it: 2 is sensor_msgs/msg/Range.
[[nodiscard]] std::string type_name(const std::string& type, int ros);

// Operations as text.
[[nodiscard]] std::string advertise_text(const std::string& topic, const std::string& type);
[[nodiscard]] std::string subscribe_text(const std::string& topic, const std::string& type, int queue_length,
                                         int throttle_ms);
[[nodiscard]] std::string unsubscribe_text(const std::string& topic);
[[nodiscard]] std::string call_text(const std::string& id, const std::string& service, const std::string& topic = "");
// Without a stamp: rosbridge puts its own time there.
[[nodiscard]] std::string velocity_text(const CommandTopic& command, const Twist& twist);

}  // namespace cairn::rosbridge_robot
