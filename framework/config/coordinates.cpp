#include "framework/config/coordinates.hpp"

#include <algorithm>

#include "framework/config/fields.hpp"
#include "maps/base/text.hpp"

namespace cairn {

std::optional<std::vector<double>> coordinates_in(std::string_view text) {
  std::string_view rest = trimmed(text);
  if (rest.starts_with('[') != rest.ends_with(']')) return std::nullopt;
  if (rest.starts_with('[')) rest = rest.substr(1, rest.size() - 2);
  std::vector<double> values;
  while (true) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto value = number_from<double>(trimmed(rest.substr(0, comma)));
    if (!value) return std::nullopt;
    values.push_back(*value);
    if (comma == rest.size()) return values;
    rest.remove_prefix(comma + 1);
  }
}

std::optional<Point> point_in(const ConfigValue& value, const std::string& key) {
  if (value.kind == ConfigValue::Kind::list) return config_detail::to_point(value, key);
  const auto numbers = value.kind == ConfigValue::Kind::scalar ? coordinates_in(value.scalar) : std::nullopt;
  if (!numbers || numbers->size() == 1) return std::nullopt;  // a number alone may be a name
  ConfigValue list;
  list.kind = ConfigValue::Kind::list;
  list.place = value.place;
  for (const double number : *numbers) {
    ConfigValue& item = list.items.emplace_back();
    item.kind = ConfigValue::Kind::scalar;
    item.place = value.place;
    item.scalar = config_detail::number_text(number);
  }
  return config_detail::to_point(list, key);
}

}  // namespace cairn
