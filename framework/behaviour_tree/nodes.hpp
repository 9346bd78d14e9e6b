// The nodes that a mission's steps are made of beside behaviours: what each is called, what it is for and which
// settings it has. From this one list come the reader, `cairn mission show`, the reference and the schema.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/fields.hpp"

namespace cairn {

// docs/missions.md says what they do; behaviours are modules, all others are the host's own.
enum class NodeKind : std::uint8_t {
  sequence,
  reactive_sequence,
  fallback,
  reactive_fallback,
  parallel,
  repeat,
  retry,
  timeout,
  inverse,
  force_success,
  mission,
  landmark_known,
  explored,
  time_before,
  time_after,
  at_place,
  battery_above,
  behaviour
};
// As files write it: "not" for inverse.
[[nodiscard]] std::string_view name_of(NodeKind kind);
[[nodiscard]] bool is_condition(NodeKind kind);
// A behaviour or a condition.
[[nodiscard]] bool is_leaf(NodeKind kind);

// What stands behind the name in a file.
enum class NodeShape : std::uint8_t {
  nodes,         // a list of nodes
  one_node,      // a node; a list is a sequence of its items
  settings,      // settings alone
  settings_node  // settings, and one node under `do`
};

struct NodeType {
  NodeKind kind = NodeKind::behaviour;
  NodeShape shape = NodeShape::settings;
  std::string about;  // one line for people
  Schema schema{};    // of the settings; with `do`
};
// All but behaviours, in the order of the reference.
[[nodiscard]] const std::vector<NodeType>& node_types();
// Null when no node is called that.
[[nodiscard]] const NodeType* find_node_type(std::string_view name);
[[nodiscard]] std::vector<std::string> node_names();

struct ParallelSettings {
  ConfigValue succeed_when;  // all, any or a number
  ConfigValue fail_when;
  ConfigValue child;  // a list
  static void describe(Fields<ParallelSettings>& fields);
};

// Of repeat and retry.
struct RoundsSettings {
  ConfigValue times;  // a number or `forever`
  ConfigValue child;
  static void describe(Fields<RoundsSettings>& fields);
};

struct TimeoutSettings {
  double after_s = 0.0;
  ConfigValue child;
  static void describe(Fields<TimeoutSettings>& fields);
};

struct SubMissionSettings {
  std::filesystem::path file;
  ConfigValue with;  // a map of parameters
  static void describe(Fields<SubMissionSettings>& fields);
};

struct LandmarkKnownSettings {
  std::string landmark;
  static void describe(Fields<LandmarkKnownSettings>& fields);
};

struct ExploredSettings {
  double at_least_ratio = 0.95;
  static void describe(Fields<ExploredSettings>& fields);
};

struct TimeSettings {
  double time_s = 0.0;
  static void describe(Fields<TimeSettings>& fields);
};

struct AtPlaceSettings {
  std::string landmark;
  std::optional<Point> at_m;
  double within_m = 1.0;
  static void describe(Fields<AtPlaceSettings>& fields);
};

struct BatterySettings {
  double ratio = 0.0;
  static void describe(Fields<BatterySettings>& fields);
};

// A file that the node `mission` names.
struct SubMissionFile {
  ConfigValue parameters;  // a map: name, and its default or nothing
  ConfigValue steps;
  static void describe(Fields<SubMissionFile>& fields);
};

}  // namespace cairn
