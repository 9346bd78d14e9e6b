#include "framework/experiments/recognition/ring_table.hpp"

#include <fmt/format.h>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

RingProfile sum_of(const Rows& rows, std::span<const std::size_t> taken) {
  RingProfile sum;
  for (const std::size_t index : taken) sum += rows[index]->ring;
  return sum;
}

}  // namespace

std::vector<RingBin> ring_bins(const Rows& rows) {
  std::vector<RingBin> bins;
  for (std::size_t b = 0; b < static_cast<std::size_t>(kProfileBins); ++b) {
    const auto mean_ol = [&](std::span<const std::size_t> taken) {
      double ol = 0.0;
      double cells = 0.0;
      for (const std::size_t index : taken) {
        ol += rows[index]->ring.ol[b];
        cells += static_cast<double>(rows[index]->ring.cells[b]);
      }
      return cells > 0.0 ? ol / cells : 0.0;
    };
    bool any = false;
    for (const ExperimentRow* row : rows) any = any || row->ring.cells[b] > 0;
    if (any)
      bins.push_back(
          {kProfileBegin_m + (static_cast<double>(b) + 0.5) * kProfileStep_m, resampled(rows.size(), mean_ol)});
  }
  return bins;
}

std::string ring_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  if (!config.ring_profile) return {};
  std::string text;
  for (const std::string& mission : missions_of(rows)) {
    text += fmt::format(
        "## {}: where the ring lies\n\nDistance from a landmark's true outline to the middle of its "
        "ring of occupied cells, positive outside; 95 % intervals from resampling the worlds.\n\n",
        mission);
    text += table_head({"variant", "worlds", "ring at m"});
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      if (of_variant.empty() || !variant.factor.empty()) continue;
      const Interval ring = resampled(
          of_variant.size(), [&](std::span<const std::size_t> taken) { return sum_of(of_variant, taken).ring_at_m(); });
      text += fmt::format("| {} | {} | {} |\n", variant.name, of_variant.size(), text_of(ring));
    }
    text += "\n";
  }
  return text;
}

}  // namespace cairn
