// Opens one module file: checks its ABI stamp, then lets it register.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/contracts/module.hpp"

namespace cairn {

// A file that is not a module, or a module that cannot be used; what() names file and reason.
class PluginError : public std::runtime_error {
 public:
  PluginError(const std::filesystem::path& file, const std::string& reason)
      : std::runtime_error(file.string() + ": " + reason), reason_(reason) {}
  [[nodiscard]] const std::string& reason() const { return reason_; }

 private:
  std::string reason_;
};

// A loaded module. Its library stays open until the program ends.
struct LoadedPlugin {
  std::filesystem::path file;
  AbiStamp stamp{};  // what it was built with
  std::vector<RegisteredModule> modules;
};

// Throws PluginError. Code of the file runs only when it has the symbols of a module: in this process, where it may do
// anything (ModuleTrial finds out before). before_registering is called when the file is open.
[[nodiscard]] LoadedPlugin load_plugin(const std::filesystem::path& file,
                                       const std::function<void()>& before_registering = {});

}  // namespace cairn
