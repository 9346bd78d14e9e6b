// All modules that the program knows: found in the plugin folders, made by name.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "framework/modules/plugin_loader.hpp"
#include "framework/modules/trial/module_trial.hpp"

namespace cairn {

// A module whose file is open.
struct ModuleEntry {
  const RegisteredModule* module = nullptr;
  const LoadedPlugin* plugin = nullptr;
};

// A module as `cairn plugins` lists it; its file may not be open.
struct KnownModule : ModuleSummary {
  std::filesystem::path file;
};

class ModuleLibrary : public ModuleMaker {
 public:
  // Knows every *.so of the folders, sorted by file name. A file that cannot be used, and a name that is taken, become
  // faults; the others stay usable. A folder that does not exist is a fault.
  // With a trial, each file is tried there, and opened here when one of its modules is asked for. Without one, all are
  // opened at once, and a file that crashes or hangs takes this process along.
  explicit ModuleLibrary(const std::vector<std::filesystem::path>& folders,
                         std::shared_ptr<const ModuleTrial> trial = nullptr);
  ModuleLibrary(ModuleLibrary&&) noexcept;
  ModuleLibrary& operator=(ModuleLibrary&&) noexcept;
  ~ModuleLibrary() override;

  // Modules linked into the program (CAIRN_STATIC_MODULE); origin: what `cairn plugins` calls the file.
  void add(const std::string& origin, const Registrar& registrar);

  [[nodiscard]] std::vector<KnownModule> known() const;    // by kind, then name; opens nothing
  [[nodiscard]] std::vector<ModuleEntry> entries() const;  // the same, all opened
  // The module of that name; where a planner is asked for, a path or route planner will do. Throws ConfigError at the
  // place of the choice: unknown name (nearest one), wrong kind.
  [[nodiscard]] const RegisteredModule& find(PluginKind kind, const std::string& name, const SourcePlace& place) const;
  // The module of that name and kind, or of a kind that shares its names. Null: there is none, or its file cannot be
  // opened after all, which is one more fault. Before it answers that there is none, it tries those files again that
  // were dangerous in an earlier trial.
  [[nodiscard]] const ModuleEntry* find_of(PluginKind kind, const std::string& name) const;
  // The same, of any kind: the first one of that name.
  [[nodiscard]] const ModuleEntry* find_any(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> faults() const;

 private:
  std::shared_ptr<void> make_any(PluginKind kind, const PluginChoice& choice,
                                 const ModuleContext& context) const override;

  class Files;
  std::unique_ptr<Files> files_;
};

// Whether a module of kind `found` can be made where one of kind `wanted` is asked for: a path or route planner serves
// as a planner by itself (adapters/lone_planners.hpp).
[[nodiscard]] bool serves_as(PluginKind found, PluginKind wanted);
// Whether a name stands for one module of both kinds at most: the same kind, or all that serve as planners.
[[nodiscard]] bool share_names(PluginKind a, PluginKind b);

// The *.so files of a folder, sorted by name.
[[nodiscard]] std::vector<std::filesystem::path> module_files(const std::filesystem::path& folder);

// The folder with bin lib share that this library is in, and so the program, its modules and its configuration.
[[nodiscard]] std::filesystem::path installed_prefix();

// Where modules are looked for: folders given, then CAIRN_PLUGIN_PATH (colon separated), then lib/cairn under the
// installed prefix.
[[nodiscard]] std::vector<std::filesystem::path> plugin_folders(const std::vector<std::filesystem::path>& given);

}  // namespace cairn
