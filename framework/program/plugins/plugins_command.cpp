#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "framework/program/common/commands.hpp"
#include "framework/program/common/modules.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/printable.hpp"
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
  const std::string& name = command.name;
  const ModuleLibrary library = module_library(common);
  const ModuleEntry* entry = library.find_any(name);
  if (entry == nullptr) {
    std::vector<std::string> names;
    for (const KnownModule& known : library.known()) names.push_back(known.name);
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
