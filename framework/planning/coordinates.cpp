#include "framework/planning/coordinates.hpp"

#include <algorithm>

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

}  // namespace cairn
