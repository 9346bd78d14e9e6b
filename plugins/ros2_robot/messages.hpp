// Messages as they are on the wire, and as they are read by all robots that speak ROS.
#pragma once

#include <optional>
#include <vector>

#include "plugins/common/ros/messages.hpp"
#include "ros2.h"

namespace cairn::ros2_robot {

using Time = builtin_interfaces_msg_dds__Time_;
using Header = std_msgs_msg_dds__Header_;
using Bool = std_msgs_msg_dds__Bool_;
using Odometry = nav_msgs_msg_dds__Odometry_;
using Range = sensor_msgs_msg_dds__Range_;
using LaserScan = sensor_msgs_msg_dds__LaserScan_;
using PointCloud = sensor_msgs_msg_dds__PointCloud_;
using PointCloud2 = sensor_msgs_msg_dds__PointCloud2_;
using MagneticField = sensor_msgs_msg_dds__MagneticField_;
using TFMessage = tf2_msgs_msg_dds__TFMessage_;
using Imu = sensor_msgs_msg_dds__Imu_;
using BatteryState = sensor_msgs_msg_dds__BatteryState_;
using Image = sensor_msgs_msg_dds__Image_;
using CompressedImage = sensor_msgs_msg_dds__CompressedImage_;
using TwistMessage = geometry_msgs_msg_dds__Twist_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using PoseWithCovarianceStamped = geometry_msgs_msg_dds__PoseWithCovarianceStamped_;
using OccupancyGridMessage = nav_msgs_msg_dds__OccupancyGrid_;
using Path = nav_msgs_msg_dds__Path_;
using Marker = visualization_msgs_msg_dds__Marker_;
using MarkerArray = visualization_msgs_msg_dds__MarkerArray_;
using DiagnosticArray = diagnostic_msgs_msg_dds__DiagnosticArray_;
using TwistStamped = geometry_msgs_msg_dds__TwistStamped_;

[[nodiscard]] double seconds_of(const Time& time);
[[nodiscard]] Time time_of(double seconds);
[[nodiscard]] ros::Header header_of(const Header& header);
[[nodiscard]] ros::Odometry message_of(const Odometry& odometry);
[[nodiscard]] ros::Range message_of(const Range& range);
// The scan must outlive it.
[[nodiscard]] ros::Scan message_of(const LaserScan& scan);
[[nodiscard]] ros::Imu message_of(const Imu& imu);
[[nodiscard]] ros::MagneticField message_of(const MagneticField& field);
// None when it is not finite.
[[nodiscard]] std::optional<Pose2> pose_of(const geometry_msgs_msg_dds__Pose_& pose);

// At most that many points of a cloud are read.
inline constexpr std::size_t kMaxCloudPoints = 4096;
// x and y of each point in the frame of the cloud, NaN where it says so.
[[nodiscard]] std::vector<Point> points_of(const PointCloud& cloud);
// Of float or double fields x and y. Throws std::runtime_error when the layout cannot be.
[[nodiscard]] std::vector<Point> points_of(const PointCloud2& cloud);

// Made grey; stamp and camera are left to the caller. Throw std::runtime_error with what is wrong with the picture.
[[nodiscard]] CameraImage picture_of(const Image& image);
[[nodiscard]] CameraImage picture_of(const CompressedImage& image);

}  // namespace cairn::ros2_robot
