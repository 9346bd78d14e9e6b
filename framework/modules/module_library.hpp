// All modules that the program knows: found in the plugin folders, made by name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/modules/plugin_loader.hpp"

namespace cairn {

// A module as `cairn plugins` lists it.
struct ModuleEntry {
  const RegisteredModule* module = nullptr;
  const LoadedPlugin* plugin = nullptr;
};

class ModuleLibrary : public ModuleMaker {
 public:
  // Loads every *.so of the folders, sorted by file name. A file that cannot be used, and a name
  // that is taken, become faults; the others stay usable. A folder that does not exist is a fault.
  explicit ModuleLibrary(const std::vector<std::filesystem::path>& folders);

  // Modules linked into the program (CAIRN_STATIC_MODULE); origin: what `cairn plugins` calls the file.
  void add(const std::string& origin, const Registrar& registrar);

  [[nodiscard]] std::vector<ModuleEntry> entries() const;  // by kind, then name
  // The module of that name; where a planner is asked for, a path or route planner will do. Throws ConfigError at the
  // place of the choice: unknown name (nearest one), wrong kind.
  [[nodiscard]] const RegisteredModule& find(PluginKind kind, const std::string& name, const SourcePlace& place) const;
  [[nodiscard]] const ModuleEntry* find_any(const std::string& name) const;
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::shared_ptr<void> make_any(PluginKind kind, const PluginChoice& choice,
                                 const ModuleContext& context) const override;
  void adopt(std::unique_ptr<LoadedPlugin> plugin);

  std::vector<std::unique_ptr<LoadedPlugin>> plugins_;
  std::vector<ModuleEntry> entries_;
  std::vector<std::string> faults_;
};

// Whether a module of kind `found` can be made where one of kind `wanted` is asked for: a path or route planner serves
// as a planner by itself (adapters/lone_planners.hpp).
[[nodiscard]] bool serves_as(PluginKind found, PluginKind wanted);

// Where modules are looked for: folders given, then CAIRN_PLUGIN_PATH (colon separated), then
// lib/cairn beside the program's bin folder.
[[nodiscard]] std::vector<std::filesystem::path> plugin_folders(const std::vector<std::filesystem::path>& given);

}  // namespace cairn
