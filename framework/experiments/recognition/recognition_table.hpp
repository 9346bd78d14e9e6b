// How well landmarks were recognised in many worlds: figures with 95 % intervals, and who was taken for whom.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {

// Intervals of shares are Wilson's; that of F1 and of the median is from resampling the worlds.
struct RecognitionFigures {
  Interval precision;       // of the landmarks found, those where one of that category is
  Interval recall;          // of the true landmarks, those found with the right category
  Interval f1;              // harmonic mean of the two
  Interval right_category;  // of the true landmarks that something was found at
  Interval median_error_m;  // position, of the right ones
  Interval within_step;     // orientation, of the right ones that are not round
  Estimate driven_m;        // until first known, of the right ones
  Estimate matchings;       // in a run
};
[[nodiscard]] RecognitionFigures recognition_figures(const std::vector<const ExperimentRow*>& rows, double step_rad);

// The same worlds and seeds with a variant and with the baseline.
struct BaselineFigures {
  int worlds = 0;
  int same_drives = 0;  // to the last bit as far and as long: only then is the same looked at
  Interval matchings;   // of the baseline, for each one of the variant; interval from resampling the worlds
  Interval lost;        // of the landmarks that the baseline finds right, those that the variant does not
};
[[nodiscard]] BaselineFigures baseline_figures(const std::vector<const ExperimentRow*>& rows,
                                               const std::vector<const ExperimentRow*>& baseline);

// Markdown. Compares with the baseline when the experiment names one.
[[nodiscard]] std::string recognition_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
