#include "plugins/common/logs/log_line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "maps/base/text.hpp"

namespace cairn::log_common {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr double kLargestCount = 1e6;

// How old Windows programs write what is no number: "1.#INF", "-1.#IND", "1.#QNAN00".
std::optional<double> odd_number(std::string_view text) {
  const bool is_negative = text.starts_with('-');
  if (is_negative) text.remove_prefix(1);
  if (!text.starts_with("1.#")) return std::nullopt;
  const double infinity = std::numeric_limits<double>::infinity();
  if (text.substr(3).starts_with("INF")) return is_negative ? -infinity : infinity;
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

bool read_number(std::string_view text, double& value) {
  if (const std::optional<double> odd = odd_number(text)) {
    value = *odd;
    return true;
  }
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return !text.empty() && error == std::errc{} && end == text.data() + text.size();
}

void LogLine::cut(std::string_view text, int line, std::optional<char> separator) {
  text_ = text;
  line_ = line;
  words_.clear();
  if (separator) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(*separator, begin), text.size());
      words_.push_back(trimmed(text.substr(begin, end - begin), kBlank));
      begin = end + 1;
    }
    return;
  }
  std::size_t begin = text.find_first_not_of(kBlank);
  while (begin != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(kBlank, begin), text.size());
    words_.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlank, end);
  }
}

SourcePlace LogLine::place(std::size_t i) const {
  const std::size_t at = i < words_.size() ? static_cast<std::size_t>(words_[i].data() - text_.data()) : text_.size();
  return {file_, line_, static_cast<int>(at) + 1};
}

double LogLine::number(std::size_t i, std::string_view what) const {
  double value = 0.0;
  if (i >= words_.size()) throw ConfigError(place(i), "the line ends where the " + std::string(what) + " must be");
  if (!read_number(words_[i], value))
    throw ConfigError(place(i), "the " + std::string(what) + " must be a number, not " + in_quotes(words_[i]));
  return value;
}

double LogLine::finite(std::size_t i, std::string_view what) const {
  const double value = number(i, what);
  if (!std::isfinite(value))
    throw ConfigError(place(i), "the " + std::string(what) + " must be finite, not " + in_quotes(words_[i]));
  return value;
}

double LogLine::metres(std::size_t i, std::string_view what) const {
  const double value = finite(i, what);
  if (std::abs(value) > kFarthest_m)
    throw ConfigError(place(i), "the " + std::string(what) + " is beyond 100 km: " + in_quotes(words_[i]));
  return value;
}

double LogLine::heading(std::size_t i) const {
  constexpr double kMax_rad = 1e6;  // an unwrapped heading counts turns; beyond that it is not a heading
  const double value = finite(i, "heading");
  if (std::abs(value) > kMax_rad) throw ConfigError(place(i), "the heading is not an angle: " + in_quotes(words_[i]));
  return value;
}

Pose2 LogLine::pose(std::size_t i) const {
  return {metres(i, "x"), metres(i + 1, "y"), wrap_angle(heading(i + 2))};
}

double LogLine::range_m(std::size_t i) const {
  const double value = number(i, "range");
  return std::abs(value) > kFarthest_m ? std::copysign(std::numeric_limits<double>::infinity(), value) : value;
}

std::vector<double> LogLine::ranges_m(std::size_t first, std::size_t count, std::size_t step) const {
  std::vector<double> ranges_m(count);
  for (std::size_t i = 0; i < count; ++i) ranges_m[i] = range_m(first + step * i);
  return ranges_m;
}

std::size_t LogLine::count(std::size_t i, std::string_view what) const {
  const double value = number(i, what);
  if (!(value >= 0.0 && value <= kLargestCount) || value != std::floor(value))
    throw ConfigError(place(i), "the " + std::string(what) + " must be a whole number from 0 to 1000000, not " +
                                    in_quotes(words_[i]));
  return static_cast<std::size_t>(value);
}

}  // namespace cairn::log_common
