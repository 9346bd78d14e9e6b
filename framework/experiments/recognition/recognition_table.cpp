#include "framework/experiments/recognition/recognition_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "framework/experiments/recognition/precision_recall.hpp"
#include "framework/experiments/report.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

template <class Value>
std::vector<double> of_right_ones(const Rows& rows, Value&& value) {
  std::vector<double> values;
  for (const ExperimentRow* row : rows)
    for (const Verdict& verdict : row->verdicts)
      if (verdict.is_right()) values.push_back(value(verdict));
  return values;
}

Rows taken_of(const Rows& rows, std::span<const std::size_t> taken) {
  Rows some;
  for (const std::size_t index : taken) some.push_back(rows[index]);
  return some;
}

std::string name_of_category(const std::string& category) {
  return category.empty() ? "none" : category;
}

// Rows are what is there, columns what was found.
std::string confusion(const Rows& rows) {
  std::map<std::string, std::map<std::string, int>> counts;
  std::set<std::string> names;
  for (const ExperimentRow* row : rows)
    for (const Verdict& verdict : row->verdicts) {
      names.insert({verdict.is, verdict.found, ""});
      ++counts[verdict.is][verdict.found];
    }
  std::vector<std::string> columns{"is \\\\ found"};
  for (const std::string& name : names) columns.push_back(name_of_category(name));
  std::string text = table_head(columns);
  for (const std::string& is : names) {
    text += "| " + name_of_category(is) + " |";
    for (const std::string& found : names) text += fmt::format(" {} |", counts[is][found]);
    text += "\n";
  }
  return text;
}

std::string comparison(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                       const std::string& mission) {
  if (config.baseline.empty()) return {};
  std::string text = fmt::format(
      "Against {}, world by world. Fewer matchings: how many of its matchings come to one of the variant. Lost: of the "
      "landmarks that it finds right.\n\n"
      "| variant | same drive | fewer matchings | lost |\n|---|---:|---:|---:|\n",
      config.baseline);
  const Rows baseline = rows_of(rows, mission, config.baseline);
  for (const ExperimentVariant& variant : config.variants) {
    if (variant.name == config.baseline) continue;
    const BaselineFigures f = baseline_figures(rows_of(rows, mission, variant.name), baseline);
    text += fmt::format("| {} | {} of {} | {} | {} |\n", variant.name, f.same_drives, f.worlds, text_of(f.matchings, 1),
                        text_of(f.lost));
  }
  return text + "\n";
}

}  // namespace

BaselineFigures baseline_figures(const Rows& rows, const Rows& baseline) {
  BaselineFigures figures;
  std::vector<std::pair<std::int64_t, std::int64_t>> matchings;  // of the baseline, of the variant
  std::int64_t right = 0;
  std::int64_t lost = 0;
  for (const ExperimentRow* row : rows) {
    const auto same_seed = std::ranges::find(baseline, row->seed, &ExperimentRow::seed);
    if (same_seed == baseline.end() || row->verdicts.empty() || (*same_seed)->verdicts.empty()) continue;  // not run
    const ExperimentRow& from = **same_seed;
    ++figures.worlds;
    const bool same = row->result.distance_m == from.result.distance_m && row->result.time_s == from.result.time_s;
    figures.same_drives += same ? 1 : 0;
    matchings.emplace_back(from.result.matchings, row->result.matchings);
    // Both begin with the things of the world, in its order.
    for (std::size_t i = 0; i < from.verdicts.size(); ++i) {
      if (!from.verdicts[i].is_right()) continue;
      ++right;
      lost += row->verdicts[i].is_right() ? 0 : 1;
    }
  }
  figures.lost = share_of(lost, right);
  figures.matchings = resampled(matchings.size(), [&](std::span<const std::size_t> taken) {
    std::pair<std::int64_t, std::int64_t> sum{0, 0};
    for (const std::size_t i : taken) sum = {sum.first + matchings[i].first, sum.second + matchings[i].second};
    return static_cast<double>(sum.first) / static_cast<double>(std::max<std::int64_t>(sum.second, 1));
  });
  return figures;
}

RecognitionFigures recognition_figures(const Rows& rows, double step_rad) {
  std::vector<FoundCounts> counts;
  FoundCounts all;
  std::int64_t met = 0;  // landmarks of the world that something was found at
  std::int64_t turned = 0;
  std::int64_t within_step = 0;
  for (const ExperimentRow* row : rows) {
    FoundCounts& of_row = counts.emplace_back();
    for (const Verdict& verdict : row->verdicts) {
      of_row.right += verdict.is_right() ? 1 : 0;
      of_row.truly += verdict.is.empty() ? 0 : 1;
      of_row.found += verdict.found.empty() ? 0 : 1;
      met += verdict.is.empty() || verdict.found.empty() ? 0 : 1;
      turned += verdict.orientation_error_rad ? 1 : 0;
      within_step += verdict.orientation_error_rad && *verdict.orientation_error_rad <= step_rad ? 1 : 0;
    }
    all += of_row;
  }
  RecognitionFigures figures;
  figures.precision = share_of(all.right, all.found);
  figures.recall = share_of(all.right, all.truly);
  figures.right_category = share_of(all.right, met);
  figures.within_step = share_of(within_step, turned);
  figures.f1 = f1_of(counts);
  figures.median_error_m = resampled(rows.size(), [&](std::span<const std::size_t> taken) {
    return median_of(of_right_ones(taken_of(rows, taken), [](const Verdict& v) { return v.position_error_m; }));
  });
  figures.driven_m = estimate_of(of_right_ones(rows, [](const Verdict& v) { return v.driven_m; }));
  std::vector<double> matchings;
  for (const ExperimentRow* row : rows) matchings.push_back(static_cast<double>(row->result.matchings));
  figures.matchings = estimate_of(matchings);
  return figures;
}

std::string recognition_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows)) {
    text += fmt::format(
        "## {}\n\n{} a variant; 95 % intervals. A landmark further than {:.2f} m from everything is false. "
        "Driven: until first known.\n\n"
        "| variant | precision | recall | F1 | right category | median error m | within one step | driven m | "
        "matchings |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        mission, counted(rows_of(rows, mission, config.variants.front().name).size(), "world"), config.tolerance_m);
    std::string matrices;
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      if (of_variant.empty() || !variant.factor.empty()) continue;
      const RecognitionFigures f = recognition_figures(of_variant, of_variant.front()->step_rad);
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", variant.name, text_of(f.precision),
                          text_of(f.recall), text_of(f.f1), text_of(f.right_category), text_of(f.median_error_m),
                          text_of(f.within_step), text_of(f.driven_m, 1), text_of(f.matchings, 0));
      matrices += "### " + mission + ", " + variant.name + "\n\n" + confusion(of_variant) + "\n";
    }
    text += "\n" + comparison(config, rows, mission) + matrices;
  }
  return text;
}

}  // namespace cairn
