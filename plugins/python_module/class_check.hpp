// Whether a class of a Python file can be what a mission wants it for.
#pragma once

#include <pybind11/pybind11.h>

#include <initializer_list>
#include <string>

#include "plugins/python_module/config.hpp"

namespace cairn::python_module {

// The class of that name. Throws ConfigError at its place in the mission: there is none, it is no class, a method is
// missing.
[[nodiscard]] pybind11::object class_in(const pybind11::module_& module, const std::string& file,
                                        const ConfigValue& class_name, std::initializer_list<const char*> methods);
// Whether it takes these settings as parameters behind the context. Throws ConfigError: unknown or missing ones.
void check_settings(const pybind11::object& type, const Config& config);

}  // namespace cairn::python_module
