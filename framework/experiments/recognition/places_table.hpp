// The degrees at the places of a drive as a table, beside those published elsewhere.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"

namespace cairn {

// Markdown; a table a mission and variant. Means over the seeds with 95 % intervals.
[[nodiscard]] std::string places_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

// By how much the true category's degree leads the best other one; negative: it does not.
[[nodiscard]] double margin_of(const std::vector<double>& degrees, std::size_t true_category);

// Of the pairs of categories that differ in the expected degrees, how many differ the same way in these.
struct SharedOrder {
  int same = 0;
  int pairs = 0;
};
[[nodiscard]] SharedOrder shared_order(const std::vector<double>& degrees, const std::vector<double>& expected);

}  // namespace cairn
