// Conditions of a behaviour tree over the world as the mission knows it.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "framework/behaviour_tree/tree.hpp"
#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/world_view.hpp"

namespace cairn {

// What is wrong with conditions that name `nearest CATEGORY`, when the mission can find landmarks of these categories
// only (no categories: not known, so nothing is wrong), and with those that name a tag that no family has.
[[nodiscard]] std::vector<ConfigError> unknown_categories(const std::vector<TreeNode>& steps,
                                                          const std::vector<std::string>& categories);

class ConditionCheck {
 public:
  // Success or failure, with its reason. node: a condition.
  Status operator()(const TreeNode& node, const WorldView& world);

 private:
  // Counting it costs as much as the map is large: once a second.
  double explored_ratio(const WorldView& world);

  double counted_s_ = -std::numeric_limits<double>::infinity();
  double ratio_ = 0.0;
};

}  // namespace cairn
