#include "framework/program/common/modules.hpp"

#include <chrono>
#include <cmath>
#include <cstdlib>

#include "framework/modules/trial/cached_trial.hpp"
#include "framework/modules/trial/child_trial.hpp"
#include "maps/base/text.hpp"

namespace cairn {

namespace {

// CAIRN_MODULE_TRIAL_S, for machines that are slower than any, and for sanitizers.
std::chrono::milliseconds trial_limit() {
  const char* const chosen = std::getenv("CAIRN_MODULE_TRIAL_S");
  const auto limit_s = number_from<double>(chosen == nullptr ? "" : chosen);
  if (!limit_s || !(*limit_s >= 0.1 && *limit_s <= 3600.0)) return kModuleTrialLimit;
  return std::chrono::milliseconds(std::llround(1e3 * *limit_s));
}

}  // namespace

std::shared_ptr<const ModuleTrial> module_trial() {
  // This very program, also when its file has been replaced since it was started.
  return std::make_shared<CachedTrial>(std::make_unique<ChildTrial>("/proc/self/exe", trial_limit()),
                                       module_cache_folder());
}

ModuleLibrary module_library(const CommonOptions& common) {
  return ModuleLibrary(plugin_folders(common.plugin_folders), module_trial());
}

}  // namespace cairn
