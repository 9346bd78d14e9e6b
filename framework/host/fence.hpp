// Fencing: whatever a module throws becomes a fault that names the module and its stage.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "framework/config/config_value.hpp"

namespace cairn {

class ModuleFault : public std::runtime_error {
 public:
  ModuleFault(const std::string& stage, const std::string& module, const std::string& what)
      : std::runtime_error("module " + module + " failed in stage " + stage + ": " + what) {}
};

// Calls a module. ConfigError passes: it is the user's file that is wrong, not the module. It passes as
// a copy, since the code of the thrown object may be unloaded with the module before anyone reads it.
template <class Call>
auto fenced(const char* stage, const std::string& module, Call&& call) -> decltype(call()) {
  try {
    return std::forward<Call>(call)();
  } catch (const ConfigError& error) {
    throw ConfigError(error);
  } catch (const ModuleFault&) {
    throw;
  } catch (const std::exception& error) {
    throw ModuleFault(stage, module, error.what());
  } catch (...) {
    throw ModuleFault(stage, module, "threw something that is no std::exception");
  }
}

}  // namespace cairn
