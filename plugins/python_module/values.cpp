#include "plugins/python_module/values.hpp"

#include <pybind11/numpy.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "maps/base/printable.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"
#include "python/shared/pose_arrays.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

using python::tuple_of;

template <class Number>
std::optional<Number> parsed(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

py::object value_of_scalar(const ConfigValue& value) {
  const std::string& text = value.scalar;
  if (!value.quoted) {
    if (text == "true" || text == "false") return py::bool_(text == "true");
    if (text == "null" || text == "~" || text.empty()) return py::none();
    if (const auto number = parsed<std::int64_t>(text)) return py::int_(*number);
    if (const auto number = parsed<double>(text)) return py::float_(*number);
  }
  return py::str(text);
}

template <class Entries, class Value>
py::array_t<double> numbers_of(const Entries& entries, Value value) {
  py::array_t<double> numbers(static_cast<py::ssize_t>(entries.size()));
  double* out = numbers.mutable_data();
  for (const auto& entry : entries) *out++ = value(entry);
  return numbers;
}

void add_geometry(py::dict& attributes, const std::vector<RangeReading>& readings) {
  std::vector<Pose2> poses;
  poses.reserve(readings.size());
  for (const RangeReading& reading : readings) poses.push_back(reading.T_robot_sensor);
  attributes["sensor_poses"] = python::array_of(poses);
  attributes["half_beam_rad"] = numbers_of(readings, [](const RangeReading& r) { return r.half_beam_rad; });
  attributes["min_m"] = numbers_of(readings, [](const RangeReading& r) { return r.min_m; });
  attributes["max_m"] = numbers_of(readings, [](const RangeReading& r) { return r.max_m; });
}

template <class Value>
py::object none_or(const std::optional<Value>& value) {
  return value ? py::object(py::float_(*value)) : py::object(py::none());
}

[[noreturn]] void fail(const std::string& what, const char* allowed, const py::handle& found) {
  throw std::runtime_error(what + " must be " + allowed + ", found " + found_text(found));
}

}  // namespace

std::vector<RangeReading> transducers_of(const RobotModel& robot) {
  std::vector<RangeReading> all;
  for (const SonarModel& sonar : robot.sonars)
    all.push_back(
        {sonar.T_robot_sonar, sonar.half_beam_rad, sonar.min_m, sonar.max_m, 0.0, static_cast<int>(all.size())});
  for (const LaserModel& laser : robot.lasers)
    for (int beam = 0; beam < laser.beams; ++beam)
      all.push_back({laser.T_robot_beam(beam), 0.0, laser.min_m, laser.max_m, 0.0, static_cast<int>(all.size())});
  return all;
}

py::object value_of(const ConfigValue& value) {
  switch (value.kind) {
    case ConfigValue::Kind::null:
      return py::none();
    case ConfigValue::Kind::scalar:
      return value_of_scalar(value);
    case ConfigValue::Kind::list: {
      py::list list;
      for (const ConfigValue& item : value.items) list.append(value_of(item));
      return list;
    }
    case ConfigValue::Kind::map: {
      py::dict dict;
      for (const ConfigValue::Entry& entry : value.entries) dict[py::str(entry.key)] = value_of(entry.value);
      return dict;
    }
  }
  return py::none();
}

py::object namespace_of(const py::dict& attributes) {
  return py::module_::import("types").attr("SimpleNamespace")(**attributes);
}

py::object namespace_of(const RobotModel& robot) {
  py::dict attributes;
  attributes["name"] = robot.name;
  attributes["radius_m"] = robot.radius_m;
  py::list footprint;
  for (const Point& corner : robot.polygon_m) footprint.append(py::make_tuple(corner.x(), corner.y()));
  attributes["footprint_m"] = footprint;
  attributes["max_v_mps"] = robot.max_v_mps;
  attributes["max_w_radps"] = robot.max_w_radps;
  attributes["max_acceleration_mps2"] = robot.max_acceleration_mps2;
  attributes["max_turn_acceleration_radps2"] = robot.max_turn_acceleration_radps2;
  attributes["min_turning_radius_m"] = robot.min_turning_radius_m;
  attributes["kinematics"] = robot.kinematics == Kinematics::car ? "car" : "differential";
  add_geometry(attributes, transducers_of(robot));
  return namespace_of(attributes);
}

py::object namespace_of(const Observation& observation) {
  py::dict attributes;
  attributes["stamp_s"] = observation.stamp_s;
  attributes["odometry"] = tuple_of(observation.T_odom_robot);
  attributes["compass_rad"] = none_or(observation.compass_rad);
  attributes["bumped"] = observation.bumped;
  attributes["battery_ratio"] = none_or(observation.battery_ratio);
  attributes["ranges_m"] = numbers_of(observation.ranges, [](const RangeReading& r) { return r.range_m; });
  py::array_t<int> sensors(static_cast<py::ssize_t>(observation.ranges.size()));
  int* out = sensors.mutable_data();
  for (const RangeReading& reading : observation.ranges) *out++ = reading.sensor;
  attributes["sensors"] = sensors;
  add_geometry(attributes, observation.ranges);
  return namespace_of(attributes);
}

double number_from(const py::handle& value, const std::string& what) {
  try {
    return value.cast<double>();
  } catch (const py::cast_error&) {
    fail(what, "a number", value);
  }
}

std::string text_from(const py::handle& value, const std::string& what) {
  if (!py::isinstance<py::str>(value)) fail(what, "text", value);
  return py::bytes(value.attr("encode")("utf-8", "replace"));
}

bool flag_from(const py::handle& value, const std::string& what) {
  try {
    return value.cast<bool>();
  } catch (const py::cast_error&) {
    fail(what, "True or False", value);
  }
}

Pose2 pose_from(const py::handle& value, const std::string& what) {
  constexpr const char* kAllowed = "(x, y) or (x, y, heading), finite numbers";
  std::vector<double> numbers;
  try {
    for (const py::handle number : py::iter(value)) numbers.push_back(number.cast<double>());
  } catch (const py::cast_error&) {
    numbers.clear();
  } catch (const py::error_already_set&) {  // no sequence
    numbers.clear();
  }
  if (numbers.size() != 2 && numbers.size() != 3) fail(what, kAllowed, value);
  for (const double number : numbers)
    if (!std::isfinite(number)) fail(what, kAllowed, value);
  return {numbers[0], numbers[1], numbers.size() == 3 ? wrap_angle(numbers[2]) : 0.0};
}

Fields::Fields(const py::handle& value, std::string what, std::initializer_list<const char*> keys)
    : what_(std::move(what)) {
  if (!py::isinstance<py::dict>(value)) fail(what_, "a dict", value);
  values_ = py::reinterpret_borrow<py::dict>(value);
  const std::vector<std::string> known(keys.begin(), keys.end());
  for (const auto& [key, item] : values_) {
    const std::string name = text_from(key, "each key of " + what_);
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw std::runtime_error("unknown key " + in_quotes(name) + " in " + what_ + did_you_mean(name, known) +
                               "; known: " + joined(known));
  }
}

py::object Fields::find(const char* key) const {
  if (!values_.contains(key)) return py::none();
  return values_[key];
}

py::object Fields::get(const char* key) const {
  if (!values_.contains(key)) throw std::runtime_error(what_ + " lacks the key " + in_quotes(key));
  return values_[key];
}

std::string found_text(const py::handle& value) {
  std::string type = py::str(py::type::handle_of(value).attr("__name__"));
  if (value.is_none()) return "None";
  try {
    return type + " " +
           printable_excerpt(std::string(py::bytes(py::repr(value).attr("encode")("utf-8", "replace"))), 80);
  } catch (const py::error_already_set&) {
    return type;
  }
}

}  // namespace cairn::python_module
