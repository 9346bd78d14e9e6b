// What of a nav2 feature's properties has a place in the landmark graph: asked when reading, and again when writing,
// to see what has changed meanwhile. Templates, so that the JSON library stays in .cpp files.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "maps/base/json_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/exchange/graphs/imported_names.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn::exchange {

template <class Json>
const Json* metadata_in(const Json& properties, const char* key) {
  const auto metadata = properties.find("metadata");
  if (metadata == properties.end() || !metadata->is_object()) return nullptr;
  const auto found = metadata->find(key);
  return found == metadata->end() ? nullptr : &*found;
}

template <class Json>
std::string name_in(const Json& properties) {
  if (const Json* name = metadata_in(properties, "name"); name != nullptr && name->is_string())
    return name->template get<std::string>();
  const auto name = properties.find("name");
  return name != properties.end() && name->is_string() ? name->template get<std::string>() : "";
}

template <class Json>
std::string category_in(const Json& properties) {
  const Json* category = metadata_in(properties, "class");
  return category != nullptr && category->is_string() ? category->template get<std::string>() : "";
}

// Fails where a name or category with a control character stands in the feature that begins there. A name stands in the
// metadata or beside them.
template <class Json>
void check_names(const SourceText& source, std::size_t begin, const Json& properties, const Landmark& landmark) {
  const auto offset = [&](const char* key) {
    return metadata_in(properties, key) != nullptr ? offset_of(source, begin, {"properties", "metadata", key})
                                                   : offset_of(source, begin, {"properties", key});
  };
  check_name(source, offset("name"), "name", landmark.name);
  check_name(source, offset("class"), "category", landmark.category);
}

// 0: not set.
template <class Json>
double cost_in(const Json& properties) {
  const auto cost = properties.find("cost");
  return cost != properties.end() && cost->is_number() ? cost->template get<double>() : 0.0;
}

template <class Json>
std::optional<double> speed_limit_in(const Json& properties) {
  const Json* limit = metadata_in(properties, "abs_speed_limit");
  if (limit == nullptr || !limit->is_number() || !(limit->template get<double>() > 0.0)) return std::nullopt;
  return limit->template get<double>();
}

struct Fault {
  std::vector<std::string> path;  // to what is wrong
  std::string sentence;
};

template <class Json>
std::optional<Fault> fault_of_operation(const Json& operation, const std::string& key) {
  static const std::vector<std::string> kTriggers{"NODE", "ON_ENTER", "ON_EXIT"};
  if (!operation.is_object() || !operation.value("type", Json()).is_string())
    return Fault{{key}, "an operation is an object with a type, a text"};
  const Json trigger = operation.value("trigger", Json());
  if (!trigger.is_string()) return Fault{{key, "trigger"}, "an operation needs a trigger: NODE, ON_ENTER or ON_EXIT"};
  const auto name = trigger.template get<std::string>();
  if (std::find(kTriggers.begin(), kTriggers.end(), name) != kTriggers.end()) return std::nullopt;
  return Fault{{key, "trigger"},
               "unknown trigger " + in_quotes(name) + did_you_mean(name, kTriggers) +
                   ": allowed are NODE, ON_ENTER and ON_EXIT"};
}

// Operations are an object of named ones or an array, as nav2 reads them.
template <class Json>
std::optional<Fault> fault_of_operations(const Json& operations) {
  if (!operations.is_structured())
    return Fault{{}, std::string("operations must be an object or an array, is ") + operations.type_name()};
  for (const auto& [key, operation] : operations.items())  // an array's keys are its numbers
    if (auto fault = fault_of_operation(operation, key)) return fault;
  return std::nullopt;
}

}  // namespace cairn::exchange
