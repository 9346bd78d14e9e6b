#include "framework/program/map/number_list.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn {

std::vector<double> number_list(std::string_view text, std::string_view names, const std::string& what, double most) {
  const auto fail = [&] {
    throw std::runtime_error(what + " must be " + std::string(names) + ", finite numbers within +-" +
                             exchange::number_text(most) + " with commas between them, found " + in_quotes(text));
  };
  const auto wanted = static_cast<std::size_t>(1 + std::ranges::count(names, ','));
  std::vector<double> numbers;
  for (std::string_view rest = text;;) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    const auto number = number_from<double>(trimmed(rest.substr(0, comma), " "));
    if (!number || !(std::abs(*number) <= most)) fail();
    numbers.push_back(*number);
    if (comma == rest.size()) break;
    rest.remove_prefix(comma + 1);
  }
  if (numbers.size() != wanted) fail();
  return numbers;
}

}  // namespace cairn
