// Configuration types described once.
//
// A config type is a plain struct with defaults and one static function that lists its fields:
//
//   struct WaitConfig {
//     double for_s = 1.0;
//     static void describe(Fields<WaitConfig>& fields) {
//       fields.number("for_s", &WaitConfig::for_s, {0.0, 3600.0}, "s", "how long to stand still");
//       fields.shorthand("for_s");  // `wait: 2` means `wait: {for_s: 2}`
//     }
//   };
//
// From that one list come loading with checks, `cairn plugins info`, the reference and the schema.
// Unknown key, wrong type, out of range: ConfigError with file:line:column, what was found, what is
// allowed and the nearest known name. Angles are degrees in files and radians in structs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/config/config_errors.hpp"
#include "framework/config/config_value.hpp"
#include "framework/config/schema.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn {

template <class Config>
class Fields;

// defaults: what is left out in a file; a group's are those of the struct around it.
template <class Config>
[[nodiscard]] Schema schema_of(const Config& defaults = {}) {
  Fields<Config> fields(defaults);
  Config::describe(fields);
  return std::move(fields).take();
}

// Throws ConfigError: the first mistake, with all others that do not depend on it.
template <class Config>
[[nodiscard]] Config load_config(const ConfigValue& value, const std::string& what) {
  Config config;
  schema_of<Config>().load_into(&config, value, what);
  return config;
}

// Single values, each with its checks and its error text (fields.cpp).
namespace config_detail {
[[nodiscard]] double to_number(const ConfigValue& value, const std::string& key, const Range& range,
                               const std::string& unit);
[[nodiscard]] std::int64_t to_integer(const ConfigValue& value, const std::string& key, const Range& range);
[[nodiscard]] bool to_flag(const ConfigValue& value, const std::string& key);
[[nodiscard]] std::string to_text(const ConfigValue& value, const std::string& key);
// Text that is a path, resolved against the folder of the file that names it.
[[nodiscard]] std::filesystem::path to_path(const ConfigValue& value, const std::string& key);
// Text that names a file or folder within a folder, and nothing outside it.
[[nodiscard]] std::string to_file_name(const ConfigValue& value, const std::string& key);
// The name of a place that steps hand over: letters, digits and _.
[[nodiscard]] std::string to_value_name(const ConfigValue& value, const std::string& key);
[[nodiscard]] std::size_t to_choice(const ConfigValue& value, const std::string& key,
                                    const std::vector<std::string>& choices);
// Each once, at least one.
[[nodiscard]] std::vector<std::size_t> to_choices(const ConfigValue& value, const std::string& key,
                                                  const std::vector<std::string>& choices);
[[nodiscard]] Point to_point(const ConfigValue& value, const std::string& key, const Range& range = {},
                             const std::string& unit = "");
[[nodiscard]] std::vector<double> to_numbers(const ConfigValue& value, const std::string& key, const Range& range);
[[nodiscard]] std::vector<Point> to_points(const ConfigValue& value, const std::string& key);
// usual: the module when the map names none; empty: it must.
[[nodiscard]] PluginChoice to_plugin(const ConfigValue& value, const std::string& key, const std::string& usual = "");
[[nodiscard]] const std::vector<ConfigValue>& to_list(const ConfigValue& value, const std::string& key);
// Reads a list, each of its items by `read`.
template <class Read>
[[nodiscard]] auto each_by(Read read) {
  return [read](const ConfigValue& value, const std::string& key) {
    std::vector<decltype(read(value, key))> out;
    ConfigErrors errors;
    for (const ConfigValue& item : to_list(value, key))
      if (!errors.is_full()) errors.attempt([&] { out.push_back(read(item, key)); });
    errors.throw_if_any();
    return out;
  };
}
[[nodiscard]] std::string number_text(double value);
// Which one of the keys the map holds. Throws ConfigError when it holds none or several.
[[nodiscard]] std::string exactly_one_of(const ConfigValue& map, const std::vector<std::string>& keys,
                                         const std::string& what);
// The part of a range that an integer type can hold.
template <class Integer>
[[nodiscard]] constexpr Range within_type(const Range& range) {
  constexpr auto kMin = static_cast<double>(std::numeric_limits<Integer>::min());
  constexpr auto kMax = static_cast<double>(std::numeric_limits<Integer>::max());
  return {range.min < kMin ? kMin : range.min, range.max > kMax ? kMax : range.max};
}
}  // namespace config_detail

template <class Config>
class Fields {
 public:
  explicit Fields(const Config& defaults = {}) : defaults_(defaults) {}

  // Number: double or std::optional<double>, which has no default. Owner: Config or a base of it.
  template <class Number, class Owner>
  FieldSpec& number(std::string key, Number Owner::*member, Range range, const std::string& unit, std::string meaning) {
    std::string default_text;
    if constexpr (std::is_same_v<Number, double>) default_text = config_detail::number_text(defaults_.*member);
    const auto read = [range, unit](const ConfigValue& v, const std::string& name) {
      return config_detail::to_number(v, name, range, unit);
    };
    return measured(add(std::move(key), "number", std::move(meaning), std::move(default_text), member, read), unit,
                    range);
  }
  // Degrees in the file, radians in the struct; the range is in degrees, the unit may be "deg/s" and the like.
  template <class Number, class Owner>
  FieldSpec& angle(std::string key, Number Owner::*member, Range range_deg, std::string meaning,
                   const std::string& unit = "deg") {
    std::string default_text;
    if constexpr (std::is_same_v<Number, double>) default_text = config_detail::number_text(degrees(defaults_.*member));
    const auto read = [range_deg, unit](const ConfigValue& v, const std::string& name) {
      return radians(config_detail::to_number(v, name, range_deg, unit));
    };
    return measured(add(std::move(key), "number", std::move(meaning), std::move(default_text), member, read), unit,
                    range_deg);
  }
  template <class Integer>
  FieldSpec& integer(std::string key, Integer Config::*member, Range range, std::string meaning) {
    const auto read = [range](const ConfigValue& v, const std::string& name) {
      return static_cast<Integer>(config_detail::to_integer(v, name, config_detail::within_type<Integer>(range)));
    };
    return measured(add(std::move(key), "integer", std::move(meaning), std::to_string(defaults_.*member), member, read),
                    "", range);
  }
  FieldSpec& flag(std::string key, bool Config::*member, std::string meaning) {
    return add(std::move(key), "flag", std::move(meaning), defaults_.*member ? "true" : "false", member,
               config_detail::to_flag);
  }
  FieldSpec& text(std::string key, std::string Config::*member, std::string meaning) {
    return add(std::move(key), "text", std::move(meaning), defaults_.*member, member, config_detail::to_text);
  }
  // Text that is also the name of a file or folder.
  FieldSpec& file_name(std::string key, std::string Config::*member, std::string meaning) {
    return add(std::move(key), "text", std::move(meaning), defaults_.*member, member, config_detail::to_file_name);
  }
  // Of a behaviour: the name under which it takes a place from an earlier step, and gives one to later ones. The host
  // checks that a step before gives what another takes.
  FieldSpec& input(std::string key, std::string Config::*member, std::string meaning) {
    return add(std::move(key), "input", std::move(meaning), "", member, config_detail::to_value_name);
  }
  FieldSpec& output(std::string key, std::string Config::*member, std::string meaning) {
    return add(std::move(key), "output", std::move(meaning), "", member, config_detail::to_value_name);
  }
  template <class Enum>
  FieldSpec& choice(std::string key, Enum Config::*member, std::vector<std::pair<std::string, Enum>> options,
                    std::string meaning) {
    std::string default_text;
    std::vector<std::string> names;
    for (const auto& [name, value] : options) {
      names.push_back(name);
      if (value == defaults_.*member) default_text = name;
    }
    FieldSpec& f = add(std::move(key), "choice", std::move(meaning), std::move(default_text), member,
                       [options, names](const ConfigValue& v, const std::string& name) {
                         return options[config_detail::to_choice(v, name, names)].second;
                       });
    f.choices = names;
    return f;
  }
  // A list of them, at least one.
  template <class Enum>
  FieldSpec& choices(std::string key, std::vector<Enum> Config::*member,
                     std::vector<std::pair<std::string, Enum>> options, std::string meaning) {
    std::vector<std::string> names;
    for (const auto& [name, value] : options) names.push_back(name);
    FieldSpec& f = add(std::move(key), "list of choices", std::move(meaning), "", member,
                       [options, names](const ConfigValue& v, const std::string& name) {
                         std::vector<Enum> out;
                         for (const std::size_t choice : config_detail::to_choices(v, name, names))
                           out.push_back(options[choice].second);
                         return out;
                       });
    f.choices = names;
    return f;
  }
  // A path, resolved against the folder of the file that names it.
  FieldSpec& file(std::string key, std::filesystem::path Config::*member, std::string meaning) {
    return add(std::move(key), "file", std::move(meaning), (defaults_.*member).string(), member,
               config_detail::to_path);
  }
  FieldSpec& files(std::string key, std::vector<std::filesystem::path> Config::*member, std::string meaning) {
    return add(std::move(key), "list of files", std::move(meaning), "", member,
               config_detail::each_by(config_detail::to_path));
  }
  // The range is that of each coordinate.
  FieldSpec& point(std::string key, Point Config::*member, const std::string& unit, std::string meaning,
                   Range range = {}) {
    const Point& at = defaults_.*member;
    const std::string default_text =
        "[" + config_detail::number_text(at.x()) + ", " + config_detail::number_text(at.y()) + "]";
    const auto read = [range, unit](const ConfigValue& v, const std::string& name) {
      return config_detail::to_point(v, name, range, unit);
    };
    return measured(add(std::move(key), "point", std::move(meaning), default_text, member, read), unit, range);
  }
  FieldSpec& point(std::string key, std::optional<Point> Config::*member, const std::string& unit,
                   std::string meaning) {
    const auto read = [](const ConfigValue& v, const std::string& name) { return config_detail::to_point(v, name); };
    return measured(add(std::move(key), "point", std::move(meaning), "", member, read), unit);
  }
  FieldSpec& points(std::string key, std::vector<Point> Config::*member, const std::string& unit, std::string meaning) {
    return measured(add(std::move(key), "list of points", std::move(meaning), "", member, config_detail::to_points),
                    unit);
  }
  FieldSpec& numbers(std::string key, std::vector<double> Config::*member, Range range, const std::string& unit,
                     std::string meaning) {
    const auto read = [range](const ConfigValue& v, const std::string& name) {
      return config_detail::to_numbers(v, name, range);
    };
    return measured(add(std::move(key), "list of numbers", std::move(meaning), "", member, read), unit, range);
  }
  FieldSpec& texts(std::string key, std::vector<std::string> Config::*member, std::string meaning) {
    return add(std::move(key), "list of texts", std::move(meaning), "", member,
               config_detail::each_by(config_detail::to_text));
  }
  // A nested struct with its own describe(); what the file leaves out stays as the outer struct has it.
  template <class Sub>
  FieldSpec& group(std::string key, Sub Config::*member, std::string meaning) {
    Schema schema = schema_of<Sub>(defaults_.*member);
    FieldSpec& f = nested(schema_.fields.emplace_back(), schema);
    f.key = std::move(key);
    f.type = "map";
    f.meaning = std::move(meaning);
    f.load = [member, key = f.key, schema = std::move(schema)](void* c, const ConfigValue& v) {
      schema.load_into(&(static_cast<Config*>(c)->*member), v, key);
    };
    return f;
  }
  template <class Sub>
  FieldSpec& group(std::string key, std::optional<Sub> Config::*member, std::string meaning) {
    return nested(add(std::move(key), "map", std::move(meaning), "", member, loaded_by<Sub>()), schema_of<Sub>());
  }
  template <class Sub>
  FieldSpec& list(std::string key, std::vector<Sub> Config::*member, std::string meaning) {
    return nested(
        add(std::move(key), "list of maps", std::move(meaning), "", member, config_detail::each_by(loaded_by<Sub>())),
        schema_of<Sub>());
  }
  // A module of a kind (as name_of(PluginKind) says it) with its settings.
  FieldSpec& plugin(std::string key, PluginChoice Config::*member, std::string kind, std::string meaning) {
    const std::string usual = (defaults_.*member).name;
    FieldSpec& f = add(
        std::move(key), "plugin", std::move(meaning), usual, member,
        [usual](const ConfigValue& v, const std::string& name) { return config_detail::to_plugin(v, name, usual); });
    f.plugin_kind = std::move(kind);
    return f;
  }
  // Anything, kept as it stands (checked by whoever knows).
  FieldSpec& raw(std::string key, ConfigValue Config::*member, std::string type, std::string meaning) {
    return add(std::move(key), std::move(type), std::move(meaning), "", member,
               [](const ConfigValue& v, const std::string&) { return v; });
  }
  // An error names what stands in place of an old key: "`search.window_m`".
  void moved(std::string key, std::string now) { schema_.moved.push_back({std::move(key), std::move(now)}); }
  void shorthand(std::string key) { schema_.shorthand = std::move(key); }
  // Such a field has no default: what is left out does not apply.
  void one_of(std::vector<std::string> keys) {
    for (FieldSpec& f : schema_.fields)
      if (std::find(keys.begin(), keys.end(), f.key) != keys.end()) f.default_text.clear();
    schema_.one_of = std::move(keys);
  }

  [[nodiscard]] Schema take() && { return std::move(schema_); }

 private:
  // Sets the member to what `read` makes of the value and the key, which is for its errors.
  template <class Member, class Read>
  FieldSpec& add(std::string key, std::string type, std::string meaning, std::string default_text, Member member,
                 Read read) {
    FieldSpec& f = schema_.fields.emplace_back();
    f.key = std::move(key);
    f.type = std::move(type);
    f.meaning = std::move(meaning);
    f.default_text = std::move(default_text);
    f.load = [member, key = f.key, read = std::move(read)](void* c, const ConfigValue& v) {
      static_cast<Config*>(c)->*member = read(v, key);
    };
    return f;
  }
  static FieldSpec& measured(FieldSpec& field, const std::string& unit, const Range& range = {}) {
    field.unit = unit;
    field.range = range;
    return field;
  }
  template <class Sub>
  static auto loaded_by() {
    return [schema = schema_of<Sub>()](const ConfigValue& v, const std::string& name) {
      Sub sub;
      schema.load_into(&sub, v, name);
      return sub;
    };
  }
  static FieldSpec& nested(FieldSpec& field, const Schema& schema) {
    field.fields = schema.fields;
    field.shorthand = schema.shorthand;
    field.one_of = schema.one_of;
    return field;
  }

  Config defaults_;
  Schema schema_;
};

}  // namespace cairn
