// Values at bearings, and the largest one in a window of bearings: what a fan of rays says about a direction.
//
// Built in O(n log n); a question takes O(log n).
#pragma once

#include <vector>

namespace cairn {

class BearingMaxima {
 public:
  struct Entry {
    double bearing_rad = 0.0;  // in [-pi, pi]
    double value = 0.0;
  };

  BearingMaxima() = default;
  explicit BearingMaxima(std::vector<Entry> entries);

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  // The largest value of those whose bearing is at most half_rad off; -infinity when there is none.
  [[nodiscard]] double max_within(double bearing_rad, double half_rad) const;

 private:
  [[nodiscard]] double max_between(double low_rad, double high_rad) const;

  std::vector<Entry> entries_;  // bearings rising
  // Row by row: the largest of 2^row entries from each on.
  std::vector<std::vector<double>> rows_;
};

}  // namespace cairn
