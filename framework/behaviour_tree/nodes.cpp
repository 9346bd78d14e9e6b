#include "framework/behaviour_tree/nodes.hpp"

#include <array>

namespace cairn {
namespace {

// In the order of NodeKind.
constexpr auto kNames = std::to_array<std::string_view>(
    {"sequence", "reactive_sequence", "fallback", "reactive_fallback", "parallel", "repeat", "retry", "timeout", "not",
     "force_success", "mission", "landmark_known", "explored", "time_before", "time_after", "at_place", "battery_above",
     "behaviour"});
static_assert(kNames.size() == static_cast<std::size_t>(NodeKind::behaviour) + 1);

template <class Settings>
void require_child(Fields<Settings>& fields, ConfigValue Settings::*child) {
  fields.raw("do", child, "node", "the node that it is about; a list is a sequence of its items").required = true;
}

std::vector<NodeType> all_types() {
  using K = NodeKind;
  using S = NodeShape;
  return {
      {K::sequence, S::nodes, "one child after the other until one fails; goes on where it was"},
      {K::reactive_sequence, S::nodes, "as sequence, but begins with its first child in every tick"},
      {K::fallback, S::nodes, "one child after the other until one succeeds; goes on where it was"},
      {K::reactive_fallback, S::nodes, "as fallback, but begins with its first child in every tick"},
      {K::parallel, S::settings_node, "all children in every tick", schema_of<ParallelSettings>()},
      {K::repeat, S::settings_node, "its child again each time that it succeeds", schema_of<RoundsSettings>()},
      {K::retry, S::settings_node, "its child again each time that it fails", schema_of<RoundsSettings>()},
      {K::timeout, S::settings_node, "its child, halted and failed when its time is up", schema_of<TimeoutSettings>()},
      {K::inverse, S::one_node, "success when its child fails, failure when it succeeds"},
      {K::force_success, S::one_node, "success when its child has ended, whatever has come of it"},
      {K::mission, S::settings, "the steps of another file, in order", schema_of<SubMissionSettings>()},
      {K::landmark_known, S::settings, "whether the map holds a landmark", schema_of<LandmarkKnownSettings>()},
      {K::explored, S::settings, "whether so much of the map is known; looked at once a second of the mission's clock",
       schema_of<ExploredSettings>()},
      {K::time_before, S::settings, "whether the mission's clock has not come to a time", schema_of<TimeSettings>()},
      {K::time_after, S::settings, "whether the mission's clock has come to a time", schema_of<TimeSettings>()},
      {K::at_place, S::settings, "whether the robot is near a landmark or place", schema_of<AtPlaceSettings>()},
      {K::battery_above, S::settings, "whether so much of the battery is left; never where that is not known",
       schema_of<BatterySettings>()},
  };
}

}  // namespace

std::string_view name_of(NodeKind kind) {
  return kNames[static_cast<std::size_t>(kind)];
}

bool is_condition(NodeKind kind) {
  return kind >= NodeKind::landmark_known && kind <= NodeKind::battery_above;
}

bool is_leaf(NodeKind kind) {
  return kind == NodeKind::behaviour || is_condition(kind);
}

const std::vector<NodeType>& node_types() {
  static const std::vector<NodeType> types = all_types();
  return types;
}

const NodeType* find_node_type(std::string_view name) {
  for (const NodeType& type : node_types())
    if (name_of(type.kind) == name) return &type;
  return nullptr;
}

std::vector<std::string> node_names() {
  std::vector<std::string> names;
  for (const NodeType& type : node_types()) names.emplace_back(name_of(type.kind));
  return names;
}

void ParallelSettings::describe(Fields<ParallelSettings>& fields) {
  using C = ParallelSettings;
  fields.raw("succeed_when", &C::succeed_when, "count", "so many children have succeeded: all, any or a number")
      .default_text = "all";
  fields.raw("fail_when", &C::fail_when, "count", "so many children have failed: any, all or a number").default_text =
      "any";
  fields.raw("do", &C::child, "nodes", "its children").required = true;
  fields.shorthand("do");
}

void RoundsSettings::describe(Fields<RoundsSettings>& fields) {
  fields.raw("times", &RoundsSettings::times, "rounds", "how often at most: a number from 1, or forever").required =
      true;
  require_child(fields, &RoundsSettings::child);
}

void TimeoutSettings::describe(Fields<TimeoutSettings>& fields) {
  fields
      .number("after_s", &TimeoutSettings::after_s, {0.001, 1e7}, "s",
              "the child fails when it has not ended after this, by the mission's clock")
      .required = true;
  require_child(fields, &TimeoutSettings::child);
}

void SubMissionSettings::describe(Fields<SubMissionSettings>& fields) {
  fields.file("file", &SubMissionSettings::file, "file with the steps").required = true;
  fields.raw("with", &SubMissionSettings::with, "map", "its parameters: `{name: value}`");
  fields.shorthand("file");
}

void LandmarkKnownSettings::describe(Fields<LandmarkKnownSettings>& fields) {
  fields
      .text("landmark", &LandmarkKnownSettings::landmark,
            "a landmark's id (L3) or name, a category, or `nearest CATEGORY`")
      .required = true;
  fields.shorthand("landmark");
}

void ExploredSettings::describe(Fields<ExploredSettings>& fields) {
  fields.number("at_least_ratio", &ExploredSettings::at_least_ratio, {0.0, 1.0}, "",
                "share of known cells in the smallest box around everything occupied, as `explore` counts it");
  fields.shorthand("at_least_ratio");
}

void TimeSettings::describe(Fields<TimeSettings>& fields) {
  fields.number("time_s", &TimeSettings::time_s, {0.0, 1e7}, "s", "of the mission's clock").required = true;
  fields.shorthand("time_s");
}

void AtPlaceSettings::describe(Fields<AtPlaceSettings>& fields) {
  using C = AtPlaceSettings;
  fields.text("landmark", &C::landmark, "a landmark's id (L3) or name, a category, or `nearest CATEGORY`");
  fields.point("at_m", &C::at_m, "m", "a place of the map");
  fields.number("within_m", &C::within_m, {0.0, 1e4}, "m",
                "from the robot's centre to the place, or to the middle of the landmark");
  fields.one_of({"landmark", "at_m"});
  fields.shorthand("landmark");
}

void BatterySettings::describe(Fields<BatterySettings>& fields) {
  fields.number("ratio", &BatterySettings::ratio, {0.0, 1.0}, "", "share of a full battery, more than which is left")
      .required = true;
  fields.shorthand("ratio");
}

void SubMissionFile::describe(Fields<SubMissionFile>& fields) {
  fields.raw("parameters", &SubMissionFile::parameters, "map",
             "names that the steps may use as `$name` in place of a value, each with its default; one without a "
             "default must be given");
  fields.raw("steps", &SubMissionFile::steps, "list of steps", "nodes one after the other").required = true;
}

}  // namespace cairn
