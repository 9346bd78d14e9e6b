// What the matchings of a run said along an orbit round one landmark (the paper's Fig. 6).
#pragma once

#include <map>
#include <vector>

#include "framework/experiments/config.hpp"
#include "framework/reporting/report.hpp"

namespace cairn {

// One matching that looked at the landmark.
struct OrbitSample {
  double angle_rad = 0.0;           // how far round the landmark the robot had come, either way
  std::vector<double> categories;   // best degrees, in the order of the experiment's categories
  std::map<int, double> templates;  // of the landmark's category: best degree by orientation, whole degrees
};

// Angles count from the start and add up from matching to matching, so the robot must not go half round
// between two of them. Only one orbit: what comes after it is left out.
[[nodiscard]] std::vector<OrbitSample> degrees_along_orbit(const ExperimentConfig& config, const World& world,
                                                           const Point& start_m,
                                                           const std::vector<DegreeSample>& samples);

}  // namespace cairn
