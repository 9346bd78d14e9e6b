#include "framework/experiments/homes/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

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

struct TagFigures {
  std::int64_t homes = 0;
  std::int64_t hung = 0;
  std::int64_t in_sight = 0;
  std::int64_t found = 0;
  std::int64_t found_besides = 0;
  std::int64_t false_landmarks = 0;
  std::int64_t sightings = 0;
  std::int64_t false_sightings = 0;
  std::vector<double> position_error_m;
  std::vector<double> direction_error_deg;
};

TagFigures tag_figures_of(const HomeRows& rows) {
  TagFigures figures;
  for (const ExperimentRow* row : rows) {
    if (!row->tags) continue;
    const TagVerdict& tags = *row->tags;
    ++figures.homes;
    figures.hung += tags.hung;
    figures.in_sight += tags.in_sight;
    figures.found += tags.found;
    figures.found_besides += tags.found_besides;
    figures.false_landmarks += tags.false_landmarks;
    figures.sightings += tags.sightings;
    figures.false_sightings += tags.false_sightings;
    std::ranges::copy(tags.position_error_m, std::back_inserter(figures.position_error_m));
    std::ranges::copy(tags.direction_error_deg, std::back_inserter(figures.direction_error_deg));
  }
  return figures;
}

// Over the homes, resampled: tags of one home share the robot's error.
std::string median_text(const HomeRows& rows, std::vector<double> TagFigures::*errors, int decimals) {
  return text_of(resampled(rows.size(),
                           [&](std::span<const std::size_t> taken) {
                             HomeRows sample;
                             for (const std::size_t i : taken) sample.push_back(rows[i]);
                             return median_of(tag_figures_of(sample).*errors);
                           }),
                 decimals);
}

std::string tags_line(const std::string& name, const HomeRows& rows) {
  const TagFigures f = tag_figures_of(rows);
  const auto max_of = [](const std::vector<double>& values) {
    return values.empty() ? 0.0 : *std::ranges::max_element(values);
  };
  return fmt::format("| {} | {} | {} | {} | {} of {}: {} | {} | {} | {}; {:.3f} | {}; {:.1f} | {} of {} |\n", name,
                     f.homes, f.hung, f.in_sight, f.found, f.in_sight, text_of(share_of(f.found, f.in_sight)),
                     f.found_besides, f.false_landmarks, median_text(rows, &TagFigures::position_error_m, 3),
                     max_of(f.position_error_m), median_text(rows, &TagFigures::direction_error_deg, 2),
                     max_of(f.direction_error_deg), f.false_sightings, f.sightings);
}

// Nothing where no tags hang.
std::string tags_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  if (std::ranges::none_of(rows, [](const ExperimentRow& row) { return row.tags.has_value(); })) return {};
  std::string text = "\n" + table_head({"variant", "homes", "tags", "in sight", "of these found", "others found",
                                        "false", "position error m, median; largest",
                                        "direction error deg, median; largest", "false sightings"},
                                       1);
  for (const ExperimentVariant& variant : config.variants)
    if (const HomeRows of_variant = explored_rows(rows, variant.name); !of_variant.empty())
      text += tags_line(variant.name, of_variant);
  text += "\n" + table_head({"variant", "seed", "tags", "in sight", "of these found", "others found", "false",
                             "position error m, median", "direction error deg, median", "sightings"},
                            1);
  for (const ExperimentVariant& variant : config.variants)
    for (const ExperimentRow* row : explored_rows(rows, variant.name))
      if (row->tags)
        text += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {:.3f} | {:.2f} | {} |\n", row->variant, row->seed,
                            row->tags->hung, row->tags->in_sight, row->tags->found, row->tags->found_besides,
                            row->tags->false_landmarks, median_of(row->tags->position_error_m),
                            median_of(row->tags->direction_error_deg), row->tags->sightings);
  return text;
}

bool keeps_tags_limits(const ExperimentConfig& config, const HomeRows& rows) {
  const TagFigures f = tag_figures_of(rows);
  return static_cast<double>(f.found) >= config.at_least_ratio * static_cast<double>(f.in_sight) &&
         f.false_landmarks == 0;
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
  return text + tags_table(config, rows) + "\n";
}

bool keeps_homes_limits(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  return std::ranges::all_of(config.variants, [&](const ExperimentVariant& variant) {
    const HomeRows of_variant = explored_rows(rows, variant.name);
    const HomeFigures f = figures_of(of_variant);
    return variant.name == config.baseline ||
           (static_cast<double>(f.entered) >= config.at_least_ratio * static_cast<double>(f.rooms) &&
            known_share(f) >= config.at_least_ratio && f.fast_contacts == 0 && keeps_tags_limits(config, of_variant));
  });
}

}  // namespace cairn
