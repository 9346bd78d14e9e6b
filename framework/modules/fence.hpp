// Fencing: whatever a module throws becomes a fault that names the module and its stage.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/config/config_value.hpp"
#include "framework/modules/stage_clock.hpp"

namespace cairn {

class ModuleFault : public std::runtime_error {
 public:
  ModuleFault(const std::string& stage, const std::string& module, const std::string& what)
      : std::runtime_error("module " + module + " failed in stage " + stage + ": " + what) {}
};

// Calls a module. What the host itself throws below the module (a fault of another module that it
// asked for, the end of a mission that was given up) passes.
template <class Call>
auto fenced(const std::string& stage, const std::string& module, Call&& call) -> decltype(call()) {
  try {
    return std::forward<Call>(call)();
  } catch (const GivenUp&) {
    throw;
  } catch (const ModuleFault&) {
    throw;
  } catch (const std::exception& error) {
    throw ModuleFault(stage, module, error.what());
  } catch (...) {
    throw ModuleFault(stage, module, "threw something that is no std::exception");
  }
}

// The same for making a module, where ConfigError passes: it is the user's file that is wrong. It
// passes as a copy made here, so that nothing of the module is needed to read it.
template <class Call>
auto fenced_making(const std::string& module, Call&& call) -> decltype(call()) {
  std::exception_ptr user_error;
  try {
    return fenced("construction", module, [&]() -> decltype(call()) {
      try {
        return std::forward<Call>(call)();
      } catch (const ConfigError& error) {
        user_error = std::make_exception_ptr(ConfigError(error));
        throw;
      }
    });
  } catch (const ModuleFault&) {
    if (user_error) std::rethrow_exception(user_error);
    throw;
  }
}

}  // namespace cairn
