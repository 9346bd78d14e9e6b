// A module's settings as `cairn plugins info` lists them.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/registrar.hpp"

namespace cairn {

// Two lines a field. all: with what stands in groups; otherwise a group says how many settings it has.
[[nodiscard]] std::string settings_text(const std::vector<FieldSpec>& fields, bool all);

// The fields of a group named by its keys, "driving.look"; all of the module's when the name is empty. Throws
// std::runtime_error, with the nearest known group, when the module has no such group.
[[nodiscard]] const std::vector<FieldSpec>& group_of(const RegisteredModule& module, const std::string& group);

}  // namespace cairn
