// What an experiment found, as tables, JSON and charts; none of them holds wall clock times.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {

// One figure of a run, as the tables and charts of maps name it.
struct RunMeasure {
  std::string name;
  double (*of)(const ExperimentRow& row);
  bool needs_truth = true;

  // Only of a run that ended well: half a drive makes half a map.
  [[nodiscard]] bool is_known(const ExperimentRow& row) const;
};
[[nodiscard]] const std::vector<RunMeasure>& map_measures();

[[nodiscard]] std::vector<double> known_values(const std::vector<const ExperimentRow*>& rows,
                                               const RunMeasure& measure);

// Rows of one mission in one variant, in the order of seeds.
[[nodiscard]] std::vector<const ExperimentRow*> rows_of(const std::vector<ExperimentRow>& rows,
                                                        const std::string& mission, const std::string& variant);
// The names in the order of the rows, each once.
[[nodiscard]] std::vector<std::string> missions_of(const std::vector<ExperimentRow>& rows);

// The head of a Markdown table. The columns behind the first `texts` hold numbers.
[[nodiscard]] std::string table_head(const std::vector<std::string>& columns, std::size_t texts = 1);

// Markdown. Of missions a row a seed; of maps a row a variant with means and 95 % intervals, and the
// difference from the baseline on the same seeds.
[[nodiscard]] std::string table_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);
[[nodiscard]] std::string json_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
