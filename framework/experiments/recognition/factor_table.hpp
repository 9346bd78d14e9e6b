// What one factor does to recognition: figures at each of its values, as a table and as what a chart draws.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/recognition/recognition_table.hpp"

namespace cairn {

struct FactorPoint {
  std::string value;
  std::size_t worlds = 0;
  RecognitionFigures figures;
};
// In the order of the factor's values.
[[nodiscard]] std::vector<FactorPoint> factor_points(const ExperimentConfig& config, const FactorConfig& factor,
                                                     const std::vector<ExperimentRow>& rows,
                                                     const std::string& mission);

// Markdown: a table a mission and factor.
[[nodiscard]] std::string factor_tables(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
