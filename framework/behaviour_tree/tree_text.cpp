#include "framework/behaviour_tree/tree_text.hpp"

#include <algorithm>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

std::string entries_text(const ConfigValue& map);

std::string value_text(const ConfigValue& value) {
  switch (value.kind) {
    case ConfigValue::Kind::null:
      return "";
    case ConfigValue::Kind::scalar:
      return value.quoted ? in_quotes(value.scalar) : value.scalar;
    case ConfigValue::Kind::map:
      return "{" + entries_text(value) + "}";
    case ConfigValue::Kind::list:
      break;
  }
  std::vector<std::string> items;
  for (const ConfigValue& item : value.items) items.push_back(value_text(item));
  return "[" + joined(items) + "]";
}

std::string entries_text(const ConfigValue& map) {
  std::vector<std::string> entries;
  for (const ConfigValue::Entry& entry : map.entries) entries.push_back(entry.key + ": " + value_text(entry.value));
  return joined(entries);
}

struct Line {
  std::string path;
  std::string node;
  std::string settings;
};

void add_lines(const std::vector<TreeNode>& nodes, std::size_t depth, std::vector<Line>& lines) {
  for (const TreeNode& node : nodes) {
    const bool is_named = node.name != node.choice.name;
    lines.push_back({node.path,
                     std::string(2 * depth, ' ') + node.choice.name + (is_named ? " " + in_quotes(node.name) : ""),
                     settings_text(node)});
    add_lines(node.children, depth + 1, lines);
  }
}

std::string padded(const std::string& text, std::size_t width) {
  return text + std::string(width - std::min(width, text.size()), ' ');
}

}  // namespace

std::string settings_text(const TreeNode& node) {
  const ConfigValue& config = node.choice.config;
  return config.kind == ConfigValue::Kind::map ? entries_text(config) : value_text(config);
}

std::string tree_text(const std::vector<TreeNode>& steps) {
  std::vector<Line> lines;
  add_lines(steps, 0, lines);
  std::size_t path_width = 0;
  std::size_t node_width = 0;
  for (const Line& line : lines) {
    path_width = std::max(path_width, line.path.size());
    node_width = std::max(node_width, line.node.size());
  }
  std::string text;
  for (const Line& line : lines) {
    const std::string head = padded(line.path, path_width) + "  ";
    text += head + (line.settings.empty() ? line.node : padded(line.node, node_width) + "  " + line.settings) + "\n";
  }
  return text;
}

}  // namespace cairn
