// Samples of a quantity in the order of time, at even intervals and at most so many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cairn {

// Takes every sample until it is full. Then every second one goes, and only every second one is taken from then on, and
// so on: what it holds depends on the samples alone. Amortised O(1).
template <class Sample>
class ThinnedSeries {
 public:
  // At least two. Up to so many usual ones, taking one allocates nothing.
  explicit ThinnedSeries(std::size_t max_samples) : max_(std::max<std::size_t>(2, max_samples)) {
    samples_.reserve(std::min(max_, kUsualSamples));
  }

  void add(Sample sample) {
    const std::int64_t number = offered_++;
    if (number % every_ != 0) return;
    if (samples_.size() >= max_) {
      halve();
      if (number % every_ != 0) return;
    }
    samples_.push_back(std::move(sample));
  }

  // Whether the next one that is offered may be kept; skip() offers one that is not.
  [[nodiscard]] bool wants_next() const { return offered_ % every_ == 0; }
  void skip() { ++offered_; }

  [[nodiscard]] const std::vector<Sample>& samples() const { return samples_; }
  [[nodiscard]] std::int64_t every() const { return every_; }  // that one in so many is kept

 private:
  void halve() {
    std::size_t kept = 1;
    for (std::size_t i = 2; i < samples_.size(); i += 2) samples_[kept++] = std::move(samples_[i]);
    samples_.erase(samples_.begin() + static_cast<std::ptrdiff_t>(kept), samples_.end());
    every_ *= 2;
  }

  static constexpr std::size_t kUsualSamples = 10'000;

  std::size_t max_;
  std::vector<Sample> samples_;
  std::int64_t offered_ = 0;
  std::int64_t every_ = 1;
};

}  // namespace cairn
