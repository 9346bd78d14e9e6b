// The modules as every command has them: each file is tried in a child process before this one opens it.
#pragma once

#include <memory>

#include "framework/modules/module_library.hpp"
#include "framework/program/common/commands.hpp"

namespace cairn {

[[nodiscard]] std::shared_ptr<const ModuleTrial> module_trial();
[[nodiscard]] ModuleLibrary module_library(const CommonOptions& common);

}  // namespace cairn
