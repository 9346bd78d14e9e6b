#include "framework/experiments/recognition/factor_table.hpp"

#include <fmt/format.h>

#include "framework/experiments/report.hpp"

namespace cairn {

std::vector<FactorPoint> factor_points(const ExperimentConfig& config, const FactorConfig& factor,
                                       const std::vector<ExperimentRow>& rows, const std::string& mission) {
  std::vector<FactorPoint> points;
  for (const ExperimentVariant& variant : config.variants) {
    if (variant.factor != factor.name) continue;
    const std::vector<const ExperimentRow*> of_variant = rows_of(rows, mission, variant.name);
    if (of_variant.empty()) continue;
    points.push_back({variant.value, of_variant.size(), recognition_figures(of_variant, of_variant.front()->step_rad)});
  }
  return points;
}

std::string factor_tables(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows))
    for (const FactorConfig& factor : config.vary) {
      text += fmt::format("## {}: {}\n\n", mission, factor.name);
      text += table_head({factor.label, "worlds", "precision", "recall", "F1", "right category", "median error m",
                          "within one step", "matchings"},
                         0);
      for (const FactorPoint& point : factor_points(config, factor, rows, mission)) {
        const RecognitionFigures& f = point.figures;
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", point.value, point.worlds,
                            text_of(f.precision), text_of(f.recall), text_of(f.f1), text_of(f.right_category),
                            text_of(f.median_error_m), text_of(f.within_step), text_of(f.matchings, 0));
      }
      text += "\n";
    }
  return text;
}

}  // namespace cairn
