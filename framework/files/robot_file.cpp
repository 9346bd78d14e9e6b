#include "framework/files/robot_file.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/config/fields.hpp"
#include "framework/files/robot_cameras.hpp"
#include "maps/geometry/contour.hpp"

namespace cairn {
namespace {

struct LimitsConfig {
  double max_v_mps = 0.4;
  double max_w_radps = radians(100.0);
  double max_acceleration_mps2 = 0.5;
  double max_turn_acceleration_radps2 = radians(200.0);
  double min_turning_radius_m = 0.0;
  static void describe(Fields<LimitsConfig>& fields) {
    fields.number("max_v_mps", &LimitsConfig::max_v_mps, {0.01, 10.0}, "m/s", "highest speed");
    fields.angle("max_w_degps", &LimitsConfig::max_w_radps, {1.0, 1000.0}, "highest turning speed", "deg/s");
    fields.number("max_acceleration_mps2", &LimitsConfig::max_acceleration_mps2, {0.01, 100.0}, "m/s2",
                  "highest acceleration, braking too");
    fields.angle("max_turn_acceleration_degps2", &LimitsConfig::max_turn_acceleration_radps2, {1.0, 100000.0},
                 "highest turning acceleration", "deg/s2");
    fields.number("min_turning_radius_m", &LimitsConfig::min_turning_radius_m, {0.0, 100.0}, "m",
                  "smallest turning circle of a car, at its reference point");
  }
};

struct SonarConfig {
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;
  double half_beam_rad = radians(15.0);
  double min_m = 0.1;
  double max_m = 5.0;
  static void describe(Fields<SonarConfig>& fields) {
    fields.number("x_m", &SonarConfig::x_m, {-10.0, 10.0}, "m", "place on the robot, ahead of its centre").required =
        true;
    fields.number("y_m", &SonarConfig::y_m, {-10.0, 10.0}, "m", "place on the robot, left of its centre").required =
        true;
    fields.angle("angle_deg", &SonarConfig::angle_rad, {-360.0, 360.0}, "beam axis, anticlockwise from ahead")
        .required = true;
    fields.angle("half_beam_deg", &SonarConfig::half_beam_rad, {0.0, 90.0}, "half the width of the beam");
    fields.number(
        "min_m", &SonarConfig::min_m, {0.0, 100.0}, "m",
        "nearest distance that it can measure; a nearer reading, a negative one and NaN say nothing to any map");
    fields.number(
        "max_m", &SonarConfig::max_m, {0.01, 100.0}, "m",
        "farthest distance that it can measure; a reading this far or farther, or +inf, means no echo up to here");
  }
};

struct FiringConfig {
  ConfigValue order;
  double period_s = 0.04;
  static void describe(Fields<FiringConfig>& fields) {
    fields.raw("order", &FiringConfig::order, "list of integers",
               "which sonar fires when, by its number in the list (from 0); as listed when left out");
    fields.number("period_s", &FiringConfig::period_s, {0.0, 10.0}, "s",
                  "one sonar fires each period; 0: all fire at once");
  }
};

struct LaserConfig : LaserModel {
  double x_m = 0.0;
  double y_m = 0.0;
  double angle_rad = 0.0;
  static void describe(Fields<LaserConfig>& fields) {
    fields.number("x_m", &LaserConfig::x_m, {-10.0, 10.0}, "m", "place on the robot, ahead of its centre").required =
        true;
    fields.number("y_m", &LaserConfig::y_m, {-10.0, 10.0}, "m", "place on the robot, left of its centre").required =
        true;
    fields.angle("angle_deg", &LaserConfig::angle_rad, {-360.0, 360.0}, "which way it looks, anticlockwise from ahead");
    fields.angle("first_angle_deg", &LaserConfig::first_angle_rad, {-360.0, 360.0},
                 "of the first beam, from the way it looks");
    fields.angle("last_angle_deg", &LaserConfig::last_angle_rad, {-360.0, 360.0},
                 "of the last beam; the others are spread evenly between");
    fields.integer("beams", static_cast<int LaserConfig::*>(&LaserModel::beams), {1, kMaxTransducers},
                   "beams of a scan");
    fields.number("min_m", &LaserConfig::min_m, {0.0, 100.0}, "m", "nearest distance that it can measure");
    fields.number("max_m", &LaserConfig::max_m, {0.01, 1000.0}, "m",
                  "farthest distance that it can measure; a reading this far or farther means nothing up to here");
    fields.number("rate_hz", &LaserConfig::rate_hz, {0.1, 1000.0}, "1/s", "scans a second");
    fields.number("noise_m", &LaserConfig::noise_m, {0.0, 10.0}, "m", "error of a range, standard deviation");
    fields.number("noise_ratio", &LaserConfig::noise_ratio, {0.0, 1.0}, "", "further error, as a share of the range");
    fields.number("dropped_ratio", &LaserConfig::dropped_ratio, {0.0, 1.0}, "", "share of echoes lost");
  }
};

struct OdometryConfig : OdometryError {
  static void describe(Fields<OdometryConfig>& fields) {
    fields.number("distance_ratio", &OdometryConfig::distance_ratio, {0.0, 1.0}, "",
                  "error of the distance driven, independent from metre to metre");
    fields.number("distance_bias_ratio", &OdometryConfig::distance_bias_ratio, {0.0, 1.0}, "",
                  "error of the distance driven that stays the same over a run");
    fields.angle("heading_deg_per_m", &OdometryConfig::heading_rad_per_m, {0.0, 90.0},
                 "error of the heading, independent from metre to metre", "deg/m");
  }
};

struct CompassConfig : CompassError {
  static void describe(Fields<CompassConfig>& fields) {
    fields.angle("noise_deg", &CompassConfig::noise_rad, {0.0, 180.0}, "error of each reading");
    fields.angle("local_bias_deg", &CompassConfig::local_bias_rad, {0.0, 180.0},
                 "bound of a bias that wanders from place to place");
    fields.number("local_bias_scale_m", &CompassConfig::local_bias_scale_m, {0.01, 1000.0}, "m",
                  "distance over which that bias changes");
  }
};

struct RangesConfig : RangeError {
  static void describe(Fields<RangesConfig>& fields) {
    fields.number("noise_m", &RangesConfig::noise_m, {0.0, 10.0}, "m", "error of a range");
    fields.number("noise_ratio", &RangesConfig::noise_ratio, {0.0, 1.0}, "", "further error, as a share of the range");
    fields.number("dropped_ratio", &RangesConfig::dropped_ratio, {0.0, 1.0}, "", "share of echoes lost");
    fields.number("crosstalk_ratio", &RangesConfig::crosstalk_ratio, {0.0, 1.0}, "",
                  "share of readings replaced by another sonar's echo");
  }
};

struct RobotConfig {
  std::string name;
  double radius_m = 0.0;
  std::vector<Point> polygon_m;
  Kinematics kinematics = Kinematics::differential;
  LimitsConfig limits;
  std::vector<SonarConfig> sonars;
  FiringConfig firing;
  std::vector<LaserConfig> lasers;
  std::vector<robot_config::CameraConfig> cameras;
  OdometryConfig odometry;
  CompassConfig compass;
  RangesConfig ranges;
  static void describe(Fields<RobotConfig>& fields) {
    fields.text("name", &RobotConfig::name, "what people call it").required = true;
    fields.number("radius_m", &RobotConfig::radius_m, {0.01, 10.0}, "m", "footprint of a round robot");
    fields.points("polygon_m", &RobotConfig::polygon_m, "m", "footprint of any other, about the point it turns on");
    fields.choice("kinematics", &RobotConfig::kinematics,
                  {{"differential", Kinematics::differential}, {"car", Kinematics::car}}, "how it moves");
    fields.group("limits", &RobotConfig::limits, "how fast it may move");
    fields.list("sonars", &RobotConfig::sonars, "its sonars");
    fields.group("firing", &RobotConfig::firing, "when the sonars fire");
    fields.list("lasers", &RobotConfig::lasers, "its laser scanners; their beams are numbered after the sonars");
    fields.list("cameras", &RobotConfig::cameras, "its cameras; pictures are made only when the mission needs them");
    fields.group("odometry", &RobotConfig::odometry, "standard deviations of its dead reckoning");
    fields.group("compass", &RobotConfig::compass, "standard deviations of its compass; left out, the robot has none");
    fields.group("ranges", &RobotConfig::ranges, "standard deviations of its sonars' ranges");
    fields.one_of({"radius_m", "polygon_m"});
  }
};

void set_footprint(RobotModel& robot, const RobotConfig& config, const ConfigValue& root) {
  if (config_detail::exactly_one_of(root, robot_file_schema().one_of, "robot") == "radius_m") {
    robot.radius_m = config.radius_m;
    return;
  }
  try {
    robot.polygon_m = Contour::polygon_in_place(config.polygon_m).polygons_m.front();
  } catch (const std::invalid_argument& error) {
    throw ConfigError(root.find("polygon_m")->place, std::string("polygon_m: ") + error.what());
  }
  robot.radius_m = 0.0;
  for (const Point& corner : robot.polygon_m) robot.radius_m = std::max(robot.radius_m, corner.norm());
}

void set_motion(RobotModel& robot, const RobotConfig& config, const ConfigValue& root) {
  robot.kinematics = config.kinematics;
  robot.max_v_mps = config.limits.max_v_mps;
  robot.max_w_radps = config.limits.max_w_radps;
  robot.max_acceleration_mps2 = config.limits.max_acceleration_mps2;
  robot.max_turn_acceleration_radps2 = config.limits.max_turn_acceleration_radps2;
  robot.min_turning_radius_m = config.limits.min_turning_radius_m;
  const ConfigValue* limits = root.find("limits");
  const bool is_car = robot.kinematics == Kinematics::car;
  if (is_car && robot.min_turning_radius_m <= 0.0) {
    throw ConfigError(limits == nullptr ? root.place : limits->place,
                      "a car needs limits: {min_turning_radius_m: ...} above 0");
  }
  if (!is_car && robot.min_turning_radius_m > 0.0) {
    throw ConfigError(limits->find("min_turning_radius_m")->place,
                      "min_turning_radius_m is for \"kinematics: car\" only; a differential robot turns on the spot");
  }
}

void set_sonars(RobotModel& robot, const RobotConfig& config, const ConfigValue& root) {
  for (std::size_t i = 0; i < config.sonars.size(); ++i) {
    const SonarConfig& sonar = config.sonars[i];
    if (sonar.min_m >= sonar.max_m) {
      throw ConfigError(root.find("sonars")->items[i].place, "min_m must be less than max_m, found " +
                                                                 config_detail::number_text(sonar.min_m) + " and " +
                                                                 config_detail::number_text(sonar.max_m));
    }
    robot.sonars.push_back(
        {{sonar.x_m, sonar.y_m, wrap_angle(sonar.angle_rad)}, sonar.half_beam_rad, sonar.min_m, sonar.max_m});
  }
}

void set_lasers(RobotModel& robot, const RobotConfig& config, const ConfigValue& root) {
  for (std::size_t i = 0; i < config.lasers.size(); ++i) {
    const LaserConfig& laser = config.lasers[i];
    const SourcePlace& place = root.find("lasers")->items[i].place;
    using config_detail::number_text;
    if (laser.min_m >= laser.max_m)
      throw ConfigError(place, "min_m must be less than max_m, found " + number_text(laser.min_m) + " and " +
                                   number_text(laser.max_m));
    const double span_deg = degrees(std::abs(laser.last_angle_rad - laser.first_angle_rad));
    if (laser.beams > 1 && !(span_deg > 0.0 && span_deg <= 360.0 + 1e-9))
      throw ConfigError(place,
                        "first_angle_deg and last_angle_deg must be more than 0 and at most 360 deg apart, found " +
                            number_text(degrees(laser.first_angle_rad)) + " and " +
                            number_text(degrees(laser.last_angle_rad)));
    robot.lasers.push_back(laser);
    robot.lasers.back().T_robot_laser = {laser.x_m, laser.y_m, wrap_angle(laser.angle_rad)};
    if (const int all = first_beam_of(robot, robot.lasers.size()); all > kMaxTransducers)
      throw ConfigError(place, "sonars and beams together may be " + std::to_string(kMaxTransducers) +
                                   " at most, found " + std::to_string(all));
  }
}

void set_firing(RobotModel& robot, const FiringConfig& firing) {
  robot.firing_period_s = firing.period_s;
  if (firing.order.kind == ConfigValue::Kind::null) return;
  const double last = static_cast<double>(robot.sonars.size()) - 1.0;
  for (const ConfigValue& item : config_detail::to_list(firing.order, "order")) {
    if (robot.sonars.empty()) throw ConfigError(item.place, "order names a sonar, but the robot has none");
    robot.firing_order.push_back(static_cast<int>(config_detail::to_integer(item, "each item of order", {0.0, last})));
  }
}

}  // namespace

Schema robot_file_schema() {
  return schema_of<RobotConfig>();
}

RobotModel load_robot(const std::filesystem::path& file) {
  const ConfigValue root = read_config_file(file);
  const auto config = load_config<RobotConfig>(root, "robot");
  RobotModel robot;
  robot.name = config.name;
  set_footprint(robot, config, root);
  set_motion(robot, config, root);
  set_sonars(robot, config, root);
  set_firing(robot, config.firing);
  set_lasers(robot, config, root);
  for (std::size_t i = 0; i < config.cameras.size(); ++i)
    robot.cameras.push_back(robot_config::camera_of(config.cameras[i], root.find("cameras")->items[i]));
  robot.odometry_error = config.odometry;
  robot.has_compass = root.find("compass") != nullptr;
  robot.compass_error = config.compass;
  robot.range_error = config.ranges;
  return robot;
}

}  // namespace cairn
