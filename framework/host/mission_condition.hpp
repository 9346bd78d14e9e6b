// Conditions of a behaviour tree over the world as the mission knows it.
#pragma once

#include <limits>

#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/world_view.hpp"
#include "framework/host/mission_tree.hpp"

namespace cairn {

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
