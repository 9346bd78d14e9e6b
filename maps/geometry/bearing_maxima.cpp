#include "maps/geometry/bearing_maxima.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "maps/geometry/pose.hpp"

namespace cairn {

BearingMaxima::BearingMaxima(std::vector<Entry> entries) : entries_(std::move(entries)) {
  if (!std::ranges::is_sorted(entries_, {}, &Entry::bearing_rad)) std::ranges::sort(entries_, {}, &Entry::bearing_rad);
  const std::size_t count = entries_.size();
  if (count == 0) return;
  rows_.resize(std::bit_width(count));
  for (const Entry& entry : entries_) rows_[0].push_back(entry.value);
  for (std::size_t row = 1; row < rows_.size(); ++row) {
    const std::size_t half = std::size_t{1} << (row - 1);
    const std::vector<double>& shorter = rows_[row - 1];
    rows_[row].resize(count + 1 - 2 * half);
    for (std::size_t i = 0; i < rows_[row].size(); ++i) rows_[row][i] = std::max(shorter[i], shorter[i + half]);
  }
}

double BearingMaxima::max_within(double bearing_rad, double half_rad) const {
  constexpr double kPi = std::numbers::pi;
  if (half_rad >= kPi) return max_between(-kPi, kPi);
  const double middle_rad = std::abs(bearing_rad) <= kPi ? bearing_rad : wrap_angle(bearing_rad);
  const double low_rad = middle_rad - half_rad;
  const double high_rad = middle_rad + half_rad;
  double largest = max_between(low_rad, high_rad);
  if (low_rad < -kPi) largest = std::max(largest, max_between(low_rad + 2.0 * kPi, kPi));
  if (high_rad > kPi) largest = std::max(largest, max_between(-kPi, high_rad - 2.0 * kPi));
  return largest;
}

double BearingMaxima::max_between(double low_rad, double high_rad) const {
  const auto from = std::ranges::lower_bound(entries_, low_rad, {}, &Entry::bearing_rad);
  const auto to = std::ranges::upper_bound(entries_, high_rad, {}, &Entry::bearing_rad);
  if (from >= to) return -std::numeric_limits<double>::infinity();
  const auto begin = static_cast<std::size_t>(from - entries_.begin());
  const auto end = static_cast<std::size_t>(to - entries_.begin());
  const std::vector<double>& row = rows_[static_cast<std::size_t>(std::bit_width(end - begin)) - 1];
  return std::max(row[begin], row[end - std::bit_floor(end - begin)]);
}

}  // namespace cairn
