// Figures over many runs, each with its uncertainty.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace cairn {

// A mean with the half width of its 95 % interval (Student's t). Fewer than two values have no interval:
// half width 0.
struct Estimate {
  double mean = 0.0;
  double half_width = 0.0;
  std::size_t values = 0;
};
[[nodiscard]] Estimate estimate_of(const std::vector<double>& values);
// "1.23 ± 0.04", or "1.23" where there is no interval.
[[nodiscard]] std::string text_of(const Estimate& estimate, int decimals);

// A figure with its 95 % interval.
struct Interval {
  double value = 0.0;
  double low = 0.0;
  double high = 0.0;
};
// "0.123 (0.100 - 0.150)"; the figure alone where its interval is without ends.
[[nodiscard]] std::string text_of(const Interval& interval, int decimals = 3);

// A share with Wilson's interval, which is honest near 0 and 1 too. Of no trials: 0, from 0 to 1.
[[nodiscard]] Interval share_of(std::int64_t successes, std::int64_t trials);

// Any figure of a whole set of runs, with the percentile interval of 1000 resamplings of the runs (always
// the same ones), which of one run is without ends. The figure is given the indices of the runs to take, some more than
// once.
[[nodiscard]] Interval resampled(std::size_t runs, const std::function<double(std::span<const std::size_t>)>& figure);

// Of an even number the mean of the middle two; 0 of none.
[[nodiscard]] double median_of(std::vector<double> values);

}  // namespace cairn
