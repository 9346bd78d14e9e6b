// A behaviour tree for people.
#pragma once

#include <string>
#include <vector>

#include "framework/behaviour_tree/tree.hpp"

namespace cairn {

// Its settings on one line, as YAML; empty when it has none: "until_known_ratio: 0.9, at_most_s: 300".
[[nodiscard]] std::string settings_text(const TreeNode& node);

// A line a node, children further in:
//   1      explore           until_known_ratio: 0.9
//   2      retry             times: 3
//   2/1      goto            landmark: nearest square
[[nodiscard]] std::string tree_text(const std::vector<TreeNode>& steps);

}  // namespace cairn
