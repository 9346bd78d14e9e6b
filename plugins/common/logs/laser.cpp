#include "plugins/common/logs/laser.hpp"

#include <array>

namespace cairn::log_common {

void LaserConfig::describe(Fields<LaserConfig>& fields) {
  fields.number("x_m", &LaserConfig::x_m, {-10, 10}, "m",
                "ahead of the robot's centre; left out: what the log says (CARMEN: PARAM robot_frontlaser_offset or "
                "robot_rearlaser_offset), or 0");
  fields.number("y_m", &LaserConfig::y_m, {-10, 10}, "m",
                "to the left of the robot's centre; left out: what the log says, or 0");
  fields.angle("angle_deg", &LaserConfig::angle_rad, {-360, 360},
               "which way it looks; left out: what the log says, or 0, or 180 for a rear laser");
  fields.angle("first_angle_deg", &LaserConfig::first_angle_rad, {-360, 360},
               "of the first beam; left out: what the log says, or that of usual lasers with as many beams");
  fields.angle("step_deg", &LaserConfig::step_rad, {-90, 90},
               "from beam to beam; left out: what the log says, or that of usual lasers with as many beams (1 for 180 "
               "and 181, 0.5 for 360 and 361, ...), otherwise so that the beams are from -90 to 90");
  fields.angle("half_beam_deg", &LaserConfig::half_beam_rad, {0, 90}, "half the width of a beam; 0: a ray");
  fields.number("min_m", &LaserConfig::min_m, {0, 100}, "m", "shortest range");
  fields.number("max_m", &LaserConfig::max_m, {0.01, 1000}, "m",
                "longest range, what is beyond is no echo; left out: what the log says (CARMEN: the ROBOTLASER line, "
                "PARAM robot_front_laser_max or robot_rear_laser_max), or 80");
}

UsualAngles usual_angles(std::size_t beams) {
  struct Laser {
    std::size_t beams;  // or one less
    double field_deg;
    double step_deg;
  };
  // SICK LMS 2xx in both its fields, LMS 1xx, Hokuyo UTM-30LX and URG-04LX.
  constexpr std::array kLasers{Laser{181, 180.0, 1.0},           Laser{361, 180.0, 0.5}, Laser{721, 180.0, 0.25},
                               Laser{101, 100.0, 1.0},           Laser{201, 100.0, 0.5}, Laser{401, 100.0, 0.25},
                               Laser{271, 270.0, 1.0},           Laser{541, 270.0, 0.5}, Laser{1081, 270.0, 0.25},
                               Laser{683, 240.0, 360.0 / 1024.0}};
  for (const Laser& laser : kLasers)
    if (beams == laser.beams || beams + 1 == laser.beams)
      return {radians(-0.5 * laser.field_deg), radians(laser.step_deg)};
  return {-0.5 * std::numbers::pi, beams > 1 ? std::numbers::pi / static_cast<double>(beams - 1) : 0.0};
}

Fan usual_fan(const LaserConfig& config, std::size_t beams) {
  Fan fan;
  fan.T_robot_laser = config.placed({});
  const UsualAngles angles = usual_angles(beams);
  fan.first_angle_rad = angles.first_rad;
  fan.step_rad = angles.step_rad;
  fan.max_m = config.max_m.value_or(kUsualLaserMax_m);
  return fan;
}

std::vector<RangeReading> readings_of(const Fan& fan, std::size_t beams, const LaserConfig& config, int first_sensor) {
  const double first_rad = config.first_angle_rad.value_or(fan.first_angle_rad);
  const double step_rad = config.step_rad.value_or(fan.step_rad);
  std::vector<RangeReading> readings(beams);
  for (std::size_t i = 0; i < beams; ++i) {
    const double angle_rad = wrap_angle(first_rad + static_cast<double>(i) * step_rad);
    readings[i] = {fan.T_robot_laser * Pose2{0.0, 0.0, angle_rad},
                   config.half_beam_rad,
                   config.min_m,
                   fan.max_m,
                   0.0,
                   first_sensor + static_cast<int>(i)};
  }
  return readings;
}

std::string key_of(const Fan& fan, std::size_t beams) {
  std::string key = std::to_string(beams);
  const Pose2& laser = fan.T_robot_laser;
  for (const double value : {laser.x_m, laser.y_m, laser.theta_rad, fan.first_angle_rad, fan.step_rad, fan.max_m})
    key += " " + config_detail::number_text(value);
  return key;
}

void check_limits(const std::filesystem::path& file, const std::string& what, double min_m, double max_m) {
  if (min_m >= max_m) throw ConfigError({file.string(), 0, 0}, what + ": min_m must be less than max_m");
}

void check_limits(const std::filesystem::path& file, const std::string& what, const LaserConfig& config) {
  check_limits(file, what, config.min_m, config.max_m.value_or(std::numeric_limits<double>::infinity()));
}

}  // namespace cairn::log_common
