#include "plugins/common/ros/messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::ros {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kMinField_t = 1e-7;  // horizontally; the Earth's has 1e-5 or more

}  // namespace

std::optional<double> heading_rad(const Quaternion& q) {
  const double size = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
  if (!(size > 0.5 && size < 2.0)) return std::nullopt;
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), size - 2.0 * (q.y * q.y + q.z * q.z));
}

std::optional<Pose2> pose_of(const Point& position_m, const Quaternion& orientation) {
  const std::optional<double> heading = heading_rad(orientation);
  if (!heading || !std::isfinite(position_m.x()) || !std::isfinite(position_m.y())) return std::nullopt;
  return Pose2{position_m.x(), position_m.y(), *heading};
}

std::optional<double> compass_rad(const Imu& imu, double offset_rad) {
  if (!imu.has_orientation) return std::nullopt;
  const std::optional<double> heading = heading_rad(imu.orientation);
  return heading ? std::optional(wrap_angle(*heading + offset_rad)) : std::nullopt;
}

std::optional<double> compass_rad(const MagneticField& field, double offset_rad) {
  const double strength_t = std::hypot(field.x_t, field.y_t);
  if (!(strength_t >= kMinField_t) || !std::isfinite(strength_t)) return std::nullopt;
  return wrap_angle(offset_rad - std::atan2(field.y_t, field.x_t));
}

std::optional<double> battery_ratio(double percentage) {
  if (!(percentage >= 0.0)) return std::nullopt;
  return percentage > 1.0 ? std::min(1.0, percentage / 100.0) : percentage;  // some say per cent
}

double range_m(double said_m, double min_m, double max_m, double no_echo_from_m) {
  if (std::isnan(said_m)) return kNoNumber;
  if (said_m >= std::min(max_m, no_echo_from_m)) return kInfinity;
  return said_m < min_m ? -kInfinity : said_m;
}

RangeReading reading_of(const Range& range, const SonarModel& sonar, int number, double no_echo_from_m) {
  const double min_m = range.min_m > 0.0 ? range.min_m : sonar.min_m;
  const double max_m = range.max_m > min_m ? range.max_m : sonar.max_m;
  return {sonar.T_robot_sonar,
          sonar.half_beam_rad,
          min_m,
          max_m,
          ros::range_m(range.range_m, min_m, max_m, no_echo_from_m),
          number};
}

std::vector<RangeReading> readings_of(const Scan& scan, const LaserModel& laser, int first, double no_echo_from_m,
                                      bool is_upside_down) {
  std::vector<RangeReading> readings;
  if (!std::isfinite(scan.angle_min_rad) || !std::isfinite(scan.angle_increment_rad)) return readings;
  const double min_m = scan.min_m > 0.0 ? scan.min_m : laser.min_m;
  const double max_m = scan.max_m > min_m ? scan.max_m : laser.max_m;
  const int room = std::max(0, kMaxTransducers - first);
  const auto beams = std::min<std::size_t>(scan.ranges_m.size(), static_cast<std::size_t>(room));
  for (std::size_t i = 0; i < beams; ++i) {
    const double said_rad = scan.angle_min_rad + static_cast<double>(i) * scan.angle_increment_rad;
    const double angle_rad = is_upside_down ? -said_rad : said_rad;
    const Pose2 T_robot_beam{laser.T_robot_laser.x_m, laser.T_robot_laser.y_m,
                             wrap_angle(laser.T_robot_laser.theta_rad + angle_rad)};
    readings.push_back({T_robot_beam, 0.0, min_m, max_m, ros::range_m(scan.ranges_m[i], min_m, max_m, no_echo_from_m),
                        first + static_cast<int>(i)});
  }
  return readings;
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

}  // namespace cairn::ros
