// One line of a query file.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "framework/config/config_value.hpp"
#include "framework/program/plan/plan_query.hpp"
#include "maps/base/json_text.hpp"

namespace cairn {
namespace {

using nlohmann::json;

constexpr int kMaxAlternatives = 1000;
constexpr const char* kExpected = "expected one JSON object {\"id\", \"from\", \"to\"} a line";

// Where a key and its value begin, from 1.
struct KeyPlace {
  std::string key;
  int column = 1;
  int value_column = 1;
};

// Of the object on a line, as far as that is sound JSON; the JSON library does not say where things stand.
std::vector<KeyPlace> key_places_of(const std::string& line) {
  std::vector<KeyPlace> keys;
  int depth = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    if (line[at] == '{' || line[at] == '[') ++depth;
    if (line[at] == '}' || line[at] == ']') --depth;
    if (line[at] != '"') continue;
    const std::size_t begin = at++;
    while (at < line.size() && line[at] != '"') at += line[at] == '\\' ? 2 : 1;
    const std::size_t colon = line.find_first_not_of(" \t\r", at + 1);
    if (depth != 1 || colon == std::string::npos || line[colon] != ':') continue;
    const std::size_t value = std::min(line.find_first_not_of(" \t\r", colon + 1), line.size());
    const json key = json::parse(line.substr(begin, at + 1 - begin), nullptr, false);
    if (key.is_string()) keys.push_back({key, static_cast<int>(begin) + 1, static_cast<int>(value) + 1});
  }
  return keys;
}

[[noreturn]] void refuse_second(const std::string& key, const std::string& line, SourcePlace place) {
  int before = 0;
  for (const KeyPlace& found : key_places_of(line))
    if (found.key == key && before++ == 1) place.column = found.column;
  throw ConfigError(place, "the key " + in_quotes(key) + " stands here twice");
}

// The JSON library copies and writes values by recursion.
void check_depth(const std::string& line, SourcePlace place) {
  std::size_t depth = 0;
  bool in_text = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"') in_text = !in_text;
    if (in_text && c == '\\') ++at;
    if (in_text) continue;
    if (c == '{' || c == '[') ++depth;
    if ((c == '}' || c == ']') && depth > 0) --depth;
    if (depth <= exchange::kMaxJsonDepth) continue;
    place.column = static_cast<int>(at) + 1;
    throw ConfigError(place, "nests deeper than " + std::to_string(exchange::kMaxJsonDepth) + " brackets");
  }
}

json object_of_line(const std::string& line, SourcePlace place) {
  if (const std::size_t zero = line.find('\0'); zero != std::string::npos) {  // where the JSON library ends the text
    place.column = static_cast<int>(zero) + 1;
    throw ConfigError(place, "a zero byte");
  }
  check_depth(line, place);
  std::set<std::string> keys;
  const auto refuse_twice = [&](int depth, json::parse_event_t event, const json& key) {
    if (depth == 1 && event == json::parse_event_t::key && !keys.insert(key.get<std::string>()).second)
      refuse_second(key.get<std::string>(), line, place);
    return true;
  };
  try {
    if (json value = json::parse(line, refuse_twice); value.is_object()) return value;
  } catch (const json::parse_error& error) {
    place.column = std::max(1, static_cast<int>(error.byte));
    throw ConfigError(place, std::string(kExpected) + (error.byte > line.size() ? "; the line ends too early" : ""));
  } catch (const json::exception&) {  // a number that none can hold
    throw ConfigError(place, std::string(kExpected) + ", with numbers that are some");
  }
  throw ConfigError(place, kExpected);
}

// Texts or numbers of a list, or one alone.
std::vector<std::string> texts_of(const json& value, const std::string& key, const SourcePlace& place) {
  std::vector<std::string> texts;
  for (const json& item : value.is_array() ? value : json::array({value})) {
    if (!item.is_string() && !item.is_number_integer())
      throw ConfigError(place, "\"" + key + "\" must be a list of names");
    texts.push_back(item.is_string() ? item.get<std::string>() : item.dump());
  }
  return texts;
}

std::string text_of(const json& value, const std::string& key, const SourcePlace& place) {
  if (!value.is_string()) throw ConfigError(place, "\"" + key + "\" must be a text");
  return value;
}

bool flag_of(const json& value, const std::string& key, const SourcePlace& place) {
  if (!value.is_boolean()) throw ConfigError(place, "\"" + key + "\" must be true or false");
  return value;
}

int alternatives_of(const json& value, const SourcePlace& place) {
  if (!value.is_number_unsigned() || value > kMaxAlternatives)
    throw ConfigError(place, fmt::format("\"alternatives\" must be a whole number of 0 to {}", kMaxAlternatives));
  return value;
}

void take(PlanQuery& query, const KeyPlace& at, const json& value, SourcePlace place) {
  PlanQuestion& question = query.question;
  const std::string& key = at.key;
  place.column = at.value_column;
  if (key == "id") {
    query.id = value;
  } else if (key == "map") {
    query.map = text_of(value, key, place);
  } else if (key == "from") {
    question.from = text_of(value, key, place);
  } else if (key == "to") {
    question.to = text_of(value, key, place);
  } else if (key == "cost") {
    question.cost = text_of(value, key, place);
  } else if (key == "via") {
    question.via = texts_of(value, key, place);
  } else if (key == "avoid") {
    question.avoid = texts_of(value, key, place);
  } else if (key == "closed") {
    question.closed = texts_of(value, key, place);
  } else if (key == "alternatives") {
    question.alternatives = alternatives_of(value, place);
  } else if (key == "trajectory") {
    question.trajectory = flag_of(value, key, place);
  } else if (key == "explain") {
    question.explain = flag_of(value, key, place);
  } else {
    place.column = at.column;
    throw ConfigError(place, "a query knows no \"" + key + "\"" +
                                 did_you_mean(key, {"id", "from", "to", "via", "avoid", "closed", "alternatives",
                                                    "cost", "explain", "trajectory", "map"}));
  }
  try {
    check(question);
  } catch (const std::invalid_argument& error) {
    throw ConfigError(place, error.what());
  }
}

}  // namespace

PlanQuery query_of_line(const std::string& line, const std::string& file, int number, const PlanQuestion& defaults) {
  const SourcePlace place{file, number, 1};
  const json value = object_of_line(line, place);
  PlanQuery query{"", "", defaults};
  for (const KeyPlace& key : key_places_of(line)) take(query, key, value.at(key.key), place);
  for (const char* key : {"from", "to"})
    if (!value.contains(key)) throw ConfigError(place, std::string("a query needs the text \"") + key + "\"");
  return query;
}

}  // namespace cairn
