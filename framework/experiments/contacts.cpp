#include "framework/experiments/contacts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/experiments/report.hpp"

namespace cairn {
namespace {

std::string contacts_row(const std::string& mission, const std::string& variant,
                         const std::vector<const ExperimentRow*>& rows, double max_mps) {
  double fastest_mps = 0.0;
  double driven_m = 0.0;
  std::size_t contacts = 0;
  std::int64_t faster = 0;
  std::string seeds;
  for (const ExperimentRow* row : rows) {
    contacts += row->contacts.size();
    driven_m += row->result.distance_m;
    const auto faster_here = std::ranges::count_if(
        row->contacts, [&](const TimedContact& touch) { return touch.contact.speed_mps > max_mps; });
    faster += faster_here;
    if (faster_here > 0) seeds += (seeds.empty() ? "" : ", ") + std::to_string(row->seed);
    for (const TimedContact& touch : row->contacts) fastest_mps = std::max(fastest_mps, touch.contact.speed_mps);
  }
  return fmt::format("| {} | {} | {} | {:.0f} | {} | {:.3f} | {} | {} |\n", mission, variant, rows.size(), driven_m,
                     contacts, fastest_mps, faster, seeds);
}

}  // namespace

std::string contacts_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  if (!config.max_contact_mps) return {};
  std::string text = "\n" + table_head({"mission", "variant", "runs", "driven m", "contacts", "fastest m/s",
                                        fmt::format("faster than {:g} m/s", *config.max_contact_mps), "on seeds"},
                                       2);
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants)
      text += contacts_row(mission, variant.name, rows_of(rows, mission, variant.name), *config.max_contact_mps);
  return text;
}

bool keeps_contact_limit(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  return !config.max_contact_mps || std::ranges::none_of(rows, [&](const ExperimentRow& row) {
    return std::ranges::any_of(
        row.contacts, [&](const TimedContact& touch) { return touch.contact.speed_mps > *config.max_contact_mps; });
  });
}

}  // namespace cairn
