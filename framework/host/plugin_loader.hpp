// Opens one module file: checks its ABI stamp, then lets it register.
#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/contracts/module.hpp"

namespace cairn {

// A file that is no module, or a module that cannot be used; what() names file and reason.
class PluginError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A loaded module. The library stays open as long as `library` or any object made from it lives.
struct LoadedPlugin {
  std::filesystem::path file;
  std::string version;            // Cairn version it was built with
  std::shared_ptr<void> library;  // before modules: destroyed after them
  std::vector<RegisteredModule> modules;
};

// Throws PluginError.
[[nodiscard]] LoadedPlugin load_plugin(const std::filesystem::path& file);

}  // namespace cairn
