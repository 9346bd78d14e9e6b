#include "plugins/python_module/python_sensor.hpp"

#include <pybind11/numpy.h>

#include <cmath>

#include "plugins/python_module/values.hpp"
#include "python/shared/pose_arrays.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

void add_to_context(py::dict& attributes, const SensorContext& context) {
  attributes["start"] = python::tuple_of(context.T_map_start);
  attributes["begin_s"] = context.begin_s;
}

template <class Number>
std::vector<Number> numbers_from(const py::handle& value, const std::string& what) {
  const auto array = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(value);
  if (!array) {
    PyErr_Clear();
    throw std::runtime_error(what + " must be numbers, found " + found_text(value));
  }
  if (array.ndim() != 1)
    throw std::runtime_error(what + " must have one dimension, found " + std::to_string(array.ndim()));
  return {array.data(), array.data() + array.size()};
}

double finite_from(const py::handle& value, const std::string& what) {
  const double number = number_from(value, what);
  if (!std::isfinite(number)) throw std::runtime_error(what + " must be finite");
  return number;
}

// As REP-117 has it, for the transducer's own limits.
double within_limits(double range_m, const RangeReading& transducer) {
  if (range_m < transducer.min_m) return -std::numeric_limits<double>::infinity();
  return range_m > transducer.max_m ? std::numeric_limits<double>::infinity() : range_m;
}

std::vector<RangeReading> readings_from(const Fields& fields, const std::vector<RangeReading>& transducers) {
  const py::object given = fields.find("ranges_m");
  const py::object numbers = fields.find("sensors");
  if (given.is_none()) {
    if (!numbers.is_none()) throw std::runtime_error(fields.name_of("sensors") + " has no ranges_m beside it");
    return {};
  }
  const std::vector<double> ranges = numbers_from<double>(given, fields.name_of("ranges_m"));
  std::vector<long long> sensors;
  if (numbers.is_none()) {
    for (std::size_t i = 0; i < transducers.size(); ++i) sensors.push_back(static_cast<long long>(i));
  } else {
    sensors = numbers_from<long long>(numbers, fields.name_of("sensors"));
  }
  if (ranges.size() != sensors.size())
    throw std::runtime_error(fields.name_of("ranges_m") + " has " + std::to_string(ranges.size()) + " numbers, " +
                             (numbers.is_none() ? "the robot has " : "sensors has ") + std::to_string(sensors.size()));
  std::vector<RangeReading> readings;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    if (sensors[i] < 0 || sensors[i] >= static_cast<long long>(transducers.size()))
      throw std::runtime_error(fields.name_of("sensors") + ": there is no transducer " + std::to_string(sensors[i]) +
                               "; the robot has " + std::to_string(transducers.size()) + ", from 0");
    if (std::isnan(ranges[i])) continue;  // it has not fired
    RangeReading reading = transducers[static_cast<std::size_t>(sensors[i])];
    reading.range_m = within_limits(ranges[i], reading);
    readings.push_back(reading);
  }
  return readings;
}

}  // namespace

PythonSensor::PythonSensor(const Config& config, const SensorContext& context)
    : object_(config, context, [&](py::dict& attributes) { add_to_context(attributes, context); }, {"next"}),
      transducers_(transducers_of(context.robot)) {
  object_.call(&context.budget, [&](py::object& object) {
    if (py::hasattr(object, "knows_truth")) knows_truth_ = flag_from(object.attr("knows_truth"), "knows_truth");
    if (!py::hasattr(object, "start")) return;
    const py::object start = object.attr("start")();
    if (!start.is_none()) start_ = pose_from(start, "what " + object_.name_of("start") + " returned");
  });
}

SensorStep PythonSensor::next(const Budget& budget) {
  SensorStep end{SensorState::end_of_data, {}, object_.name_of("next") + " has no more observations"};
  if (has_ended_) return end;
  return object_.call(&budget, [&](py::object& object) -> SensorStep {
    const py::object found = object.attr("next")();
    if (found.is_none()) {
      has_ended_ = true;
      return end;
    }
    return {SensorState::observation, observation_from(found), {}};
  });
}

Observation PythonSensor::observation_from(const py::handle& value) {
  const Fields fields(
      value, "what " + object_.name_of("next") + " returned",
      {"stamp_s", "odometry", "ranges_m", "sensors", "compass_rad", "bumped", "battery_ratio", "true_pose"});
  Observation seen;
  seen.stamp_s = finite_from(fields.get("stamp_s"), fields.name_of("stamp_s"));
  seen.T_odom_robot = pose_from(fields.get("odometry"), fields.name_of("odometry"));
  seen.ranges = readings_from(fields, transducers_);
  if (const py::object compass = fields.find("compass_rad"); !compass.is_none())
    seen.compass_rad = wrap_angle(finite_from(compass, fields.name_of("compass_rad")));
  if (const py::object bumped = fields.find("bumped"); !bumped.is_none())
    seen.bumped = flag_from(bumped, fields.name_of("bumped"));
  if (const py::object battery = fields.find("battery_ratio"); !battery.is_none())
    seen.battery_ratio = finite_from(battery, fields.name_of("battery_ratio"));
  truth_.reset();
  if (const py::object pose = fields.find("true_pose"); !pose.is_none())
    truth_ = GroundTruth{pose_from(pose, fields.name_of("true_pose")), {}};
  return seen;
}

}  // namespace cairn::python_module
