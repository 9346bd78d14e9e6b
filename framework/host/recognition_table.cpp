#include "framework/host/recognition_table.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

#include "framework/host/experiment_report.hpp"

namespace cairn {
namespace {

using Rows = std::vector<const ExperimentRow*>;

struct Counts {
  std::int64_t right = 0;
  std::int64_t truly = 0;  // landmarks of the world
  std::int64_t found = 0;
  std::int64_t met = 0;  // landmarks of the world that something was found at
  std::int64_t turned = 0;
  std::int64_t within_step = 0;
};

Counts operator+(Counts a, const Counts& b) {
  a.right += b.right;
  a.truly += b.truly;
  a.found += b.found;
  a.met += b.met;
  a.turned += b.turned;
  a.within_step += b.within_step;
  return a;
}

Counts counts_of(const ExperimentRow& row, double step_rad) {
  Counts counts;
  for (const Verdict& verdict : row.verdicts) {
    counts.right += verdict.is_right() ? 1 : 0;
    counts.truly += verdict.is.empty() ? 0 : 1;
    counts.found += verdict.found.empty() ? 0 : 1;
    counts.met += verdict.is.empty() || verdict.found.empty() ? 0 : 1;
    if (!verdict.orientation_error_rad) continue;
    ++counts.turned;
    counts.within_step += *verdict.orientation_error_rad <= step_rad ? 1 : 0;
  }
  return counts;
}

double f1_of(const Counts& counts) {
  const std::int64_t all = counts.truly + counts.found;
  return all == 0 ? 0.0 : 2.0 * static_cast<double>(counts.right) / static_cast<double>(all);
}

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

std::string text_of(const Interval& interval) {
  return fmt::format("{:.3f} ({:.3f} - {:.3f})", interval.value, interval.low, interval.high);
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
  std::string text = "| is \\\\ found |";
  std::string rule = "|---|";
  for (const std::string& name : names) {
    text += " " + name_of_category(name) + " |";
    rule += "---:|";
  }
  text += "\n" + rule + "\n";
  for (const std::string& is : names) {
    text += "| " + name_of_category(is) + " |";
    for (const std::string& found : names) text += fmt::format(" {} |", counts[is][found]);
    text += "\n";
  }
  return text;
}

}  // namespace

RecognitionFigures recognition_figures(const Rows& rows, double step_rad) {
  std::vector<Counts> counts;
  Counts all;
  for (const ExperimentRow* row : rows) {
    counts.push_back(counts_of(*row, step_rad));
    all = all + counts.back();
  }
  RecognitionFigures figures;
  figures.precision = share_of(all.right, all.found);
  figures.recall = share_of(all.right, all.truly);
  figures.right_category = share_of(all.right, all.met);
  figures.within_step = share_of(all.within_step, all.turned);
  figures.f1 = resampled(rows.size(), [&](std::span<const std::size_t> taken) {
    Counts some;
    for (const std::size_t index : taken) some = some + counts[index];
    return f1_of(some);
  });
  figures.median_error_m = resampled(rows.size(), [&](std::span<const std::size_t> taken) {
    return median_of(of_right_ones(taken_of(rows, taken), [](const Verdict& v) { return v.position_error_m; }));
  });
  figures.driven_m = estimate_of(of_right_ones(rows, [](const Verdict& v) { return v.driven_m; }));
  return figures;
}

std::string recognition_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows)) {
    text += fmt::format(
        "## {}\n\n{} worlds a variant; 95 % intervals. A landmark further than {:.2f} m from everything is false. "
        "Driven: until first known.\n\n"
        "| variant | precision | recall | F1 | right category | median error m | within one step | driven m |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|\n",
        mission, rows_of(rows, mission, config.variants.front().name).size(), config.tolerance_m);
    std::string matrices;
    for (const ExperimentVariant& variant : config.variants) {
      const Rows of_variant = rows_of(rows, mission, variant.name);
      if (of_variant.empty()) continue;
      const RecognitionFigures f = recognition_figures(of_variant, of_variant.front()->step_rad);
      text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.1f} ± {:.1f} |\n", variant.name,
                          text_of(f.precision), text_of(f.recall), text_of(f.f1), text_of(f.right_category),
                          text_of(f.median_error_m), text_of(f.within_step), f.driven_m.mean, f.driven_m.half_width);
      matrices += "### " + mission + ", " + variant.name + "\n\n" + confusion(of_variant) + "\n";
    }
    text += "\n" + matrices;
  }
  return text;
}

}  // namespace cairn
