// The steps of a mission as a tree of nodes, read from its files and checked: data, not yet built.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/behaviour_tree/nodes.hpp"
#include "framework/config/config_value.hpp"
#include "framework/config/fields.hpp"

namespace cairn {

struct Condition {
  std::string landmark{};       // of landmark_known and at_place
  std::optional<Point> at_m{};  // of at_place, instead of the landmark
  double number = 0.0;          // ratio of explored or of the battery, time in s, distance in m
};

struct TreeNode {
  NodeKind kind = NodeKind::behaviour;
  std::string name{};     // for people: its `name`, otherwise what the file calls it
  PluginChoice choice{};  // what the file calls it, with its settings but not its children; of a behaviour the module
  SourcePlace place{};    // where that stands
  std::string path{};     // the step's number, then a child's number each, all from 1: "3", "3/1/2"
  std::vector<TreeNode> children{};
  Condition condition{};       // of a condition
  int times = 0;               // of repeat and retry; 0: for ever
  double after_s = 0.0;        // of timeout
  std::size_t succeed_at = 0;  // of parallel: when so many children have succeeded
  std::size_t fail_at = 0;     // of parallel: when so many have failed
};

struct MissionTree {
  std::vector<TreeNode> steps;      // without what is wrong
  std::vector<ConfigError> errors;  // in the order of the files
};

inline constexpr std::size_t kMaxTreeDepth = 64;     // nodes on the path from a step to a leaf
inline constexpr std::size_t kMaxTreeNodes = 10000;  // of a mission with all its sub-missions

// steps: the list of the mission's file, or a value without a place where it has none. Reads sub-missions, too. Errors:
// unknown settings, wrong types, wrong numbers of children, parameters that do not fit, a sub-mission that runs itself,
// and nodes that are never reached. Whether there is such a behaviour, only the modules know.
[[nodiscard]] MissionTree read_mission_tree(const ConfigValue& steps, const std::filesystem::path& file);

// The behaviours of a tree in the order of its file. The pointers are into the steps.
[[nodiscard]] std::vector<const TreeNode*> behaviours_of(const std::vector<TreeNode>& steps);
[[nodiscard]] std::size_t count_nodes(const std::vector<TreeNode>& steps);

// Nodes that are certain never to be ticked: behind one that cannot succeed (in a sequence) or cannot fail (in a
// fallback).
[[nodiscard]] std::vector<ConfigError> unreachable_nodes(const std::vector<TreeNode>& steps);

}  // namespace cairn
