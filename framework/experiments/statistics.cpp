#include "framework/experiments/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace cairn {

Estimate estimate_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto count = static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  if (values.size() == 1) return {mean, 0.0, 1};
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const boost::math::students_t distribution(count - 1.0);
  return {mean, boost::math::quantile(distribution, 0.975) * std::sqrt(squares / (count - 1.0) / count), values.size()};
}

std::string text_of(const Estimate& estimate, int decimals) {
  std::string text = fmt::format("{:.{}f}", estimate.mean, decimals);
  if (estimate.values > 1) text += fmt::format(" ± {:.{}f}", estimate.half_width, decimals);
  return text;
}

std::string text_of(const Interval& interval, int decimals) {
  std::string text = fmt::format("{:.{}f}", interval.value, decimals);
  if (std::isfinite(interval.low) && std::isfinite(interval.high))
    text += fmt::format(" ({:.{}f} - {:.{}f})", interval.low, decimals, interval.high, decimals);
  return text;
}

Interval share_of(std::int64_t successes, std::int64_t trials) {
  if (trials == 0) return {0.0, 0.0, 1.0};
  constexpr double kZ = 1.959963985;  // 97.5 % of the normal distribution
  const auto n = static_cast<double>(trials);
  const double p = static_cast<double>(successes) / n;
  const double middle = (p + kZ * kZ / (2.0 * n)) / (1.0 + kZ * kZ / n);
  const double half = kZ / (1.0 + kZ * kZ / n) * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n));
  return {p, std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

Interval resampled(std::size_t runs, const std::function<double(std::span<const std::size_t>)>& figure) {
  constexpr std::size_t kSamples = 1000;
  std::vector<std::size_t> all(runs);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (runs == 0) return {};
  constexpr double kNoEnd = std::numeric_limits<double>::infinity();
  if (runs == 1) return {figure(all), -kNoEnd, kNoEnd};
  std::mt19937_64 random(1);
  std::vector<double> values;
  std::vector<std::size_t> taken(runs);
  for (std::size_t i = 0; i < kSamples; ++i) {
    for (std::size_t& index : taken) index = static_cast<std::size_t>(random() % runs);
    values.push_back(figure(taken));
  }
  std::sort(values.begin(), values.end());
  return {figure(all), values[kSamples / 40], values[kSamples - 1 - kSamples / 40]};
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace cairn
