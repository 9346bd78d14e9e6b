#include "plugins/ros2_robot/messages.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace cairn::ros2_robot {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinField_t = 1e-7;  // horizontally; the Earth's has 1e-5 or more
constexpr std::uint8_t kFloat32 = 7;
constexpr std::uint8_t kFloat64 = 8;

template <class Number>
double number_at(const std::uint8_t* at, bool is_bigendian) {
  std::uint8_t bytes[sizeof(Number)];
  std::memcpy(bytes, at, sizeof bytes);
  if (is_bigendian != (std::endian::native == std::endian::big)) std::reverse(std::begin(bytes), std::end(bytes));
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return static_cast<double>(number);
}

// A field of a cloud that is a number.
struct CloudField {
  std::size_t offset = 0;
  bool is_double = false;
  [[nodiscard]] double of(const std::uint8_t* point, bool is_bigendian) const {
    return is_double ? number_at<double>(point + offset, is_bigendian) : number_at<float>(point + offset, is_bigendian);
  }
};

CloudField field_of(const PointCloud2& cloud, const std::string& name) {
  for (std::uint32_t i = 0; i < cloud.fields._length; ++i) {
    const auto& field = cloud.fields._buffer[i];
    if (field.name != name) continue;
    const bool is_double = field.datatype == kFloat64;
    if (!is_double && field.datatype != kFloat32)
      throw std::runtime_error("its field " + name + " is neither float nor double");
    if (std::size_t{field.offset} + (is_double ? 8 : 4) > cloud.point_step)
      throw std::runtime_error("its field " + name + " reaches beyond a point");
    return {field.offset, is_double};
  }
  throw std::runtime_error("it has no field " + name);
}

}  // namespace

double seconds_of(const Time& time) {
  return static_cast<double>(time.sec) + 1e-9 * time.nanosec;
}

Time time_of(double seconds) {
  const double whole = std::floor(seconds);
  return {static_cast<std::int32_t>(whole), static_cast<std::uint32_t>(1e9 * (seconds - whole))};
}

std::optional<double> heading_rad(const geometry_msgs_msg_dds__Quaternion_& q) {
  const double size = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(size > 0.5 && size < 2.0)) return std::nullopt;
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), size - 2.0 * (q.y * q.y + q.z * q.z));
}

std::optional<Pose2> pose_of(const Odometry& odometry) {
  return pose_of(odometry.pose.pose);
}

std::optional<Pose2> pose_of(const geometry_msgs_msg_dds__Pose_& pose) {
  const auto& [position, orientation] = pose;
  const std::optional<double> heading = heading_rad(orientation);
  if (!heading || !std::isfinite(position.x) || !std::isfinite(position.y)) return std::nullopt;
  return Pose2{position.x, position.y, *heading};
}

std::optional<double> compass_rad(const Imu& imu, double offset_rad) {
  if (imu.orientation_covariance[0] < 0.0) return std::nullopt;  // as the message's definition says
  const std::optional<double> heading = heading_rad(imu.orientation);
  return heading ? std::optional(wrap_angle(*heading + offset_rad)) : std::nullopt;
}

std::optional<double> compass_rad(const MagneticField& field, double offset_rad) {
  const auto& north = field.magnetic_field;
  const double strength_t = std::hypot(north.x, north.y);
  if (!(strength_t >= kMinField_t) || !std::isfinite(strength_t)) return std::nullopt;
  return wrap_angle(offset_rad - std::atan2(north.y, north.x));
}

std::optional<double> battery_ratio(const BatteryState& battery) {
  const double ratio = battery.percentage;
  if (!(ratio >= 0.0)) return std::nullopt;
  return ratio > 1.0 ? std::min(1.0, ratio / 100.0) : ratio;  // some say per cent
}

double range_m(double said_m, double min_m, double max_m, double no_echo_from_m) {
  if (std::isnan(said_m)) return kNoNumber;
  if (said_m >= std::min(max_m, no_echo_from_m)) return kInfinity;
  return said_m < min_m ? -kInfinity : said_m;
}

RangeReading reading_of(const Range& range, const SonarModel& sonar, int number, double no_echo_from_m) {
  const double min_m = range.min_range > 0.0F ? range.min_range : sonar.min_m;
  const double max_m = range.max_range > min_m ? range.max_range : sonar.max_m;
  return {sonar.T_robot_sonar,
          sonar.half_beam_rad,
          min_m,
          max_m,
          ros2_robot::range_m(range.range, min_m, max_m, no_echo_from_m),
          number};
}

std::vector<RangeReading> readings_of(const LaserScan& scan, const LaserModel& laser, int first, double no_echo_from_m,
                                      bool is_upside_down) {
  std::vector<RangeReading> readings;
  const double min_m = scan.range_min > 0.0F ? scan.range_min : laser.min_m;
  const double max_m = scan.range_max > min_m ? scan.range_max : laser.max_m;
  const int room = std::max(0, kMaxTransducers - first);
  const auto beams = std::min<std::size_t>(scan.ranges._length, static_cast<std::size_t>(room));
  for (std::size_t i = 0; i < beams; ++i) {
    const double said_rad = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    const double angle_rad = is_upside_down ? -said_rad : said_rad;
    const Pose2 T_robot_beam{laser.T_robot_laser.x_m, laser.T_robot_laser.y_m,
                             wrap_angle(laser.T_robot_laser.theta_rad + angle_rad)};
    readings.push_back({T_robot_beam, 0.0, min_m, max_m,
                        ros2_robot::range_m(scan.ranges._buffer[i], min_m, max_m, no_echo_from_m),
                        first + static_cast<int>(i)});
  }
  return readings;
}

std::vector<Point> points_of(const PointCloud& cloud) {
  std::vector<Point> points_m;
  for (std::size_t i = 0; i < std::min<std::size_t>(cloud.points._length, kMaxCloudPoints); ++i)
    points_m.emplace_back(cloud.points._buffer[i].x, cloud.points._buffer[i].y);
  return points_m;
}

std::vector<Point> points_of(const PointCloud2& cloud) {
  std::vector<Point> points_m;
  if (cloud.width == 0 || cloud.height == 0) return points_m;
  const CloudField x = field_of(cloud, "x");
  const CloudField y = field_of(cloud, "y");
  const std::size_t row_step = cloud.height == 1 ? cloud.data._length : cloud.row_step;
  for (std::size_t row = 0; row < cloud.height; ++row)
    for (std::size_t column = 0; column < cloud.width; ++column) {
      if (points_m.size() == kMaxCloudPoints) return points_m;
      const std::size_t at = row * row_step + column * cloud.point_step;
      if (at + cloud.point_step > cloud.data._length) throw std::runtime_error("its data end before its points do");
      const std::uint8_t* const point = cloud.data._buffer + at;
      points_m.emplace_back(x.of(point, cloud.is_bigendian), y.of(point, cloud.is_bigendian));
    }
  return points_m;
}

RangeReading reading_of(const Point& at_m, const SonarModel& sonar, int number, double no_echo_from_m) {
  const double away_m = (at_m - sonar.T_robot_sonar.position()).norm();
  return {sonar.T_robot_sonar,
          sonar.half_beam_rad,
          sonar.min_m,
          sonar.max_m,
          range_m(away_m, sonar.min_m, sonar.max_m, no_echo_from_m),
          number};
}

}  // namespace cairn::ros2_robot
