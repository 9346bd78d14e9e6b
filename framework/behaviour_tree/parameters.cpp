#include "framework/behaviour_tree/parameters.hpp"

#include <algorithm>
#include <set>

#include "framework/config/config_errors.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

bool is_name(std::string_view text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && is_letter(text.front()) &&
         std::ranges::all_of(text, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

// Empty: no reference.
std::string referred(const ConfigValue& value) {
  const bool is_reference = value.kind == ConfigValue::Kind::scalar && !value.quoted && value.scalar.starts_with('$');
  return is_reference && is_name(value.scalar.substr(1)) ? value.scalar.substr(1) : "";
}

std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "; it has none" : "; known: " + joined(names);
}

std::string unknown(const std::string& name, const std::string& file, const std::vector<std::string>& names) {
  return "unknown parameter " + in_quotes(name) + " of " + file + did_you_mean(name, names) + listed(names);
}

void require_map(const ConfigValue& value, const char* what) {
  if (value.kind == ConfigValue::Kind::map || value.kind == ConfigValue::Kind::null) return;
  throw ConfigError(value.place,
                    std::string(what) + ": expected a map of parameters {name: value}, found " + value.kind_name());
}

// Of --set there is no line, and nothing more to say.
void collect_files(const ConfigValue& value, std::set<std::string>& files) {
  if (value.place.line > 0) files.insert(value.place.file);
  for (const ConfigValue& item : value.items) collect_files(item, files);
  for (const ConfigValue::Entry& entry : value.entries) collect_files(entry.value, files);
}

class Putter {
 public:
  Putter(const Parameters& parameters, std::size_t& left, std::vector<ConfigError>& errors)
      : parameters_(parameters), left_(left), errors_(errors) {
    for (const auto& [name, value] : parameters.values) names_.push_back(name);
  }

  ConfigValue put(const ConfigValue& value) {
    if (const std::string name = referred(value); !name.empty()) return value_of(name, value);
    pay(value.place);
    ConfigValue out = value;
    for (ConfigValue& item : out.items) item = put(item);
    for (ConfigValue::Entry& entry : out.entries) entry.value = put(entry.value);
    return out;
  }

  [[nodiscard]] bool has_used(const std::string& name) const { return used_.contains(name); }

 private:
  ConfigValue value_of(const std::string& name, const ConfigValue& reference) {
    const auto found = parameters_.values.find(name);
    if (found == parameters_.values.end()) {
      errors_.emplace_back(reference.place, unknown(name, parameters_.of, names_) + " (text goes in quotes)");
      return reference;
    }
    used_.insert(name);
    pay_for_all(found->second);
    return found->second;
  }
  void pay_for_all(const ConfigValue& value) {
    pay(value.place);
    for (const ConfigValue& item : value.items) pay_for_all(item);
    for (const ConfigValue::Entry& entry : value.entries) pay_for_all(entry.value);
  }
  void pay(const SourcePlace& place) {
    if (left_ == 0) throw ConfigError(place, "with all its parameters put in, the mission is too large");
    --left_;
  }

  const Parameters& parameters_;
  std::size_t& left_;
  std::vector<ConfigError>& errors_;
  std::vector<std::string> names_;
  std::set<std::string> used_;
};

}  // namespace

Parameters bind_parameters(const SubMissionFile& sub, const std::string& file, const ConfigValue& with,
                           const SourcePlace& place) {
  require_map(sub.parameters, "parameters");
  require_map(with, "with");
  std::vector<std::string> names;
  for (const ConfigValue::Entry& entry : sub.parameters.entries) {
    if (!is_name(entry.key))
      throw ConfigError(entry.key_place, "a parameter's name is letters, digits and _, not " + in_quotes(entry.key));
    names.push_back(entry.key);
  }
  Parameters parameters{file, {}};
  for (const ConfigValue::Entry& entry : with.entries) {
    if (sub.parameters.find(entry.key) == nullptr) throw ConfigError(entry.key_place, unknown(entry.key, file, names));
    parameters.values[entry.key] = entry.value;
  }
  for (const ConfigValue::Entry& entry : sub.parameters.entries) {
    if (with.find(entry.key) != nullptr) continue;
    if (entry.value.kind == ConfigValue::Kind::null)
      throw ConfigError(place,
                        file + " needs the parameter " + in_quotes(entry.key) + ": `with: {" + entry.key + ": ...}`");
    parameters.values[entry.key] = entry.value;
  }
  return parameters;
}

ConfigValue with_parameters(const ConfigValue& steps, const Parameters& parameters, std::size_t& values_left,
                            std::vector<ConfigError>& errors) {
  Putter putter(parameters, values_left, errors);
  ConfigValue out = putter.put(steps);
  for (const auto& [name, value] : parameters.values)
    if (!putter.has_used(name))
      errors.emplace_back(value.place,
                          "the parameter " + in_quotes(name) + " of " + parameters.of + " is used by no step");
  return out;
}

ConfigError with_place_of_use(const ConfigError& error, const ConfigValue& value, const SourcePlace& place) {
  std::set<std::string> files;
  collect_files(value, files);
  files.erase(place.file);
  return each_changed(error, [&](const ConfigError& one) -> ConfigError {
    if (!files.contains(one.place().file)) return one;
    return {one.place(), one.sentence() + " (given as a parameter to " + place.text() + ")"};
  });
}

}  // namespace cairn
