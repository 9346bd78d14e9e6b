// What the matchings of a run said at given places of its drive (the paper's Table 1).
#pragma once

#include <filesystem>
#include <vector>

#include "framework/experiments/config.hpp"
#include "framework/mission/mission.hpp"
#include "framework/mission/runner.hpp"
#include "framework/reporting/report.hpp"

namespace cairn {

// Degrees in the order of the experiment's categories; empty when nothing has looked at the landmark yet.
struct PlaceDegrees {
  std::vector<double> degrees;
  double time_s = 0.0;  // of that matching
};

// One a place: of the last matching, up to the end of the place's step, that looked at its landmark. A
// category that the matching does not report has degree 0. A run that ended early has fewer places.
[[nodiscard]] std::vector<PlaceDegrees> degrees_at_places(const ExperimentConfig& config, const World& world,
                                                          const std::vector<DegreeSample>& samples,
                                                          const std::vector<StepReport>& steps);

// Whether the mission has a step for each place and, in its world, one landmark of each category looked
// at. Throws ConfigError.
void check_places(const ExperimentConfig& config, const Mission& mission, const std::filesystem::path& file);

// The degrees in the order of the categories; 0 for one that is not among those found.
[[nodiscard]] std::vector<double> degrees_in_order(const std::vector<CategoryDegree>& found,
                                                   const std::vector<std::string>& categories);
// Throws ConfigError unless the mission's world has exactly one landmark of the category that "who" names.
void require_one(const Mission& mission, const std::string& category, const std::string& who,
                 const std::filesystem::path& file);

}  // namespace cairn
