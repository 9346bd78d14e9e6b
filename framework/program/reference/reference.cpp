#include "framework/program/reference/reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "framework/experiments/experiment.hpp"
#include "framework/files/robot_file.hpp"
#include "framework/files/template_file.hpp"
#include "framework/files/world_file.hpp"
#include "framework/mission/mission.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

constexpr const char* kIntroduction = R"(# Configuration reference

Generated from the field descriptions that load the files (`make reference`); do not edit.

All files are YAML. A key that is not listed here is refused, with its place and the nearest known name. A key carries its unit (`_m`, `_s`, `_deg`, ...); angles are degrees, anticlockwise. A file or folder is taken relative to the file that names it, and `${NAME}` or `${NAME:-default}` in it reads the environment. A dot leads into a map (`limits.max_v_mps`), `[]` into the items of a list (`sonars[].x_m`).

**In an editor.** The same descriptions are JSON schemas in [config/schema](../config/schema). An editor with the YAML language server (VS Code: the extension *YAML* by Red Hat; Neovim, Emacs, Kate: `yaml-language-server`) completes keys, shows their meaning and marks slips once a file begins with the line that the shipped ones begin with:

    # yaml-language-server: $schema=../schema/mission.schema.json

The schemas in this folder know the shipped modules. With modules of your own, write a set that knows them too, and name that one:

    cairn --plugins my_modules plugins reference --schema-folder my_schemas
)";

std::string code(const std::string& text) {
  return "`" + text + "`";
}

std::string codes(const std::vector<std::string>& keys) {
  return "`" + joined(keys, "`, `") + "`";
}

// A bar would end the cell of the table.
std::string in_cell(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '|' ? "\\|" : std::string(1, c);
  return safe;
}

std::string range_text(const FieldSpec& field) {
  if (!field.choices.empty()) return codes(field.choices);
  const bool has_min = std::isfinite(field.range.min);
  const bool has_max = std::isfinite(field.range.max);
  const std::string min = config_detail::number_text(field.range.min);
  const std::string max = config_detail::number_text(field.range.max);
  if (has_min && has_max) return min + " to " + max;
  if (has_min) return "at least " + min;
  return has_max ? "at most " + max : "";
}

std::string type_text(const FieldSpec& field) {
  return field.type == "plugin" ? "[" + field.plugin_kind + "](#" + field.plugin_kind + ") module" : field.type;
}

std::string default_text(const FieldSpec& field) {
  if (field.required) return "**required**";
  return field.default_text.empty() ? "" : code(field.default_text);
}

std::string meaning_text(const FieldSpec& field) {
  std::string text = field.meaning;
  if (!field.shared.empty()) text += ": [" + field.shared + "](#" + field.shared + ")";
  if (!field.one_of.empty()) text += "; exactly one of " + codes(field.one_of);
  if (!field.shorthand.empty()) text += "; a bare value stands for " + code(field.shorthand);
  return text;
}

void add_rows(std::string& text, const std::vector<FieldSpec>& fields, const std::string& prefix) {
  for (const FieldSpec& field : fields) {
    text += "| " + code(prefix + field.key);
    for (const std::string& cell :
         {type_text(field), field.unit, range_text(field), default_text(field), meaning_text(field)})
      text += " | " + in_cell(cell);
    text += " |\n";
    if (!field.shared.empty()) continue;
    add_rows(text, field.fields, prefix + field.key + (field.type == "list of maps" ? "[]." : "."));
  }
}

std::string table_of(const std::vector<FieldSpec>& fields) {
  std::string text = "| key | type | unit | range | default | meaning |\n|---|---|---|---|---|---|\n";
  add_rows(text, fields, "");
  return text;
}

std::string table_of(const Schema& schema) {
  if (schema.fields.empty()) return "It has no settings.\n";
  std::string text = table_of(schema.fields);
  if (!schema.one_of.empty()) text += "\nExactly one of " + codes(schema.one_of) + " must be given.\n";
  return text;
}

// What a kind is for, in the words of the mission's own keys.
std::string about_kind(PluginKind kind) {
  const std::string name(name_of(kind));
  if (kind == PluginKind::behaviour) return "A step of a mission: " + code("- name: settings") + " under `steps`.";
  if (kind == PluginKind::path_planner)
    return "Plans paths on the grid: for a planner that names it, or alone as the mission's " + code("planner") + ".";
  if (kind == PluginKind::route_planner)
    return "Plans routes over the landmark graph: for a planner that names it, or alone as the mission's " +
           code("planner") + ".";
  if (kind == PluginKind::marker_detector)
    return "The mission's " + code("markers.detector") + ": finds printed markers in the robot's pictures.";
  for (const FieldSpec& field : schema_of<MissionConfig>().fields)
    if (field.plugin_kind == name) return "The mission's " + code(field.key) + ": " + field.meaning + ".";
  return "";
}

std::string section_of(const RegisteredModule& module) {
  std::string text = "\n#### " + module.name + "\n\n" + module.summary + "\n\n";
  if (!module.schema.shorthand.empty()) {
    text += "A bare value stands for " + code(module.schema.shorthand) + ": " + code(module.name + ": VALUE") + ".\n\n";
  }
  return text + table_of(module.schema);
}

std::string modules_section(const ModuleLibrary& library) {
  std::string text =
      "\n## Modules\n\nA module is chosen by `plugin: NAME`, its settings stand beside it. `cairn plugins` lists those "
      "that your program finds.\n";
  std::string heading;
  for (const ModuleEntry& entry : library.entries()) {
    const std::string kind(name_of(entry.module->kind));
    if (kind != heading) text += "\n### " + kind + "\n\n" + about_kind(entry.module->kind) + "\n";
    heading = kind;
    text += section_of(*entry.module);
  }
  return text;
}

// Groups of settings that several modules have, each once.
std::string shared_section(const ModuleLibrary& library) {
  std::map<std::string, FieldSpec> shared;
  for (const ModuleEntry& entry : library.entries())
    for (const FieldSpec& field : entry.module->schema.fields)
      if (!field.shared.empty()) shared.emplace(field.shared, field);
  std::string text;
  for (const auto& [name, field] : shared) {
    text += "\n### " + name + "\n\nSettings that several modules have, under " + code(field.key) + ".\n\n";
    text += table_of(field.fields);
  }
  return text;
}

std::string about_shape(const NodeType& type) {
  if (type.shape == NodeShape::nodes) return "It has a list of nodes.\n";
  return type.shape == NodeShape::one_node ? "It has one node; a list is a sequence of its items.\n"
                                           : table_of(type.schema);
}

std::string nodes_section() {
  std::string text =
      "\n## Nodes\n\nWhat the steps of missions and sub-missions are made of beside behaviours, each `- node: "
      "settings`; "
      "`name` beside it is what to call it. What they do: [missions.md](missions.md).\n";
  for (const NodeType& type : node_types()) {
    text += "\n#### " + std::string(name_of(type.kind)) + "\n\n" + type.about + "\n\n";
    if (!type.schema.shorthand.empty()) text += "A bare value stands for " + code(type.schema.shorthand) + ".\n\n";
    text += about_shape(type);
  }
  return text;
}

// In headings and links.
std::string called(const DescribedFile& file) {
  std::string name = file.name;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string contents(const ModuleLibrary& library) {
  std::string text = "\nFiles:";
  for (const DescribedFile& file : described_files()) text += " [" + called(file) + "](#" + called(file) + "-files)";
  text += " [nodes](#nodes)  \nModules:";
  std::set<std::string> listed;  // a name of several kinds: the first
  for (const ModuleEntry& entry : library.entries())
    if (listed.insert(entry.module->name).second) text += " [" + entry.module->name + "](#" + entry.module->name + ")";
  return text + "\n";
}

}  // namespace

std::vector<DescribedFile> described_files() {
  return {
      {"mission", "config/missions", "What a robot does, with which modules, and where.", schema_of<MissionConfig>()},
      {"sub_mission", "config/sub_missions", "Steps that missions run by the node `mission`, with parameters.",
       schema_of<SubMissionFile>()},
      {"robot", "config/robots", "A robot's body, limits and sonars, and how well it measures.", robot_file_schema()},
      {"world", "config/worlds", "The walls and things of a simulation.", world_file_schema()},
      {"template", "config/templates", "The shape of one category of landmarks.", template_file_schema()},
      {"experiment", "config/experiments",
       "Missions repeated in several variants and over many seeds, and what is measured of them.",
       schema_of<ExperimentConfig>()}};
}

std::string reference_markdown(const ModuleLibrary& library) {
  std::string text = kIntroduction + contents(library);
  for (const DescribedFile& file : described_files()) {
    std::string name = called(file);
    name.front() = static_cast<char>(name.front() - 'a' + 'A');
    text += "\n## " + name + " files\n\n" + file.about + " Shipped ones: [" + file.folder + "](../" + file.folder +
            ").\n\n" + table_of(file.schema);
    if (file.name == "mission") text += modules_section(library) + shared_section(library) + nodes_section();
  }
  return text;
}

}  // namespace cairn
