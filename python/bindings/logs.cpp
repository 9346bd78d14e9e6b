// Recorded logs as arrays, read by the modules that missions read them with.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <limits>

#include "framework/config/config_value.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/modules/fence.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

struct Log {
  std::vector<double> stamp_s;
  std::vector<Pose2> odometry;
  std::vector<double> compass_rad;
  std::vector<std::int64_t> first_range{0};  // of each observation, and behind the last
  std::vector<double> range_m;
  std::vector<double> max_m;
  std::vector<Pose2> sensor_pose;
  std::vector<std::int32_t> sensor;
};

void add(Log& log, const Observation& observation) {
  log.stamp_s.push_back(observation.stamp_s);
  log.odometry.push_back(observation.T_odom_robot);
  log.compass_rad.push_back(observation.compass_rad.value_or(std::numeric_limits<double>::quiet_NaN()));
  for (const RangeReading& reading : observation.ranges) {
    log.range_m.push_back(reading.range_m);
    log.max_m.push_back(reading.max_m);
    log.sensor_pose.push_back(reading.T_robot_sensor);
    log.sensor.push_back(reading.sensor);
  }
  log.first_range.push_back(static_cast<std::int64_t>(log.range_m.size()));
}

PluginChoice choice_of(const std::string& plugin, const std::vector<std::string>& settings) {
  PluginChoice choice{plugin, {}};
  choice.config.kind = ConfigValue::Kind::map;
  choice.config.place.file = plugin;
  for (const std::string& assignment : settings) apply_override(choice.config, assignment);
  return choice;
}

Log read(const std::string& plugin, const std::vector<std::string>& settings, const std::filesystem::path& robot_file) {
  const RobotModel robot = robot_file.empty() ? RobotModel{} : load_robot(robot_file);
  const PluginChoice choice = choice_of(plugin, settings);
  SensorContext context{ModuleContext{robot}};
  context.modules = &module_library();
  const auto sensor = fenced_making(plugin, [&] { return module_library().make<Sensor>(choice, context); });
  if (fenced("sensor", plugin, [&] { return sensor->drive(); }) != nullptr)
    throw ConfigError({plugin, 0, 0}, "is no log: it moves a robot");
  Log log;
  while (true) {
    const SensorStep step = fenced("sensor", plugin, [&] { return sensor->next(Budget{}); });
    if (step.state == SensorState::end_of_data) return log;
    if (step.state == SensorState::fault) throw ModuleFault("sensor", plugin, step.reason);
    add(log, step.observation);
  }
}

template <class Value>
py::array_t<Value> array_of(const std::vector<Value>& values) {
  return py::array_t<Value>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace

void add_logs(py::module_& module) {
  module.def(
      "read_log",
      [](const std::string& plugin, const std::vector<std::string>& settings, const std::filesystem::path& robot) {
        const Log log = [&] {
          const py::gil_scoped_release others_run;
          return read(plugin, settings, robot);
        }();
        return py::make_tuple(array_of(log.stamp_s), python::array_of(log.odometry), array_of(log.compass_rad),
                              array_of(log.first_range), array_of(log.range_m), array_of(log.max_m),
                              python::array_of(log.sensor_pose), array_of(log.sensor));
      },
      py::arg("plugin"), py::arg("settings"), py::arg("robot"));
}

}  // namespace cairn::python
