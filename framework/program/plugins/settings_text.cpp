#include "framework/program/plugins/settings_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

std::string allowed_text(const FieldSpec& field) {
  if (!field.choices.empty()) return joined(field.choices, " | ");
  const bool low = std::isfinite(field.range.min);
  const bool high = std::isfinite(field.range.max);
  if (low && high) return fmt::format("{:g} .. {:g}", field.range.min, field.range.max);
  if (low) return fmt::format(">= {:g}", field.range.min);
  return high ? fmt::format("<= {:g}", field.range.max) : "";
}

std::size_t count_of(const std::vector<FieldSpec>& fields) {
  std::size_t count = 0;
  for (const FieldSpec& field : fields) count += field.fields.empty() ? 1 : count_of(field.fields);
  return count;
}

void add_fields(std::string& text, const std::vector<FieldSpec>& fields, bool all, const std::string& indent) {
  for (const FieldSpec& field : fields) {
    std::string about = field.type;
    if (!field.unit.empty()) about += ", " + field.unit;
    if (const std::string allowed = allowed_text(field); !allowed.empty()) about += ", " + allowed;
    if (field.required)
      about += ", required";
    else if (!field.default_text.empty())
      about += ", default " + field.default_text;
    if (!all && !field.fields.empty()) about += ", a group of " + counted(count_of(field.fields), "setting");
    text += fmt::format("{0}{1}  ({2})\n{0}    {3}\n", indent, field.key, about, field.meaning);
    if (all) add_fields(text, field.fields, all, indent + "    ");
  }
}

}  // namespace

std::string settings_text(const std::vector<FieldSpec>& fields, bool all) {
  std::string text;
  add_fields(text, fields, all, "  ");
  return text;
}

const std::vector<FieldSpec>& group_of(const RegisteredModule& module, const std::string& group) {
  const std::vector<FieldSpec>* fields = &module.schema.fields;
  for (std::size_t begin = 0; begin < group.size();) {
    const std::size_t end = std::min(group.find('.', begin), group.size());
    const std::string key = group.substr(begin, end - begin);
    std::vector<std::string> groups;
    for (const FieldSpec& field : *fields)
      if (!field.fields.empty()) groups.push_back(field.key);
    const auto found = std::ranges::find(*fields, key, &FieldSpec::key);
    if (found == fields->end() || found->fields.empty())
      throw std::runtime_error("no group " + in_quotes(key) + " of settings in " + module.name +
                               (begin == 0 ? "" : "." + group.substr(0, begin - 1)) + did_you_mean(key, groups) +
                               (groups.empty() ? "; it has no groups" : "; it has " + joined(groups)));
    fields = &found->fields;
    begin = end + 1;
  }
  return *fields;
}

}  // namespace cairn
