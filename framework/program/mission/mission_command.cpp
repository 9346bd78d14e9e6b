#include <fmt/format.h>

#include <atomic>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/behaviour_tree/tree_text.hpp"
#include "framework/mission/check.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/making_watch.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"
#include "maps/pictures/tree_picture.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

// Numbers and flags as such, all else as text.
ordered_json json_of(const ConfigValue& value) {
  if (value.kind == ConfigValue::Kind::null) return nullptr;
  if (value.kind == ConfigValue::Kind::scalar) {
    const ordered_json plain = ordered_json::parse(value.scalar, nullptr, false);
    return !value.quoted && (plain.is_number() || plain.is_boolean()) ? plain : ordered_json(value.scalar);
  }
  ordered_json out = value.kind == ConfigValue::Kind::list ? ordered_json::array() : ordered_json::object();
  for (const ConfigValue& item : value.items) out.push_back(json_of(item));
  for (const ConfigValue::Entry& entry : value.entries) out[entry.key] = json_of(entry.value);
  return out;
}

ordered_json json_of(const std::vector<TreeNode>& nodes) {
  ordered_json list = ordered_json::array();
  for (const TreeNode& node : nodes)
    list.push_back({{"path", node.path},
                    {"kind", node.choice.name},
                    {"name", node.name},
                    {"settings", json_of(node.choice.config)},
                    {"place", node.choice.config.place.text()},
                    {"children", json_of(node.children)}});
  return list;
}

BoxKind box_kind_of(NodeKind kind) {
  if (kind == NodeKind::behaviour) return BoxKind::action;
  if (is_condition(kind)) return BoxKind::question;
  const bool wraps = kind == NodeKind::repeat || kind == NodeKind::retry || kind == NodeKind::timeout ||
                     kind == NodeKind::inverse || kind == NodeKind::force_success;
  return wraps ? BoxKind::wrapper : BoxKind::branch;
}

std::vector<TreeBox> boxes_of(const std::vector<TreeNode>& nodes) {
  std::vector<TreeBox> boxes;
  for (const TreeNode& node : nodes) {
    const std::string name = node.name == node.choice.name ? "" : " \"" + node.name + "\"";
    boxes.push_back({node.choice.name + name, settings_text(node), box_kind_of(node.kind), boxes_of(node.children)});
  }
  return boxes;
}

std::string size_text(std::size_t steps, std::size_t nodes) {
  return counted(steps, "step") + ", " + counted(nodes, "node");
}

}  // namespace

int mission_check(const MissionCheckCommand& command, const CommonOptions& common) {
  const std::atomic<bool> is_cancelled = false;  // signals end this command at once
  const MakingWatch watch = watch_making(kMaxMaking_s, is_cancelled);
  const ModuleLibrary library = module_library(common);
  for (const std::string& fault : library.faults()) std::cerr << "not loaded: " << fault << "\n";
  ordered_json rows = ordered_json::array();
  bool all_fine = true;
  for (const std::filesystem::path& file : command.files) {
    const MissionCheck check = check_mission(file, command.overrides, library);
    const bool is_fine = check.errors.empty();
    all_fine = all_fine && is_fine;
    for (const std::string& error : check.errors) std::cerr << error << "\n";
    if (!common.json)
      std::cout << fmt::format(
          "{}: {}\n", file.string(),
          is_fine ? "fine, " + size_text(check.steps, check.nodes) : counted(check.errors.size(), "error"));
    rows.push_back({{"file", file.string()},
                    {"mission", check.mission},
                    {"outcome", is_fine ? "fine" : "errors"},
                    {"errors", check.errors},
                    {"steps", check.steps},
                    {"nodes", check.nodes}});
  }
  if (common.json) print_json({{"missions", rows}});
  return all_fine ? kExitDone : kExitBadInput;
}

int mission_show(const MissionShowCommand& command, const CommonOptions& common) {
  const Mission mission = load_mission(command.file, command.overrides);
  const std::string size = size_text(mission.steps.size(), count_nodes(mission.steps));
  if (!command.picture.empty())
    write_tree_picture(command.picture, {mission.config.mission, "", BoxKind::branch, boxes_of(mission.steps)},
                       "mission " + mission.config.mission, size);
  print({{"mission", mission.config.mission}, {"picture", command.picture.string()}, {"steps", json_of(mission.steps)}},
        fmt::format("mission {}: {}\n", mission.config.mission, size) + tree_text(mission.steps), common);
  return kExitDone;
}

}  // namespace cairn
