#include "framework/program/experiment/experiment_charts.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "framework/experiments/recognition/curves_table.hpp"
#include "framework/experiments/recognition/factor_table.hpp"
#include "framework/experiments/recognition/orbit_table.hpp"
#include "framework/experiments/recognition/recognition_table.hpp"
#include "framework/experiments/recognition/ring_table.hpp"
#include "framework/experiments/report.hpp"
#include "framework/files/world_file.hpp"
#include "framework/program/run/pictures.hpp"
#include "maps/pictures/drawing/chart.hpp"

namespace cairn {
namespace {

// A chart a measure: a place a mission, a series a variant, bars for the 95 % intervals.
Chart map_chart(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows, const RunMeasure& measure) {
  Chart chart;
  chart.title = measure.name + ", mean and 95 % interval";
  chart.y_label = measure.name;
  chart.x_names = missions_of(rows);
  double least = std::numeric_limits<double>::infinity();
  double most = 0.0;
  const auto variants = static_cast<double>(config.variants.size());
  for (std::size_t v = 0; v < config.variants.size(); ++v) {
    Series series{config.variants[v].name, {}, SeriesStyle::points, {}};
    const double beside = 0.7 * ((static_cast<double>(v) + 0.5) / variants - 0.5);
    for (std::size_t m = 0; m < chart.x_names.size(); ++m) {
      const std::vector<double> values = known_values(rows_of(rows, chart.x_names[m], series.name), measure);
      if (values.empty()) continue;
      const Estimate estimate = estimate_of(values);
      series.points.emplace_back(static_cast<double>(m) + beside, estimate.mean);
      series.half_widths.push_back(estimate.half_width);
      least = std::min(least, estimate.mean);
      most = std::max(most, estimate.mean);
    }
    chart.series.push_back(std::move(series));
  }
  chart.log_y = least > 0.0 && most > 10.0 * least;
  return chart;
}

std::string file_name_of(const std::string& title) {
  std::string name = title + ".png";
  std::replace(name.begin(), name.end(), ' ', '_');
  return name;
}

Chart orbit_chart(const ExperimentConfig& config, const std::vector<OrbitSeries>& all, const std::string& title) {
  Chart chart;
  chart.title = title;
  chart.x_label = "how far round the " + config.orbit->around + ", deg";
  chart.y_label = "degree";
  const double bin_deg = degrees(config.orbit->bin_rad);
  for (const OrbitSeries& of : all) {
    Series series{of.name, {}, SeriesStyle::lines_and_points, {}};
    for (std::size_t b = 0; b < of.bins.size(); ++b) {
      if (!of.bins[b]) continue;
      series.points.emplace_back(bin_deg * (static_cast<double>(b) + 0.5), of.bins[b]->mean);
      series.half_widths.push_back(of.bins[b]->half_width);
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

// Recall to the right, precision upwards: a curve a detector, and the mission itself as one point.
Chart curve_chart(const ExperimentConfig& config, const std::vector<const ExperimentRow*>& rows) {
  Chart chart;
  chart.title = "Precision and recall at every threshold, on the same grids";
  chart.x_label = "recall";
  chart.y_label = "precision";
  chart.of_shares = true;
  for (const ComparedDetector& detector : config.detectors) {
    Series series{detector.name, {}, SeriesStyle::lines, {}};
    for (const CurvePoint& point : precision_recall(worlds_of(rows, detector.name)))
      series.points.emplace_back(point.recall, point.precision);
    chart.series.push_back(std::move(series));
  }
  const RecognitionFigures own = recognition_figures(rows, rows.front()->step_rad);
  chart.series.push_back({"the mission itself", {{own.recall.value, own.precision.value}}, SeriesStyle::points, {}});
  return chart;
}

struct NamedChart {
  std::string file_name;
  Chart chart;
};

std::vector<NamedChart> map_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<NamedChart> charts;
  for (const RunMeasure& measure : map_measures()) {
    Chart chart = map_chart(config, rows, measure);
    if (std::ranges::all_of(chart.series, [](const Series& series) { return series.points.empty(); })) continue;
    charts.push_back({file_name_of(measure.name), std::move(chart)});
  }
  return charts;
}

// Draws the charts of each mission with each variant; the prefix of their names is empty when there is only one.
template <class Draw>
void for_each_variant(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows, Draw draw) {
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      const auto of_variant = rows_of(rows, mission, variant.name);
      const bool alone = of_variant.size() == rows.size();
      draw(of_variant, alone ? "" : mission + " " + variant.name + " ");
    }
}

std::vector<NamedChart> orbit_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<NamedChart> charts;
  for_each_variant(config, rows, [&](const auto& of_variant, const std::string& prefix) {
    const std::string name = prefix.empty() ? "orbit " : prefix;
    charts.push_back({file_name_of(name + "categories"),
                      orbit_chart(config, orbit_categories(config, of_variant), "Best degree of each category")});
    const std::vector<OrbitSeries> templates = orbit_templates(config, of_variant);
    if (!templates.empty())
      charts.push_back({file_name_of(name + "templates"),
                        orbit_chart(config, templates, "Best degree of each template of the " + config.orbit->around)});
  });
  return charts;
}

std::vector<NamedChart> curve_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<NamedChart> charts;
  for_each_variant(config, rows, [&](const auto& of_variant, const std::string& prefix) {
    if (!of_variant.empty()) charts.push_back({file_name_of(prefix + "curves"), curve_chart(config, of_variant)});
  });
  return charts;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

// Precision, recall and F1 at each value of a factor; values that are no numbers stand side by side.
Chart factor_chart(const FactorConfig& factor, const std::vector<FactorPoint>& points) {
  Chart chart;
  chart.title = "Recognition against " + factor.name + ", with 95 % intervals";
  chart.x_label = factor.label;
  chart.y_label = "share";
  chart.of_shares_over_x = true;
  const bool numbers = std::ranges::all_of(points, [](const FactorPoint& p) { return number_of(p.value).has_value(); });
  const std::pair<const char*, Interval RecognitionFigures::*> kShown[] = {
      {"F1", &RecognitionFigures::f1},
      {"precision", &RecognitionFigures::precision},
      {"recall", &RecognitionFigures::recall}};
  for (const auto& [name, figure] : kShown) {
    Series series{name, {}, SeriesStyle::lines_and_points, {}};
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Interval& interval = points[i].figures.*figure;
      const double x = numbers ? *number_of(points[i].value) : static_cast<double>(i);
      series.points.emplace_back(x, interval.value);
      series.ends.emplace_back(std::clamp(interval.low, 0.0, 1.0), std::clamp(interval.high, 0.0, 1.0));
    }
    chart.series.push_back(std::move(series));
  }
  if (!numbers)
    for (const FactorPoint& point : points) chart.x_names.push_back(point.value);
  return chart;
}

std::vector<NamedChart> factor_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<NamedChart> charts;
  const std::vector<std::string> missions = missions_of(rows);
  for (const std::string& mission : missions)
    for (const FactorConfig& factor : config.vary) {
      const std::string prefix = missions.size() == 1 ? "" : mission + " ";
      charts.push_back(
          {file_name_of(prefix + factor.name), factor_chart(factor, factor_points(config, factor, rows, mission))});
    }
  return charts;
}

// A line a variant: mean OL across the landmarks' outlines.
std::vector<NamedChart> ring_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<NamedChart> charts;
  for (const std::string& mission : missions_of(rows)) {
    Chart chart;
    chart.title = "Finished maps across the landmarks' outlines, with 95 % intervals";
    chart.x_label = "distance from the true outline, m (positive outside)";
    chart.y_label = "mean OL";
    for (const ExperimentVariant& variant : config.variants) {
      if (!variant.factor.empty()) continue;
      Series series{variant.name, {}, SeriesStyle::lines, {}};
      for (const RingBin& bin : ring_bins(rows_of(rows, mission, variant.name))) {
        series.points.emplace_back(bin.distance_m, bin.ol.value);
        series.ends.emplace_back(bin.ol.low, bin.ol.high);
      }
      chart.series.push_back(std::move(series));
    }
    charts.push_back({file_name_of(missions_of(rows).size() == 1 ? "ring" : mission + " ring"), std::move(chart)});
  }
  return charts;
}

// The map of the first seed.
void write_map(const ExperimentRow& row, const std::filesystem::path& file) {
  if (row.result.map_file.empty()) throw std::runtime_error(file.string() + ": the run saved no map");
  draw_saved_map(file, load_map(row.folder / row.result.map_file), row.mission + ", seed " + std::to_string(row.seed));
}

std::vector<std::string> write_place_maps(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                                          const std::filesystem::path& out) {
  std::vector<std::string> missing;
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      const auto of_variant = rows_of(rows, mission, variant.name);
      if (of_variant.empty()) continue;
      const bool alone = of_variant.size() == rows.size();
      try {
        write_map(*of_variant.front(), out / file_name_of(alone ? "map" : mission + " " + variant.name + " map"));
      } catch (const std::exception& error) {
        missing.emplace_back(error.what());
      }
    }
  return missing;
}

// The map of a home with the truth in its colours, in the run's folder.
void write_home_map(const ExperimentConfig& config, const ExperimentRow& row) {
  if (row.result.map_file.empty()) throw std::runtime_error(row.folder.string() + ": the run saved no map");
  const Home home = random_home(config.homes, static_cast<std::uint64_t>(row.seed));
  const World world = load_world(row.folder / "world.yaml", {});
  DrawnTruth truth{&world, {}, {}};
  for (const HomeDoor& door : home.doors) truth.doors.push_back({door.from_m(), door.to_m()});
  for (const int i : row.home->not_entered) {
    const HomeRoom& room = home.rooms.at(static_cast<std::size_t>(i));
    truth.not_entered.push_back({room.min_m, room.max_m, "not entered"});
  }
  draw_over_truth(row.folder / "map.png", load_map(row.folder / row.result.map_file), truth,
                  row.variant + ", home " + std::to_string(row.seed));
}

std::vector<std::string> write_home_maps(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::vector<std::string> missing;
  for (const ExperimentRow& row : rows) {
    if (!row.home) continue;
    try {
      write_home_map(config, row);
    } catch (const std::exception& error) {
      missing.emplace_back(error.what());
    }
  }
  return missing;
}

}  // namespace

std::vector<std::string> write_charts(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                                      const std::filesystem::path& out) {
  std::vector<NamedChart> charts;
  if (config.experiment == ExperimentKind::maps) charts = map_charts(config, rows);
  if (config.experiment == ExperimentKind::orbit) charts = orbit_charts(config, rows);
  if (!config.vary.empty()) charts = factor_charts(config, rows);
  if (config.ring_profile) std::ranges::move(ring_charts(config, rows), std::back_inserter(charts));
  if (config.experiment == ExperimentKind::curves) charts = curve_charts(config, rows);
  std::vector<std::string> missing;
  if (config.experiment == ExperimentKind::homes) missing = write_home_maps(config, rows);
  if (config.experiment == ExperimentKind::places) missing = write_place_maps(config, rows, out);
  for (const NamedChart& named : charts) {
    const ChartOutcome outcome = write_chart(out / named.file_name, named.chart);
    if (!outcome.drawn) missing.push_back(outcome.reason);
  }
  return missing;
}

}  // namespace cairn
