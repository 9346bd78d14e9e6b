#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>

#include "framework/modules/module_library.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

std::string allowed_text(const FieldSpec& field) {
  if (!field.choices.empty()) return joined(field.choices, " | ");
  const bool low = std::isfinite(field.range.min);
  const bool high = std::isfinite(field.range.max);
  if (low && high) return fmt::format("{:g} .. {:g}", field.range.min, field.range.max);
  if (low) return fmt::format(">= {:g}", field.range.min);
  return high ? fmt::format("<= {:g}", field.range.max) : "";
}

void print_fields(const std::vector<FieldSpec>& fields, const std::string& indent) {
  for (const FieldSpec& field : fields) {
    std::string about = field.type;
    if (!field.unit.empty()) about += ", " + field.unit;
    if (const std::string allowed = allowed_text(field); !allowed.empty()) about += ", " + allowed;
    if (field.required)
      about += ", required";
    else if (!field.default_text.empty())
      about += ", default " + field.default_text;
    std::cout << indent << field.key << "  (" << about << ")\n" << indent << "    " << field.meaning << "\n";
    print_fields(field.fields, indent + "    ");
  }
}

ordered_json json_of(const std::vector<FieldSpec>& fields) {
  ordered_json list = ordered_json::array();
  for (const FieldSpec& field : fields) {
    ordered_json item = {{"key", field.key}, {"type", field.type}, {"meaning", field.meaning}};
    if (!field.unit.empty()) item["unit"] = field.unit;
    if (std::isfinite(field.range.min)) item["min"] = field.range.min;
    if (std::isfinite(field.range.max)) item["max"] = field.range.max;
    if (!field.choices.empty()) item["choices"] = field.choices;
    if (!field.default_text.empty()) item["default"] = field.default_text;
    item["required"] = field.required;
    if (!field.fields.empty()) item["fields"] = json_of(field.fields);
    list.push_back(std::move(item));
  }
  return list;
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

// What is wrong with a module that loads: its names, and those that other modules have already.
std::vector<std::string> faults_of(const LoadedPlugin& plugin, const std::vector<std::filesystem::path>& folders) {
  std::vector<std::string> faults;
  if (plugin.modules.empty()) faults.emplace_back("it registers nothing");
  const ModuleLibrary others(folders);
  std::set<std::string> own;
  for (const RegisteredModule& module : plugin.modules) {
    if (!is_plain_name(module.name))
      faults.push_back("the name \"" + module.name + "\" is not of lower-case letters, digits and _");
    if (module.summary.empty()) faults.push_back(module.name + " has no one-line description");
    if (!own.insert(module.name).second) faults.push_back("it registers the name \"" + module.name + "\" twice");
    const ModuleEntry* other = others.find_any(module.name);
    if (other != nullptr && !std::filesystem::equivalent(other->plugin->file, plugin.file))
      faults.push_back("the name \"" + module.name + "\" is taken by " + other->plugin->file.string());
  }
  return faults;
}

}  // namespace

int plugins_list(const CommonOptions& common) {
  const ModuleLibrary library(plugin_folders(common.plugin_folders));
  ordered_json list = ordered_json::array();
  for (const ModuleEntry& entry : library.entries()) {
    const std::string kind(name_of(entry.module->kind));
    const std::string file = entry.plugin->file.filename().string();
    if (common.json)
      list.push_back({{"kind", kind},
                      {"name", entry.module->name},
                      {"module", file},
                      {"version", std::string(entry.plugin->stamp.cairn_version)},
                      {"summary", entry.module->summary}});
    else
      std::cout << fmt::format("{:<13} {:<18} {:<22} {:<8} {}\n", kind, entry.module->name, file,
                               std::string(entry.plugin->stamp.cairn_version), entry.module->summary);
  }
  if (common.json) print_json({{"modules", list}, {"faults", library.faults()}});
  for (const std::string& fault : library.faults()) std::cerr << "not loaded: " << fault << "\n";
  return library.faults().empty() ? kExitDone : kExitNotSolved;
}

int plugins_check(const PluginsCommand& command, const CommonOptions& common) {
  ordered_json answer = {{"file", command.file.string()}, {"stamp", ""}, {"modules", ordered_json::array()}};
  std::vector<std::string> faults;
  std::string text;
  try {
    const LoadedPlugin plugin = load_plugin(command.file);
    answer["stamp"] = text_of(plugin.stamp);
    text = "symbols   cairn_abi_stamp, cairn_register_module\nstamp     " + text_of(plugin.stamp) + "\n";
    for (const RegisteredModule& module : plugin.modules) {
      const std::string kind(name_of(module.kind));
      text += fmt::format("registers {} {}: {}\n", kind, module.name, module.summary);
      answer["modules"].push_back({{"kind", kind}, {"name", module.name}, {"summary", module.summary}});
    }
    faults = faults_of(plugin, plugin_folders(common.plugin_folders));
  } catch (const PluginError& error) {
    faults.emplace_back(error.what());
  }
  answer["faults"] = faults;
  if (common.json) print_json(answer);
  std::ostream& people = common.json ? std::cerr : std::cout;
  people << text;
  for (const std::string& fault : faults) people << "wrong     " << fault << "\n";
  if (faults.empty()) people << "usable\n";
  return faults.empty() ? kExitDone : kExitNotSolved;
}

int plugins_info(const PluginsCommand& command, const CommonOptions& common) {
  const std::string& name = command.name;
  const ModuleLibrary library(plugin_folders(common.plugin_folders));
  const ModuleEntry* entry = library.find_any(name);
  if (entry == nullptr) {
    std::vector<std::string> names;
    for (const ModuleEntry& known : library.entries()) names.push_back(known.module->name);
    throw std::runtime_error("no module \"" + name + "\"" + did_you_mean(name, names) + "; `cairn plugins` lists them");
  }
  const RegisteredModule& module = *entry->module;
  if (common.json) {
    print_json({{"kind", std::string(name_of(module.kind))},
                {"name", module.name},
                {"summary", module.summary},
                {"file", entry->plugin->file.string()},
                {"fields", json_of(module.schema.fields)}});
    return kExitDone;
  }
  std::cout << module.name << ": " << name_of(module.kind) << "\n"
            << module.summary << "\nfrom " << entry->plugin->file.string() << "\n";
  if (!module.schema.shorthand.empty()) std::cout << "a bare value stands for `" << module.schema.shorthand << "`\n";
  std::cout << "\n";
  print_fields(module.schema.fields, "  ");
  return kExitDone;
}

}  // namespace cairn
