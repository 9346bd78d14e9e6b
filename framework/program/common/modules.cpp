#include "framework/program/common/modules.hpp"

#include "framework/modules/trial/cached_trial.hpp"

namespace cairn {

std::shared_ptr<const ModuleTrial> module_trial() {
  // This very program, also when its file has been replaced since it was started.
  return remembered_child_trial("/proc/self/exe");
}

ModuleLibrary module_library(const CommonOptions& common) {
  return ModuleLibrary(plugin_folders(common.plugin_folders), module_trial());
}

}  // namespace cairn
