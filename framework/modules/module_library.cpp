#include "framework/modules/module_library.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "framework/modules/module_files.hpp"
#include "maps/base/text.hpp"

namespace cairn {
ModuleLibrary::ModuleLibrary(const std::vector<std::filesystem::path>& folders,
                             std::shared_ptr<const ModuleTrial> trial)
    : files_(std::make_unique<Files>(std::move(trial))) {
  files_->add_folders(folders);
}
ModuleLibrary::ModuleLibrary(ModuleLibrary&&) noexcept = default;
ModuleLibrary& ModuleLibrary::operator=(ModuleLibrary&&) noexcept = default;
ModuleLibrary::~ModuleLibrary() = default;

void ModuleLibrary::add(const std::string& origin, const Registrar& registrar) {
  LoadedPlugin plugin;
  plugin.file = origin;
  plugin.stamp = this_abi_stamp();
  plugin.modules = registrar.modules();
  files_->add(std::move(plugin));
}

std::vector<KnownModule> ModuleLibrary::known() const {
  return files_->known();
}

std::vector<ModuleEntry> ModuleLibrary::entries() const {
  std::vector<ModuleEntry> all;
  for (const KnownModule& module : known())
    if (const ModuleEntry* entry = files_->opened(module.name, module.kind)) all.push_back(*entry);
  return all;
}

const ModuleEntry* ModuleLibrary::find_of(PluginKind kind, const std::string& name) const {
  const ModuleEntry* entry = files_->opened(name, kind);
  return entry == nullptr && files_->try_fatal_again() ? files_->opened(name, kind) : entry;
}

const ModuleEntry* ModuleLibrary::find_any(const std::string& name) const {
  const ModuleEntry* entry = files_->opened(name);
  return entry == nullptr && files_->try_fatal_again() ? files_->opened(name) : entry;
}

std::vector<std::string> ModuleLibrary::faults() const {
  return files_->faults();
}

const RegisteredModule& ModuleLibrary::find(PluginKind kind, const std::string& name, const SourcePlace& place) const {
  const std::string kind_text(name_of(kind));
  const ModuleEntry* entry = find_of(kind, name);
  if (entry != nullptr && serves_as(entry->module->kind, kind)) return *entry->module;
  if (entry == nullptr) entry = find_any(name);
  if (entry != nullptr)
    throw ConfigError(
        place, "\"" + name + "\" is a " + std::string(name_of(entry->module->kind)) + " plugin, not a " + kind_text);
  std::vector<std::string> names;
  for (const KnownModule& module : known())
    if (serves_as(module.kind, kind)) names.push_back(module.name);
  std::string sentence = "unknown " + kind_text + " plugin \"" + name + "\"" + did_you_mean(name, names) +
                         "; known are: " + (names.empty() ? "none" : joined(names));
  for (const std::string& fault : faults()) sentence += "\n  not loaded: " + fault;
  throw ConfigError(place, sentence);
}

std::shared_ptr<void> ModuleLibrary::make_any(PluginKind kind, const PluginChoice& choice,
                                              const ModuleContext& context) const {
  const RegisteredModule& module = find(kind, choice.name, choice.config.place);
  std::shared_ptr<void> made = module.make(choice.config, context);
  if (module.kind == kind) return made;
  // The contexts of all three kinds of planners are the same type.
  std::shared_ptr<Planner> planner;
  if (module.kind == PluginKind::path_planner)
    planner = std::make_shared<LonePathPlanner>(std::static_pointer_cast<PathPlanner>(made));
  else
    planner = std::make_shared<LoneRoutePlanner>(std::static_pointer_cast<RoutePlanner>(made));
  return planner;
}

bool serves_as(PluginKind found, PluginKind wanted) {
  if (wanted != PluginKind::planner) return found == wanted;
  return found == PluginKind::planner || found == PluginKind::path_planner || found == PluginKind::route_planner;
}

bool share_names(PluginKind a, PluginKind b) {
  return a == b || (serves_as(a, PluginKind::planner) && serves_as(b, PluginKind::planner));
}

std::vector<std::filesystem::path> module_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::filesystem::path installed_prefix() {
  Dl_info found{};
  static const char kHere = 0;
  if (dladdr(&kHere, &found) == 0 || found.dli_fname == nullptr) return {};
  return std::filesystem::weakly_canonical(found.dli_fname).parent_path().parent_path();
}

std::vector<std::filesystem::path> plugin_folders(const std::vector<std::filesystem::path>& given) {
  std::vector<std::filesystem::path> folders = given;
  if (const char* variable = std::getenv("CAIRN_PLUGIN_PATH")) {
    std::string rest = variable;
    while (!rest.empty()) {
      const std::size_t colon = rest.find(':');
      const std::string folder = rest.substr(0, colon);
      if (!folder.empty()) folders.emplace_back(folder);
      rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
  }
  folders.push_back(installed_prefix() / "lib" / "cairn");
  return folders;
}

}  // namespace cairn
