#include "framework/program/map/number_list.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/config/coordinates.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {

std::vector<double> number_list(std::string_view text, std::string_view names, const std::string& what, double most) {
  const auto fail = [&] {
    throw std::runtime_error(what + " must be " + std::string(names) + ", finite numbers within +-" +
                             exchange::number_text(most) + " with commas between them, found " + in_quotes(text));
  };
  const auto wanted = static_cast<std::size_t>(1 + std::ranges::count(names, ','));
  std::vector<double> numbers = coordinates_in(text).value_or(std::vector<double>{});
  const auto is_within = [&](double number) { return std::abs(number) <= most; };
  if (numbers.size() != wanted || !std::ranges::all_of(numbers, is_within)) fail();
  return numbers;
}

}  // namespace cairn
