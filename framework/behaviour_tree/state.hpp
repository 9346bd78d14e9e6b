// What the nodes of a behaviour tree remember between two ticks, as data: a mission that was killed goes on with it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"

namespace cairn {

// Of a node under way that is not a leaf.
struct NodeState {
  std::string path{};              // as TreeNode::path
  std::size_t next = 0;            // of nodes with memory: the child to tick, from 0
  std::int64_t rounds = 0;         // of repeat and retry: that have ended
  double begun_s = 0.0;            // by the mission's clock
  std::string failures{};          // of fallback: of the children so far
  std::vector<Status> outcomes{};  // of parallel: of each child, running when it has not ended
  bool operator==(const NodeState&) const = default;
};

struct TreeState {
  std::vector<NodeState> running{};  // in the order of the file; none: the tree has not begun
  bool operator==(const TreeState&) const = default;
};

// One line of JSON.
[[nodiscard]] std::string text_of(const TreeState& state);
// Throws std::invalid_argument with what is wrong; whether it fits a tree is not asked.
[[nodiscard]] TreeState tree_state_of(const std::string& text);

}  // namespace cairn
