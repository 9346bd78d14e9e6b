#include "framework/config/fields.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "maps/base/text.hpp"
#include "maps/base/yaml_text.hpp"

namespace cairn {
namespace {

// Beyond this a coordinate is a slip of the hand, and cell indices would overflow.
constexpr Range kCoordinateRange{-1e5, 1e5};
// Checking that a polygon does not cross itself takes quadratic time.
constexpr std::size_t kMaxPoints = 10'000;
// File systems end at 255; what is saved gets an ending.
constexpr std::size_t kMaxFileName = 200;

std::string found_text(const ConfigValue& value) {
  if (value.kind != ConfigValue::Kind::scalar) return value.kind_name();
  return (value.quoted ? "the text " : "") + in_quotes(value.scalar);
}

// "a number from 0 to 5 m", "a number of at least 0 m", "a number (m)", "a number".
std::string allowed_text(const std::string& noun, const Range& range, const std::string& unit) {
  const std::string with_unit = unit.empty() ? "" : " " + unit;
  // The ends of a 64 bit integer say nothing to people.
  const bool has_min = std::abs(range.min) < 1e18;
  const bool has_max = std::abs(range.max) < 1e18;
  if (has_min && has_max) {
    return noun + " from " + config_detail::number_text(range.min) + " to " + config_detail::number_text(range.max) +
           with_unit;
  }
  if (has_min) return noun + " of at least " + config_detail::number_text(range.min) + with_unit;
  if (has_max) return noun + " of at most " + config_detail::number_text(range.max) + with_unit;
  return unit.empty() ? noun : noun + " (" + unit + ")";
}

[[noreturn]] void fail(const ConfigValue& value, const std::string& key, const std::string& allowed,
                       const std::string& hint = "") {
  throw ConfigError(value.place, key + " must be " + allowed + ", found " + found_text(value) + hint);
}

// The whole token as a number, whatever the locale; nothing for text, infinities and NaN.
template <class Number>
std::optional<Number> parsed(const ConfigValue& value) {
  if (value.kind != ConfigValue::Kind::scalar || value.quoted) return std::nullopt;
  const auto number = number_from<Number>(exchange::without_plus_sign(value.scalar));
  if constexpr (std::is_floating_point_v<Number>) {
    if (number && !std::isfinite(*number)) return std::nullopt;
  }
  return number;
}

std::string quotes_hint(const ConfigValue& value) {
  if (!value.quoted) return "";
  ConfigValue plain = value;
  plain.quoted = false;
  return parsed<double>(plain) ? " (leave out the quotes)" : "";
}

// 90 where 0.9 is meant.
std::string per_cent_hint(const std::optional<double>& number, const std::string& key, const Range& range) {
  const bool is_ratio = key.ends_with("ratio") && range.min == 0.0 && range.max == 1.0;
  if (!is_ratio || !number || *number <= 1.0 || *number > 100.0) return "";
  return " (" + config_detail::number_text(*number) + " % is " + config_detail::number_text(*number / 100.0) + ")";
}

std::vector<std::string> keys_of(const Schema& schema) {
  std::vector<std::string> keys;
  for (const FieldSpec& field : schema.fields) keys.push_back(field.key);
  return keys;
}

const FieldSpec* field_of(const Schema& schema, std::string_view key) {
  const auto at = std::ranges::find(schema.fields, key, &FieldSpec::key);
  return at == schema.fields.end() ? nullptr : &*at;
}

// lists: all keys that there are, which is said once of a map.
[[noreturn]] void fail_unknown(const ConfigValue::Entry& entry, const Schema& schema, const std::string& what,
                               bool lists) {
  const auto moved = std::ranges::find(schema.moved, entry.key, &MovedKey::key);
  if (moved != schema.moved.end())
    throw ConfigError(entry.key_place, "the key " + in_quotes(entry.key) + " in " + what + " is now " + moved->now);
  const std::vector<std::string> known = keys_of(schema);
  const std::string allowed = !lists ? "" : known.empty() ? "; it takes none" : "; known: " + joined(known);
  throw ConfigError(entry.key_place,
                    "unknown key " + in_quotes(entry.key) + " in " + what + did_you_mean(entry.key, known) + allowed);
}

void check_required(const Schema& schema, const ConfigValue& value, const std::string& what, ConfigErrors& errors) {
  const bool is_shorthand = value.kind == ConfigValue::Kind::scalar || value.kind == ConfigValue::Kind::list;
  for (const FieldSpec& field : schema.fields) {
    const bool is_given = is_shorthand ? field.key == schema.shorthand : value.find(field.key) != nullptr;
    if (field.required && !is_given)
      errors.add({value.place, what + " lacks the key " + in_quotes(field.key) + ": " + field.meaning});
  }
}

// Whoever wrote `explored: 90` has never seen the key that the value stands for.
void load_short_form(const FieldSpec& field, void* config, const ConfigValue& value, const std::string& what) {
  try {
    field.load(config, value);
  } catch (const ConfigError& error) {
    if (error.place() != value.place || !error.sentence().starts_with(field.key + " must ")) throw;
    throw ConfigError(value.place, what + ": " + error.sentence(), error.others());
  }
}

}  // namespace

void Schema::load_into(void* config, const ConfigValue& value, const std::string& what) const {
  ConfigErrors errors;
  if (value.kind == ConfigValue::Kind::scalar || value.kind == ConfigValue::Kind::list) {
    if (shorthand.empty()) throw ConfigError(value.place, what + " must be a map, found " + found_text(value));
    const FieldSpec* field = field_of(*this, shorthand);
    if (field == nullptr) throw std::logic_error(what + ": the shorthand \"" + shorthand + "\" is not a field");
    check_required(*this, value, what, errors);
    errors.throw_if_any();
    load_short_form(*field, config, value, what);
    return;
  }
  bool has_listed = false;
  for (const ConfigValue::Entry& entry : value.entries) {
    if (errors.is_full()) break;
    errors.attempt([&] {
      const FieldSpec* field = field_of(*this, entry.key);
      if (field == nullptr) fail_unknown(entry, *this, what, !std::exchange(has_listed, true));
      field->load(config, entry.value);
    });
  }
  check_required(*this, value, what, errors);
  errors.throw_if_any();
}

namespace config_detail {

double to_number(const ConfigValue& value, const std::string& key, const Range& range, const std::string& unit) {
  const std::optional<double> number = parsed<double>(value);
  if (!number || *number < range.min || *number > range.max) {
    fail(value, key, allowed_text("a number", range, unit), quotes_hint(value) + per_cent_hint(number, key, range));
  }
  return *number;
}

std::int64_t to_integer(const ConfigValue& value, const std::string& key, const Range& range) {
  const std::optional<std::int64_t> number = parsed<std::int64_t>(value);
  if (!number || static_cast<double>(*number) < range.min || static_cast<double>(*number) > range.max) {
    fail(value, key, allowed_text("a whole number", range, ""), quotes_hint(value));
  }
  return *number;
}

bool to_flag(const ConfigValue& value, const std::string& key) {
  const bool is_plain = value.kind == ConfigValue::Kind::scalar && !value.quoted;
  if (is_plain && value.scalar == "true") return true;
  if (is_plain && value.scalar == "false") return false;
  fail(value, key, "true or false");
}

std::string to_text(const ConfigValue& value, const std::string& key) {
  if (value.kind != ConfigValue::Kind::scalar) fail(value, key, "text");
  return value.scalar;
}

std::filesystem::path to_path(const ConfigValue& value, const std::string& key) {
  (void)to_text(value, key);
  return resolve_path(value);
}

std::string to_file_name(const ConfigValue& value, const std::string& key) {
  std::string name = to_text(value, key);
  const auto is_kept_out = [](char c) { return c == '/' || c == '\\' || static_cast<unsigned char>(c) < ' '; };
  if (name.empty() || name == "." || name == ".." || name.size() > kMaxFileName ||
      std::ranges::any_of(name, is_kept_out))
    fail(value, key, "a plain file name of up to " + std::to_string(kMaxFileName) + " bytes, without a folder");
  return name;
}

std::string to_value_name(const ConfigValue& value, const std::string& key) {
  std::string name = to_text(value, key);
  const auto is_part = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  if (name.empty() || name.size() > kMaxFileName || !std::ranges::all_of(name, is_part))
    fail(value, key, "a name of letters, digits and _");
  return name;
}

std::size_t to_choice(const ConfigValue& value, const std::string& key, const std::vector<std::string>& choices) {
  const std::string allowed = (choices.size() > 1 ? "one of " : "") + joined(choices);
  if (value.kind != ConfigValue::Kind::scalar) fail(value, key, allowed);
  const auto at = std::ranges::find(choices, value.scalar);
  if (at == choices.end()) fail(value, key, allowed, did_you_mean(value.scalar, choices));
  return static_cast<std::size_t>(at - choices.begin());
}

std::vector<std::size_t> to_choices(const ConfigValue& value, const std::string& key,
                                    const std::vector<std::string>& choices) {
  const auto each =
      each_by([&](const ConfigValue& item, const std::string& name) { return to_choice(item, name, choices); });
  std::vector<std::size_t> once;
  for (const std::size_t choice : each(value, key))
    if (std::ranges::find(once, choice) == once.end()) once.push_back(choice);
  if (once.empty()) throw ConfigError(value.place, key + " must name at least one of " + joined(choices));
  return once;
}

Point to_point(const ConfigValue& value, const std::string& key, const Range& range, const std::string& unit) {
  const std::string allowed = "a point [x, y]";
  if (value.kind != ConfigValue::Kind::list) fail(value, key, allowed);
  if (value.items.size() != 2) {
    throw ConfigError(value.place,
                      key + " must be " + allowed + ", found a list of " + std::to_string(value.items.size()));
  }
  const Range within{std::max(range.min, kCoordinateRange.min), std::min(range.max, kCoordinateRange.max)};
  const auto coordinate = [&](std::size_t i, const char* name) {
    return to_number(value.items[i], name + (" of " + key), within, unit);
  };
  return {coordinate(0, "x"), coordinate(1, "y")};
}

std::vector<double> to_numbers(const ConfigValue& value, const std::string& key, const Range& range) {
  if (value.kind != ConfigValue::Kind::list) fail(value, key, "a list of numbers");
  std::vector<double> numbers;
  for (const ConfigValue& item : value.items) numbers.push_back(to_number(item, "each item of " + key, range, ""));
  return numbers;
}

std::vector<Point> to_points(const ConfigValue& value, const std::string& key) {
  if (value.kind != ConfigValue::Kind::list) fail(value, key, "a list of points [[x, y], ...]");
  if (value.items.size() > kMaxPoints) {
    throw ConfigError(value.place, key + " must be a list of at most " + std::to_string(kMaxPoints) +
                                       " points, found " + std::to_string(value.items.size()));
  }
  std::vector<Point> points;
  for (const ConfigValue& item : value.items) points.push_back(to_point(item, "each item of " + key));
  return points;
}

PluginChoice to_plugin(const ConfigValue& value, const std::string& key, const std::string& usual) {
  if (value.kind != ConfigValue::Kind::map) fail(value, key, "a map {plugin: NAME, ...}");
  const ConfigValue* name = value.find("plugin");
  if (name == nullptr && !usual.empty()) return {usual, value};
  if (name == nullptr) throw ConfigError(value.place, key + " lacks the key \"plugin\": which module does it");
  PluginChoice choice{to_text(*name, "plugin"), value};
  if (choice.name.empty()) fail(*name, "plugin", "the name of a module");
  std::erase_if(choice.config.entries, [](const ConfigValue::Entry& entry) { return entry.key == "plugin"; });
  return choice;
}

const std::vector<ConfigValue>& to_list(const ConfigValue& value, const std::string& key) {
  if (value.kind != ConfigValue::Kind::list) fail(value, key, "a list");
  return value.items;
}

std::string number_text(double value) {
  if (value == 0.0) return "0";
  // Twelve digits: the shortest exact text of a converted angle (14.999999999999998) helps nobody.
  std::array<char, 32> buffer{};
  const auto result =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 12);
  return {buffer.data(), result.ptr};
}

std::string exactly_one_of(const ConfigValue& map, const std::vector<std::string>& keys, const std::string& what) {
  const ConfigValue::Entry* found = nullptr;
  for (const ConfigValue::Entry& entry : map.entries) {
    if (std::ranges::find(keys, entry.key) == keys.end()) continue;
    if (found != nullptr) {
      throw ConfigError(entry.key_place, what + " takes only one of " + joined(keys) + ", found both " +
                                             in_quotes(found->key) + " and " + in_quotes(entry.key));
    }
    found = &entry;
  }
  if (found == nullptr) throw ConfigError(map.place, what + " needs one of " + joined(keys));
  return found->key;
}

}  // namespace config_detail
}  // namespace cairn
