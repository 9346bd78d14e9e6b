// Between values of Cairn and of Python. All with the interpreter's lock.
#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn::python_module {

// The geometry of all transducers, as readings have it: the sonars first, then each laser's beams.
[[nodiscard]] std::vector<RangeReading> transducers_of(const RobotModel& robot);

// A setting as YAML means it: None, bool, int, float, str, list or dict.
[[nodiscard]] pybind11::object value_of(const ConfigValue& value);
// An object with these attributes.
[[nodiscard]] pybind11::object namespace_of(const pybind11::dict& attributes);
[[nodiscard]] pybind11::object namespace_of(const RobotModel& robot);
[[nodiscard]] pybind11::object namespace_of(const Observation& observation);

// The other way. what: "degree of item 2 of what detect() returned", for the std::runtime_error that they throw.
[[nodiscard]] double number_from(const pybind11::handle& value, const std::string& what);
[[nodiscard]] std::string text_from(const pybind11::handle& value, const std::string& what);
[[nodiscard]] bool flag_from(const pybind11::handle& value, const std::string& what);
// (x, y) or (x, y, heading), finite.
[[nodiscard]] Pose2 pose_from(const pybind11::handle& value, const std::string& what);

// A dict with some of these keys. Throws std::runtime_error: none, or another key (with the nearest one).
class Fields {
 public:
  Fields(const pybind11::handle& value, std::string what, std::initializer_list<const char*> keys);
  // None where it is left out. Throws std::runtime_error where it is required.
  [[nodiscard]] pybind11::object find(const char* key) const;
  [[nodiscard]] pybind11::object get(const char* key) const;
  [[nodiscard]] std::string name_of(const char* key) const { return std::string(key) + " of " + what_; }

 private:
  pybind11::dict values_;
  std::string what_;
};

// "a list", "an int", ...: its type and the beginning of its text.
[[nodiscard]] std::string found_text(const pybind11::handle& value);

}  // namespace cairn::python_module
