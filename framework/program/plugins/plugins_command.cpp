#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "framework/program/plugins/settings_text.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

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

std::string first_group(const std::vector<FieldSpec>& fields) {
  const auto group = std::ranges::find_if(fields, [](const FieldSpec& field) { return !field.fields.empty(); });
  return group == fields.end() ? "" : group->key;
}

// All of that name: one a kind at most. Throws std::runtime_error: none.
std::vector<ModuleEntry> entries_of(const ModuleLibrary& library, const std::string& name) {
  std::vector<ModuleEntry> entries;
  if (const ModuleEntry* first = library.find_any(name)) entries.push_back(*first);
  std::vector<std::string> names;
  for (const KnownModule& known : library.known()) {
    names.push_back(known.name);
    if (entries.empty() || known.name != name || known.kind == entries.front().module->kind) continue;
    if (const ModuleEntry* further = library.find_of(known.kind, name)) entries.push_back(*further);
  }
  if (entries.empty())
    throw std::runtime_error("no module \"" + name + "\"" + did_you_mean(name, names) + "; `cairn plugins` lists them");
  return entries;
}

ordered_json info_json(const ModuleEntry& entry, const PluginsCommand& command) {
  const RegisteredModule& module = *entry.module;
  return {{"kind", std::string(name_of(module.kind))},
          {"name", module.name},
          {"summary", module.summary},
          {"file", entry.plugin->file.string()},
          {"fields", json_of(group_of(module, command.group))}};
}

ordered_json infos_json(const std::vector<ModuleEntry>& entries, const PluginsCommand& command) {
  ordered_json list = ordered_json::array();
  for (const ModuleEntry& entry : entries) list.push_back(info_json(entry, command));
  return list;
}

void print_info(const ModuleEntry& entry, const PluginsCommand& command) {
  const RegisteredModule& module = *entry.module;
  const std::vector<FieldSpec>& fields = group_of(module, command.group);
  std::cout << module.name << ": " << name_of(module.kind) << "\n"
            << module.summary << "\nfrom " << entry.plugin->file.string() << "\n";
  if (!module.schema.shorthand.empty() && command.group.empty())
    std::cout << "a bare value stands for `" << module.schema.shorthand << "`\n";
  std::cout << "\n" << settings_text(fields, command.all);
  if (const std::string group = first_group(fields); !command.all && !group.empty())
    std::cout << "\n`cairn plugins info " << module.name << " " << (command.group.empty() ? "" : command.group + ".")
              << group << "` lists what stands in a group, --all everything\n";
}

}  // namespace

int plugins_list(const CommonOptions& common) {
  const ModuleLibrary library = module_library(common);
  const std::string version(this_abi_stamp().cairn_version);  // that of all modules that can be used
  ordered_json list = ordered_json::array();
  for (const KnownModule& module : library.known()) {
    const std::string kind(name_of(module.kind));
    const std::string file = module.file.filename().string();
    if (common.json)
      list.push_back(
          {{"kind", kind}, {"name", module.name}, {"module", file}, {"version", version}, {"summary", module.summary}});
    else
      std::cout << fmt::format("{:<13} {:<18} {:<22} {:<8} {}\n", kind, printable_excerpt(module.name), file, version,
                               printable_excerpt(module.summary));
  }
  const std::vector<std::string> faults = library.faults();
  if (common.json) print_json({{"modules", list}, {"faults", faults}});
  for (const std::string& fault : faults) std::cerr << "not loaded: " << fault << "\n";
  return faults.empty() ? kExitDone : kExitNotSolved;
}

int plugins_info(const PluginsCommand& command, const CommonOptions& common) {
  const ModuleLibrary library = module_library(common);
  const std::vector<ModuleEntry> entries = entries_of(library, command.name);
  if (common.json) {
    print_json(entries.size() == 1 ? info_json(entries.front(), command)
                                   : ordered_json{{"name", command.name}, {"modules", infos_json(entries, command)}});
    return kExitDone;
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (i > 0) std::cout << "\n";
    print_info(entries[i], command);
  }
  return kExitDone;
}

}  // namespace cairn
