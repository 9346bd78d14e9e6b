// Outcomes of trials kept between runs: a module file that was tried before costs its checksum.
#pragma once

#include <filesystem>
#include <memory>

#include "framework/modules/trial/module_trial.hpp"

namespace cairn {

// Remembers that a file is good, or that it crashed, hung or ended its process, by its checksum and the version of this
// library. All other faults are cheap to find again, and may go away by themselves (a library that is missing).
class CachedTrial : public ModuleTrial {
 public:
  // An empty folder: remembers nothing. A file there that is broken, or cannot be read or written, counts as not there.
  CachedTrial(std::unique_ptr<const ModuleTrial> trial, std::filesystem::path folder)
      : trial_(std::move(trial)), folder_(std::move(folder)) {}
  [[nodiscard]] TrialOutcome outcome_of(const std::filesystem::path& file) const override;
  [[nodiscard]] TrialOutcome try_again(const std::filesystem::path& file) const override;

 private:
  std::unique_ptr<const ModuleTrial> trial_;
  std::filesystem::path folder_;
};

// CAIRN_MODULE_CACHE, or `modules` in the cache folder (cache_folder.hpp).
[[nodiscard]] std::filesystem::path module_cache_folder();

// In a child process of that program (ChildTrial), remembered in that folder. Its time limit is kModuleTrialLimit or
// CAIRN_MODULE_TRIAL_S, for machines that are slower than any, and for sanitizers.
[[nodiscard]] std::shared_ptr<const ModuleTrial> remembered_child_trial(const std::filesystem::path& program);

}  // namespace cairn
