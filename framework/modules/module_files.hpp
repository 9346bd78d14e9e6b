// The files of a ModuleLibrary: which modules each has, and which are open.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "framework/modules/module_library.hpp"

namespace cairn {

class ModuleLibrary::Files {
 public:
  explicit Files(std::shared_ptr<const ModuleTrial> trial) : trial_(std::move(trial)) {}

  void add_folders(const std::vector<std::filesystem::path>& folders);
  void add(LoadedPlugin plugin);

  // All of these from any thread.
  [[nodiscard]] std::vector<KnownModule> known();
  [[nodiscard]] std::vector<std::string> faults();
  // Opens its file. Null: no such module, or the file cannot be opened. What is returned stays where it is. Without a
  // kind: the first one of that name.
  [[nodiscard]] const ModuleEntry* opened(const std::string& name, std::optional<PluginKind> kind = std::nullopt);
  // The files that were fatal in an earlier trial, once. True: some module may have come.
  [[nodiscard]] bool try_fatal_again();

 private:
  struct File {
    std::filesystem::path file;
    std::unique_ptr<LoadedPlugin> plugin;  // when it is open
    bool has_failed = false;               // when it was opened
  };
  struct Module {
    ModuleSummary summary;
    File* file = nullptr;
    ModuleEntry entry;  // when the file is open
  };

  void adopt(const std::filesystem::path& file, const TrialOutcome& outcome);
  void adopt(std::unique_ptr<LoadedPlugin> plugin);
  void add_modules(File& file, const std::vector<ModuleSummary>& modules);
  void open(File& file);
  void connect(File& file);
  [[nodiscard]] Module* find(const std::string& name, std::optional<PluginKind> kind);

  std::shared_ptr<const ModuleTrial> trial_;
  std::mutex mutex_;
  std::deque<File> files_;      // neither is moved when it grows
  std::deque<Module> modules_;  // no name twice among kinds that share their names
  std::vector<std::string> faults_;
  std::vector<std::filesystem::path> fatal_before_;
};

}  // namespace cairn
