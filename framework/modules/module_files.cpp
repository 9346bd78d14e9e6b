#include "framework/modules/module_files.hpp"

#include <algorithm>
#include <iterator>

#include "maps/base/in_parallel.hpp"
#include "maps/base/printable.hpp"

namespace cairn {
namespace {

// A folder that does not exist, or cannot be read, is one more fault.
std::vector<std::filesystem::path> files_of(const std::vector<std::filesystem::path>& folders,
                                            std::vector<std::string>& faults) {
  std::vector<std::filesystem::path> files;
  for (const auto& folder : folders) {
    try {
      const std::vector<std::filesystem::path> found = module_files(folder);
      files.insert(files.end(), found.begin(), found.end());
    } catch (const std::filesystem::filesystem_error& error) {
      faults.push_back(folder.string() + (std::filesystem::is_directory(folder)
                                              ? ": the plugin folder cannot be read: " + error.code().message()
                                              : ": no such plugin folder"));
    }
  }
  return files;
}

std::vector<ModuleSummary> summaries_of(const LoadedPlugin& plugin) {
  std::vector<ModuleSummary> summaries;
  for (const RegisteredModule& module : plugin.modules) summaries.push_back({module.kind, module.name, module.summary});
  return summaries;
}

std::vector<TrialOutcome> outcomes_of(const std::vector<std::filesystem::path>& files, const ModuleTrial& trial) {
  std::vector<TrialOutcome> outcomes(files.size());
  in_parallel(files.size(), [&](std::size_t i) { outcomes[i] = trial.outcome_of(files[i]); });
  return outcomes;
}

}  // namespace

void ModuleLibrary::Files::add_folders(const std::vector<std::filesystem::path>& folders) {
  const std::vector<std::filesystem::path> files = files_of(folders, faults_);
  if (trial_) {
    const std::vector<TrialOutcome> outcomes = outcomes_of(files, *trial_);
    for (std::size_t i = 0; i < files.size(); ++i) adopt(files[i], outcomes[i]);
    return;
  }
  for (const auto& file : files) {
    try {
      adopt(std::make_unique<LoadedPlugin>(load_plugin(file)));
    } catch (const PluginError& error) {
      faults_.emplace_back(error.what());
    }
  }
}

void ModuleLibrary::Files::add(LoadedPlugin plugin) {
  const std::lock_guard lock(mutex_);
  adopt(std::make_unique<LoadedPlugin>(std::move(plugin)));
}

void ModuleLibrary::Files::adopt(const std::filesystem::path& file, const TrialOutcome& outcome) {
  if (!outcome.fault.empty()) {
    faults_.push_back(file.string() + ": " + outcome.fault);
    if (outcome.is_fatal && outcome.is_remembered) fatal_before_.push_back(file);
    return;
  }
  add_modules(files_.emplace_back(File{file, nullptr, false}), outcome.modules);
}

void ModuleLibrary::Files::adopt(std::unique_ptr<LoadedPlugin> plugin) {
  const std::vector<ModuleSummary> modules = summaries_of(*plugin);
  File& file = files_.emplace_back(File{plugin->file, nullptr, false});
  file.plugin = std::move(plugin);
  add_modules(file, modules);
  connect(file);
}

void ModuleLibrary::Files::add_modules(File& file, const std::vector<ModuleSummary>& modules) {
  for (const ModuleSummary& module : modules) {
    if (const Module* taken = find(module.name, module.kind))
      faults_.push_back(file.file.string() + ": the name \"" + printable_excerpt(module.name) + "\" is taken by " +
                        taken->file->file.string());
    else
      modules_.push_back({module, &file, {}});
  }
}

ModuleLibrary::Files::Module* ModuleLibrary::Files::find(const std::string& name, std::optional<PluginKind> kind) {
  const auto found = std::ranges::find_if(modules_, [&](const Module& module) {
    return module.summary.name == name && (!kind || share_names(module.summary.kind, *kind));
  });
  return found == modules_.end() ? nullptr : &*found;
}

std::vector<KnownModule> ModuleLibrary::Files::known() {
  const std::lock_guard lock(mutex_);
  std::vector<KnownModule> known;
  for (const Module& module : modules_)
    if (!module.file->has_failed) known.push_back({module.summary, module.file->file});
  std::sort(known.begin(), known.end(), [](const KnownModule& a, const KnownModule& b) {
    const auto rank = [](PluginKind kind) { return std::find(std::begin(kPluginKinds), std::end(kPluginKinds), kind); };
    return std::pair(rank(a.kind), a.name) < std::pair(rank(b.kind), b.name);
  });
  return known;
}

std::vector<std::string> ModuleLibrary::Files::faults() {
  const std::lock_guard lock(mutex_);
  return faults_;
}

// Not for a file that failed in the trial: its code runs in this process.
void ModuleLibrary::Files::open(File& file) {
  try {
    file.plugin = std::make_unique<LoadedPlugin>(load_plugin(file.file));
    connect(file);
  } catch (const PluginError& error) {
    file.has_failed = true;
    faults_.emplace_back(error.what());
  }
}

void ModuleLibrary::Files::connect(File& file) {
  for (Module& module : modules_) {
    if (module.file != &file) continue;
    const auto found = std::ranges::find_if(file.plugin->modules, [&](const RegisteredModule& registered) {
      return registered.name == module.summary.name && registered.kind == module.summary.kind;
    });
    if (found != file.plugin->modules.end())
      module.entry = {&*found, file.plugin.get()};
    else
      faults_.push_back(file.file.string() + ": does not register \"" + printable_excerpt(module.summary.name) +
                        "\" any more, as it did in its trial");
  }
}

const ModuleEntry* ModuleLibrary::Files::opened(const std::string& name, std::optional<PluginKind> kind) {
  const std::lock_guard lock(mutex_);
  const Module* module = find(name, kind);
  if (module == nullptr) return nullptr;
  if (!module->file->plugin && !module->file->has_failed) open(*module->file);
  return module->entry.module == nullptr ? nullptr : &module->entry;
}

bool ModuleLibrary::Files::try_fatal_again() {
  const std::lock_guard lock(mutex_);
  if (fatal_before_.empty()) return false;
  const std::vector<std::filesystem::path> files = std::exchange(fatal_before_, {});
  std::vector<TrialOutcome> outcomes(files.size());
  in_parallel(files.size(), [&](std::size_t i) { outcomes[i] = trial_->try_again(files[i]); });
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::erase_if(faults_, [&](const std::string& fault) { return fault.starts_with(files[i].string() + ": "); });
    adopt(files[i], outcomes[i]);
  }
  return true;
}

}  // namespace cairn
