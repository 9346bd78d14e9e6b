// Places that behaviours hand to later ones by name: the `output` of one step is the `input` of another.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/behaviour_tree/tree.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/modules/module_library.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

using NamedValues = std::map<std::string, Place>;

inline constexpr std::size_t kMaxNamedValues = 1000;

// Stored in a saved map's properties, as a line of JSON; nothing is written of none.
void add_named_values(SavedMap& map, const NamedValues& values);
// Throws StoreError, without the map's name, when what the map says is damaged.
[[nodiscard]] NamedValues saved_named_values(const SavedMap& map);

// Inputs that no step before gives, each with its place and the nearest name that one gives. Which settings of a
// behaviour name inputs and outputs its module says (Fields::input, Fields::output).
[[nodiscard]] std::vector<ConfigError> missing_inputs(const std::vector<TreeNode>& steps, const ModuleLibrary& library);

}  // namespace cairn
