#include "framework/modules/module_library.hpp"

#include <algorithm>
#include <cstdlib>

#include "framework/contracts/adapters/lone_planners.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

std::vector<std::filesystem::path> module_files(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

ModuleLibrary::ModuleLibrary(const std::vector<std::filesystem::path>& folders) {
  for (const auto& folder : folders) {
    if (!std::filesystem::is_directory(folder)) {
      faults_.push_back(folder.string() + ": no such plugin folder");
      continue;
    }
    for (const auto& file : module_files(folder)) {
      try {
        adopt(std::make_unique<LoadedPlugin>(load_plugin(file)));
      } catch (const PluginError& error) {
        faults_.emplace_back(error.what());
      }
    }
  }
}

void ModuleLibrary::add(const std::string& origin, const Registrar& registrar) {
  auto plugin = std::make_unique<LoadedPlugin>();
  plugin->file = origin;
  plugin->stamp = this_abi_stamp();
  plugin->modules = registrar.modules();
  adopt(std::move(plugin));
}

void ModuleLibrary::adopt(std::unique_ptr<LoadedPlugin> plugin) {
  for (const RegisteredModule& module : plugin->modules) {
    const ModuleEntry* taken = find_any(module.name);
    if (taken != nullptr)
      faults_.push_back(plugin->file.string() + ": the name \"" + module.name + "\" is taken by " +
                        taken->plugin->file.string());
    else
      entries_.push_back({&module, plugin.get()});
  }
  plugins_.push_back(std::move(plugin));
}

std::vector<ModuleEntry> ModuleLibrary::entries() const {
  std::vector<ModuleEntry> sorted = entries_;
  std::sort(sorted.begin(), sorted.end(), [](const ModuleEntry& a, const ModuleEntry& b) {
    const auto rank = [](PluginKind kind) { return std::find(std::begin(kPluginKinds), std::end(kPluginKinds), kind); };
    return std::pair(rank(a.module->kind), a.module->name) < std::pair(rank(b.module->kind), b.module->name);
  });
  return sorted;
}

const ModuleEntry* ModuleLibrary::find_any(const std::string& name) const {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const ModuleEntry& e) { return e.module->name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

const RegisteredModule& ModuleLibrary::find(PluginKind kind, const std::string& name, const SourcePlace& place) const {
  const std::string kind_text(name_of(kind));
  std::vector<std::string> names;
  for (const ModuleEntry& entry : entries())
    if (serves_as(entry.module->kind, kind)) names.push_back(entry.module->name);
  const ModuleEntry* entry = find_any(name);
  if (entry != nullptr && serves_as(entry->module->kind, kind)) return *entry->module;
  if (entry != nullptr)
    throw ConfigError(
        place, "\"" + name + "\" is a " + std::string(name_of(entry->module->kind)) + " plugin, not a " + kind_text);
  std::string sentence = "unknown " + kind_text + " plugin \"" + name + "\"" + did_you_mean(name, names) +
                         "; known are: " + (names.empty() ? "none" : joined(names));
  for (const std::string& fault : faults_) sentence += "\n  not loaded: " + fault;
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
  const auto program = std::filesystem::read_symlink("/proc/self/exe");
  folders.push_back(program.parent_path().parent_path() / "lib" / "cairn");
  return folders;
}

}  // namespace cairn
