// ROS's messages as far as they are read, whatever the way they come by, and what they mean. All as ROS defines it:
// metres, radians, seconds, anticlockwise.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::ros {

struct Header {
  double stamp_s = 0.0;
  std::string frame;
};

struct Quaternion {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double w = 0.0;
};

struct Odometry {
  Header header;
  std::string child_frame;
  Point position_m = Point::Zero();
  Quaternion orientation;
};

struct Range {
  Header header;
  double min_m = 0.0;
  double max_m = 0.0;
  double range_m = 0.0;
};

// The ranges must outlive it.
struct Scan {
  Header header;
  double angle_min_rad = 0.0;
  double angle_increment_rad = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
  std::span<const float> ranges_m;
};

struct Imu {
  Quaternion orientation;
  bool has_orientation = true;  // as its covariance says
};

struct MagneticField {
  double x_t = 0.0;
  double y_t = 0.0;
};

// Heading of an orientation; none when it is none, as all zero or not finite.
[[nodiscard]] std::optional<double> heading_rad(const Quaternion& orientation);
// None when it is not finite.
[[nodiscard]] std::optional<Pose2> pose_of(const Point& position_m, const Quaternion& orientation);
// A compass's heading; none when the message says that it has no orientation.
[[nodiscard]] std::optional<double> compass_rad(const Imu& imu, double offset_rad);
// The same of the field that a level robot measures; none when it has no direction.
[[nodiscard]] std::optional<double> compass_rad(const MagneticField& field, double offset_rad);
// 0 to 1 of a BatteryState's percentage; none when it does not say.
[[nodiscard]] std::optional<double> battery_ratio(double percentage);

// REP-117: +inf no echo, -inf too near, NaN bad. Ranges from no_echo_from_m on, or beyond the largest one, are no echo.
[[nodiscard]] double range_m(double said_m, double min_m, double max_m, double no_echo_from_m);
// Place and beam are the robot file's, the limits the message's where it has any.
[[nodiscard]] RangeReading reading_of(const Range& range, const SonarModel& sonar, int number, double no_echo_from_m);
// The angles are the message's, the place is the robot file's. first: number of its first beam. is_upside_down: the
// scanner, so that its angles grow clockwise.
[[nodiscard]] std::vector<RangeReading> readings_of(const Scan& scan, const LaserModel& laser, int first,
                                                    double no_echo_from_m, bool is_upside_down = false);
// The range is the distance of a sonar from its point of a cloud, which is seen from the robot.
[[nodiscard]] RangeReading reading_of(const Point& at_m, const SonarModel& sonar, int number, double no_echo_from_m);

}  // namespace cairn::ros
