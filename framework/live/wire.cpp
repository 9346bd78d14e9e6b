#include "framework/live/wire.hpp"

#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "maps/base/printable.hpp"

namespace cairn::live {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kMaxSensor = 100'000;

ordered_json value_of_range(double range_m) {
  if (std::isnan(range_m)) return "bad";
  if (std::isinf(range_m)) return range_m > 0.0 ? "no_echo" : "too_near";
  return range_m;
}

// What the robot's file says of a transducer: a sonar or a laser's beam.
std::optional<RangeReading> described(const RobotModel& robot, int number) {
  if (number < 0) return std::nullopt;
  if (const auto index = static_cast<std::size_t>(number); index < robot.sonars.size()) {
    const SonarModel& sonar = robot.sonars[index];
    return RangeReading{sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m, 0.0, number};
  }
  for (std::size_t i = 0; i < robot.lasers.size(); ++i) {
    const LaserModel& laser = robot.lasers[i];
    const int beam = number - first_beam_of(robot, i);
    if (beam < laser.beams) return RangeReading{laser.T_robot_beam(beam), 0.0, laser.min_m, laser.max_m, 0.0, number};
  }
  return std::nullopt;
}

ordered_json json_of(const RangeReading& reading, const RobotModel& robot) {
  ordered_json out{{"sensor", reading.sensor}, {"range_m", value_of_range(reading.range_m)}};
  const std::optional<RangeReading> model = described(robot, reading.sensor);
  const auto add = [&](const char* key, double value, double usual) {
    if (!model || value != usual) out[key] = value;
  };
  const RangeReading usual = model.value_or(RangeReading{});
  add("x_m", reading.T_robot_sensor.x_m, usual.T_robot_sensor.x_m);
  add("y_m", reading.T_robot_sensor.y_m, usual.T_robot_sensor.y_m);
  add("theta_rad", reading.T_robot_sensor.theta_rad, usual.T_robot_sensor.theta_rad);
  add("half_beam_rad", reading.half_beam_rad, usual.half_beam_rad);
  add("min_m", reading.min_m, usual.min_m);
  add("max_m", reading.max_m, usual.max_m);
  return out;
}

json parsed(std::string_view line) {
  try {
    json root = json::parse(line);
    if (!root.is_object()) throw std::runtime_error("not a JSON object");
    return root;
  } catch (const json::exception&) {
    throw std::runtime_error("not JSON");
  }
}

double number_of(const json& object, const char* key, std::optional<double> usual = std::nullopt) {
  const auto at = object.find(key);
  if (at == object.end() && usual) return *usual;
  if (at == object.end()) throw std::runtime_error(std::string("no \"") + key + "\"");
  if (!at->is_number()) throw std::runtime_error(std::string("\"") + key + "\" must be a number");
  const auto number = at->get<double>();
  if (!std::isfinite(number)) throw std::runtime_error(std::string("\"") + key + "\" is too large");
  return number;
}

double range_of(const json& reading, double min_m, double max_m) {
  const auto at = reading.find("range_m");
  if (at != reading.end() && at->is_string()) {
    const auto& word = at->get_ref<const std::string&>();
    if (word == "no_echo") return kInfinity;
    if (word == "too_near") return -kInfinity;
    if (word == "bad") return std::numeric_limits<double>::quiet_NaN();
    throw std::runtime_error("\"range_m\" must be a number, no_echo, too_near or bad");
  }
  const double range_m = number_of(reading, "range_m");
  if (range_m > max_m) return kInfinity;
  return range_m < min_m ? -kInfinity : range_m;
}

RangeReading reading_of(const json& from, const RobotModel& robot) {
  if (!from.is_object()) throw std::runtime_error("each of \"ranges\" must be an object");
  const double number = number_of(from, "sensor");
  if (!(number >= 0.0 && number <= kMaxSensor) || number != std::floor(number))
    throw std::runtime_error("\"sensor\" must be a transducer's number, from 0 on");
  RangeReading reading;
  reading.sensor = static_cast<int>(number);
  const std::optional<RangeReading> model = described(robot, reading.sensor);
  const auto value = [&](const char* key, double usual) {
    return number_of(from, key, model ? std::optional(usual) : std::nullopt);
  };
  const RangeReading usual = model.value_or(RangeReading{});
  reading.T_robot_sensor = {value("x_m", usual.T_robot_sensor.x_m), value("y_m", usual.T_robot_sensor.y_m),
                            wrap_angle(value("theta_rad", usual.T_robot_sensor.theta_rad))};
  reading.half_beam_rad = value("half_beam_rad", usual.half_beam_rad);
  reading.min_m = value("min_m", usual.min_m);
  reading.max_m = value("max_m", usual.max_m);
  if (!(reading.half_beam_rad >= 0.0 && reading.half_beam_rad <= std::numbers::pi))
    throw std::runtime_error("\"half_beam_rad\" must be from 0 to pi");
  if (!(reading.min_m >= 0.0 && reading.min_m < reading.max_m))
    throw std::runtime_error("\"min_m\" and \"max_m\" must be 0 <= min_m < max_m");
  reading.range_m = range_of(from, reading.min_m, reading.max_m);
  return reading;
}

Observation observation_of(const json& from, const RobotModel& robot) {
  Observation seen;
  seen.stamp_s = number_of(from, "stamp_s");
  const auto odometry = from.find("odometry");
  if (odometry == from.end() || !odometry->is_object()) throw std::runtime_error("no \"odometry\"");
  seen.T_odom_robot = {number_of(*odometry, "x_m"), number_of(*odometry, "y_m"),
                       wrap_angle(number_of(*odometry, "theta_rad"))};
  if (from.contains("compass_rad")) seen.compass_rad = wrap_angle(number_of(from, "compass_rad"));
  if (from.contains("battery_ratio")) seen.battery_ratio = number_of(from, "battery_ratio");
  const auto stopped_by = from.find("stopped_by");
  if (stopped_by != from.end() && !stopped_by->is_string()) throw std::runtime_error("\"stopped_by\" must be a text");
  if (stopped_by != from.end()) seen.stopped_by = printable_excerpt(stopped_by->get<std::string>());
  const auto bumped = from.find("bumped");
  if (bumped != from.end() && !bumped->is_boolean()) throw std::runtime_error("\"bumped\" must be true or false");
  seen.bumped = bumped != from.end() && bumped->get<bool>();
  const auto ranges = from.find("ranges");
  if (ranges == from.end()) return seen;
  if (!ranges->is_array()) throw std::runtime_error("\"ranges\" must be a list");
  for (const json& reading : *ranges) seen.ranges.push_back(reading_of(reading, robot));
  return seen;
}

}  // namespace

std::string line_of(const Observation& observation, const RobotModel& robot) {
  const Pose2& odometry = observation.T_odom_robot;
  ordered_json out{{"stamp_s", observation.stamp_s},
                   {"odometry", {{"x_m", odometry.x_m}, {"y_m", odometry.y_m}, {"theta_rad", odometry.theta_rad}}}};
  if (observation.compass_rad) out["compass_rad"] = *observation.compass_rad;
  out["ranges"] = ordered_json::array();
  for (const RangeReading& reading : observation.ranges) out["ranges"].push_back(json_of(reading, robot));
  if (observation.bumped) out["bumped"] = true;
  if (!observation.stopped_by.empty()) out["stopped_by"] = observation.stopped_by;
  if (observation.battery_ratio) out["battery_ratio"] = *observation.battery_ratio;
  return out.dump();
}

std::string fault_line(const std::string& reason) {
  return ordered_json{{"fault", reason}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

BaseLine base_line(std::string_view line, const RobotModel& robot) {
  const json root = parsed(line);
  BaseLine message;
  if (const auto fault = root.find("fault"); fault != root.end())
    message.fault = fault->is_string() ? fault->get<std::string>() : "a fault without words";
  else if (root.contains("stamp_s"))
    message.observation = observation_of(root, robot);
  return message;
}

CommandLine::CommandLine(const Twist& twist, double valid_for_s) {
  const int size =
      std::snprintf(text_.data(), text_.size(), "{\"v_mps\":%.17g,\"w_radps\":%.17g,\"valid_for_s\":%.17g}\n",
                    twist.v_mps, twist.w_radps, valid_for_s);
  size_ = size > 0 ? std::min(static_cast<std::size_t>(size), text_.size() - 1) : 0;
}

ClientLine client_line(std::string_view line) {
  const json root = parsed(line);
  ClientLine message;
  if (root.contains("stop")) {
    message.kind = ClientLine::Kind::stop;
  } else if (root.contains("next")) {
    message.kind = ClientLine::Kind::next;
  } else if (root.contains("v_mps")) {
    message.kind = ClientLine::Kind::command;
    message.twist = {number_of(root, "v_mps"), number_of(root, "w_radps")};
    message.valid_for_s = number_of(root, "valid_for_s");
    if (message.valid_for_s < 0.0) throw std::runtime_error("\"valid_for_s\" must be 0 or more");
  }
  return message;
}

}  // namespace cairn::live
