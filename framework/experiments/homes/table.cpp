#include "framework/experiments/homes/table.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/report.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {
namespace {

using HomeRows = std::vector<const ExperimentRow*>;

HomeRows explored_rows(const std::vector<ExperimentRow>& rows, const std::string& variant) {
  HomeRows explored;
  for (const ExperimentRow& row : rows)
    if (row.variant == variant && row.home) explored.push_back(&row);
  return explored;
}

struct HomeFigures {
  std::int64_t rooms = 0;
  std::int64_t entered = 0;
  double area_m2 = 0.0;
  double known_m2 = 0.0;
  std::int64_t contacts = 0;
  std::int64_t fast_contacts = 0;
  std::int64_t successes = 0;
  std::vector<double> known_90_s;
  std::vector<double> time_s;
  std::vector<double> driven_m;
};

HomeFigures figures_of(const HomeRows& rows) {
  HomeFigures figures;
  for (const ExperimentRow* row : rows) {
    const HomeVerdict& home = *row->home;
    figures.rooms += home.rooms;
    figures.entered += home.entered;
    figures.area_m2 += home.area_m2;
    figures.known_m2 += home.known_ratio * home.area_m2;
    figures.contacts += home.contacts;
    figures.fast_contacts += home.fast_contacts;
    figures.successes += home.said_success ? 1 : 0;
    if (home.known_90_s) figures.known_90_s.push_back(*home.known_90_s);
    figures.time_s.push_back(row->result.time_s);
    figures.driven_m.push_back(row->result.distance_m);
  }
  return figures;
}

double known_share(const HomeFigures& figures) {
  return figures.area_m2 > 0.0 ? figures.known_m2 / figures.area_m2 : 0.0;
}

// Over the homes, resampled.
Interval known_interval(const HomeRows& rows) {
  return resampled(rows.size(), [&](std::span<const std::size_t> taken) {
    HomeRows sample;
    for (const std::size_t i : taken) sample.push_back(rows[i]);
    return known_share(figures_of(sample));
  });
}

std::string variant_line(const std::string& name, const HomeRows& rows) {
  const HomeFigures f = figures_of(rows);
  return fmt::format(
      "| {} | {} | {} of {}: {} | {} | {}; {} | {} | {} | {} | {} |\n", name, rows.size(), f.entered, f.rooms,
      text_of(share_of(f.entered, f.rooms)), text_of(known_interval(rows)), f.contacts, f.fast_contacts, f.successes,
      f.known_90_s.empty() ? "-"
                           : fmt::format("{} ({} homes)", text_of(estimate_of(f.known_90_s), 0), f.known_90_s.size()),
      text_of(estimate_of(f.time_s), 0), text_of(estimate_of(f.driven_m), 0));
}

std::string run_line(const ExperimentRow& row) {
  const HomeVerdict& home = *row.home;
  return fmt::format("| {} | {} | {} of {} | {:.1f} | {:.3f} | {} | {}; {} | {:.0f} | {} {} |\n", row.variant, row.seed,
                     home.entered, home.rooms, home.area_m2, home.known_ratio,
                     home.known_90_s ? fmt::format("{:.0f}", *home.known_90_s) : "-", home.contacts, home.fast_contacts,
                     row.result.time_s, home.said_success ? "success:" : "failure:", home.end);
}

}  // namespace

std::string homes_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text = table_head({"variant", "homes", "rooms entered", "reachable area known", "contacts; fast, seen",
                                 "successes", "s to 90 %", "s in all", "m in all"},
                                1);
  for (const ExperimentVariant& variant : config.variants)
    if (const HomeRows of_variant = explored_rows(rows, variant.name); !of_variant.empty())
      text += variant_line(variant.name, of_variant);
  text += "\n" + table_head({"variant", "seed", "rooms", "m2", "known", "s to 90 %", "contacts; fast", "s", "end"}, 1);
  for (const ExperimentVariant& variant : config.variants)
    for (const ExperimentRow* row : explored_rows(rows, variant.name)) text += run_line(*row);
  return text + "\n";
}

bool keeps_homes_limits(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  return std::ranges::all_of(config.variants, [&](const ExperimentVariant& variant) {
    const HomeFigures f = figures_of(explored_rows(rows, variant.name));
    return variant.name == config.baseline ||
           (static_cast<double>(f.entered) >= config.at_least_ratio * static_cast<double>(f.rooms) &&
            known_share(f) >= config.at_least_ratio && f.fast_contacts == 0);
  });
}

}  // namespace cairn
