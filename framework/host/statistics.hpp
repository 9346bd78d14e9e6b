// Figures over many runs, each with its uncertainty.
#pragma once

#include <vector>

namespace cairn {

// A mean with the half width of its 95 % interval (Student's t; 0 for fewer than two values).
struct Estimate {
  double mean = 0.0;
  double half_width = 0.0;
};
[[nodiscard]] Estimate estimate_of(const std::vector<double>& values);

}  // namespace cairn
