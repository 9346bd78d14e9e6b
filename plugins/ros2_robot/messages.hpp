// What messages mean. All as ROS defines it: metres, radians, seconds, anticlockwise.
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
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
// Heading of an orientation; none when it is none, as all zero or not finite.
[[nodiscard]] std::optional<double> heading_rad(const geometry_msgs_msg_dds__Quaternion_& orientation);
// None when it is not finite.
[[nodiscard]] std::optional<Pose2> pose_of(const Odometry& odometry);
[[nodiscard]] std::optional<Pose2> pose_of(const geometry_msgs_msg_dds__Pose_& pose);
// A compass's heading; none when the message says that it has no orientation.
[[nodiscard]] std::optional<double> compass_rad(const Imu& imu, double offset_rad);
// The same of the field that a level robot measures; none when it has no direction.
[[nodiscard]] std::optional<double> compass_rad(const MagneticField& field, double offset_rad);
// 0 to 1; none when it does not say.
[[nodiscard]] std::optional<double> battery_ratio(const BatteryState& battery);

// REP-117: +inf no echo, -inf too near, NaN bad. Ranges from no_echo_from_m on, or beyond the largest one, are no echo.
[[nodiscard]] double range_m(double said_m, double min_m, double max_m, double no_echo_from_m);
// Place and beam are the robot file's, the limits the message's where it has any.
[[nodiscard]] RangeReading reading_of(const Range& range, const SonarModel& sonar, int number, double no_echo_from_m);
// The angles are the message's, the place is the robot file's. first: number of its first beam. is_upside_down: the
// scanner, so that its angles grow clockwise.
[[nodiscard]] std::vector<RangeReading> readings_of(const LaserScan& scan, const LaserModel& laser, int first,
                                                    double no_echo_from_m, bool is_upside_down = false);

// At most that many points of a cloud are read.
inline constexpr std::size_t kMaxCloudPoints = 4096;
// x and y of each point in the frame of the cloud, NaN where it says so.
[[nodiscard]] std::vector<Point> points_of(const PointCloud& cloud);
// Of float or double fields x and y. Throws std::runtime_error when the layout cannot be.
[[nodiscard]] std::vector<Point> points_of(const PointCloud2& cloud);
// The range is the distance of a sonar from its point of the cloud, which is seen from the robot.
[[nodiscard]] RangeReading reading_of(const Point& at_m, const SonarModel& sonar, int number, double no_echo_from_m);

}  // namespace cairn::ros2_robot
