#include "framework/experiments/recognition/orbit_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

std::size_t bins_of(const ExperimentConfig& config) {
  return static_cast<std::size_t>(std::ceil(2.0 * std::numbers::pi / config.orbit->bin_rad - 1e-9));
}

// value: of a sample, or nothing where it has none.
template <class Value>
OrbitSeries series_of(const ExperimentConfig& config, const Rows& rows, std::string name, Value&& value) {
  std::vector<std::vector<double>> in_bins(bins_of(config));
  for (const ExperimentRow* row : rows) {
    std::vector<std::optional<double>> last(in_bins.size());
    for (const OrbitSample& sample : row->orbit) {
      const auto bin = static_cast<std::size_t>(sample.angle_rad / config.orbit->bin_rad);
      if (const std::optional<double> v = value(sample); v && bin < last.size()) last[bin] = v;
    }
    for (std::size_t b = 0; b < last.size(); ++b)
      if (last[b]) in_bins[b].push_back(*last[b]);
  }
  OrbitSeries series{std::move(name), {}};
  for (const std::vector<double>& values : in_bins)
    series.bins.push_back(values.empty() || 2 * values.size() < rows.size() ? std::nullopt
                                                                            : std::optional(estimate_of(values)));
  return series;
}

std::string table_of(const ExperimentConfig& config, const std::vector<OrbitSeries>& all) {
  std::vector<std::string> columns{"orbit, deg"};
  for (const OrbitSeries& series : all) columns.push_back(series.name);
  std::string text = table_head(columns, 0);
  for (std::size_t b = 0; b < bins_of(config); ++b) {
    const double bin_deg = degrees(config.orbit->bin_rad);
    text += fmt::format("| {:.0f} - {:.0f} |", bin_deg * static_cast<double>(b),
                        std::min(360.0, bin_deg * static_cast<double>(b + 1)));
    for (const OrbitSeries& series : all) text += series.bins[b] ? " " + text_of(*series.bins[b], 2) + " |" : " |";
    text += "\n";
  }
  return text + "\n";
}

}  // namespace

std::vector<OrbitSeries> orbit_categories(const ExperimentConfig& config, const Rows& rows) {
  std::vector<OrbitSeries> all;
  for (std::size_t k = 0; k < config.categories.size(); ++k)
    all.push_back(series_of(config, rows, config.categories[k],
                            [k](const OrbitSample& sample) { return std::optional(sample.categories[k]); }));
  return all;
}

std::vector<OrbitSeries> orbit_templates(const ExperimentConfig& config, const Rows& rows) {
  std::set<int> orientations;
  for (const ExperimentRow* row : rows)
    for (const OrbitSample& sample : row->orbit)
      for (const auto& [orientation_deg, degree] : sample.templates) orientations.insert(orientation_deg);
  std::vector<OrbitSeries> all;
  all.reserve(orientations.size());
  for (const int orientation_deg : orientations)
    all.push_back(series_of(config, rows, template_name(config, orientation_deg), [&](const OrbitSample& sample) {
      const auto found = sample.templates.find(orientation_deg);
      return found == sample.templates.end() ? std::nullopt : std::optional(found->second);
    }));
  return all;
}

std::string template_name(const ExperimentConfig& config, int orientation_deg) {
  return fmt::format("{} {} deg", config.orbit->around, orientation_deg);
}

std::map<int, int> best_at_the_end(const Rows& rows) {
  std::map<int, int> runs;
  for (const ExperimentRow* row : rows) {
    if (row->orbit.empty() || row->orbit.back().templates.empty()) continue;
    ++runs[std::ranges::max_element(row->orbit.back().templates, {}, [](const auto& t) { return t.second; })->first];
  }
  return runs;
}

std::string orbit_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      text +=
          fmt::format("## {}, {}\n\nDegrees along one orbit round the {}, mean and 95 % interval over {} seeds.\n\n",
                      mission, variant.name, config.orbit->around, of_variant.size());
      text += table_of(config, orbit_categories(config, of_variant));
      const std::vector<OrbitSeries> templates = orbit_templates(config, of_variant);
      if (templates.empty()) continue;
      text += table_of(config, templates) + "Fits best at the end:";
      for (const auto& [orientation_deg, runs] : best_at_the_end(of_variant))
        text += fmt::format(" {} in {} of {} runs.", template_name(config, orientation_deg), runs, of_variant.size());
      text += "\n\n";
    }
  return text;
}

}  // namespace cairn
