#include "framework/experiments/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/experiments/contacts.hpp"
#include "framework/experiments/homes/table.hpp"
#include "framework/experiments/homes/verdict_json.hpp"
#include "framework/experiments/recognition/curves_table.hpp"
#include "framework/experiments/recognition/factor_table.hpp"
#include "framework/experiments/recognition/orbit_table.hpp"
#include "framework/experiments/recognition/places_table.hpp"
#include "framework/experiments/recognition/recognition_table.hpp"
#include "framework/experiments/recognition/ring_table.hpp"
#include "framework/experiments/trials/table.hpp"

namespace cairn {
namespace {

using nlohmann::ordered_json;

int good_rows(const std::vector<ExperimentRow>& rows) {
  return static_cast<int>(std::count_if(rows.begin(), rows.end(), [](const ExperimentRow& r) { return r.is_good(); }));
}

std::string seed_row(const ExperimentRow& row) {
  return fmt::format("| {} | {} | {} | {} | {} | {:.3f} | {:.1f} | {:.0f} | {} | {} | {} |\n", row.seed,
                     name_of(row.result.outcome), row.score.matched.size(), row.score.missed_objects,
                     row.score.false_landmarks, row.worst_error_m, row.result.distance_m, row.result.time_s,
                     row.result.matchings, row.result.collisions, row.is_good() ? "yes" : "no");
}

std::string missions_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows))
    for (const ExperimentVariant& variant : config.variants) {
      if (rows.size() != rows_of(rows, mission, variant.name).size())
        text += fmt::format("## {}, {}\n\n", mission, variant.name);
      text +=
          "| seed | outcome | found | missed | false | worst error m | driven m | time s | matchings | collisions | "
          "good |\n"
          "|---:|---|---:|---:|---:|---:|---:|---:|---:|---:|---|\n";
      for (const ExperimentRow* row : rows_of(rows, mission, variant.name)) text += seed_row(*row);
      text += "\n";
    }
  return text + fmt::format(
                    "{} of {} runs found every landmark with the right category within {:.2f} m and nothing else, "
                    "without a collision.\n",
                    good_rows(rows), rows.size(), config.tolerance_m);
}

// Seed by seed, so that what makes a seed hard for every variant falls out.
Estimate difference(const std::vector<const ExperimentRow*>& rows, const std::vector<const ExperimentRow*>& baseline,
                    const RunMeasure& measure) {
  std::vector<double> differences;
  for (const ExperimentRow* row : rows)
    for (const ExperimentRow* from : baseline)
      if (row->seed == from->seed && measure.is_known(*row) && measure.is_known(*from))
        differences.push_back(measure.of(*row) - measure.of(*from));
  return estimate_of(differences);
}

ordered_json json_of_places(const ExperimentConfig& config, const ExperimentRow& row) {
  ordered_json places = ordered_json::array();
  for (std::size_t i = 0; i < row.places.size(); ++i) {
    ordered_json place = {{"place", config.places[i].name}, {"looks_at", config.places[i].looks_at}};
    for (std::size_t k = 0; k < row.places[i].degrees.size(); ++k)
      place[config.categories[k]] = row.places[i].degrees[k];
    places.push_back(std::move(place));
  }
  return places;
}

ordered_json json_of_orbit(const ExperimentConfig& config, const ExperimentRow& row) {
  ordered_json orbit = ordered_json::array();
  for (const OrbitSample& sample : row.orbit) {
    ordered_json point = {{"angle_deg", degrees(sample.angle_rad)}};
    for (std::size_t k = 0; k < config.categories.size(); ++k) point[config.categories[k]] = sample.categories[k];
    for (const auto& [orientation_deg, degree] : sample.templates)
      point[template_name(config, orientation_deg)] = degree;
    orbit.push_back(std::move(point));
  }
  return orbit;
}

ordered_json json_of_verdicts(const ExperimentRow& row) {
  ordered_json verdicts = ordered_json::array();
  for (const Verdict& verdict : row.verdicts) {
    ordered_json json = {{"is", verdict.is}, {"found", verdict.found}};
    if (!verdict.found.empty()) json["driven_m"] = verdict.driven_m;
    if (verdict.is_right()) json["position_error_m"] = verdict.position_error_m;
    if (verdict.orientation_error_rad) json["orientation_error_deg"] = degrees(*verdict.orientation_error_rad);
    verdicts.push_back(std::move(json));
  }
  return verdicts;
}

// A list [threshold, found, right] for each degree of the detector's detections.
ordered_json json_of_sweeps(const ExperimentRow& row) {
  ordered_json sweeps = ordered_json::array();
  for (const DetectorSweep& sweep : row.sweeps) {
    ordered_json counts = ordered_json::array();
    for (const ThresholdCount& count : sweep.counts.counts) counts.push_back({count.degree, count.found, count.right});
    sweeps.push_back({{"name", sweep.detector}, {"truly", sweep.counts.truly}, {"counts", std::move(counts)}});
  }
  return sweeps;
}

ordered_json json_of_trial(const TrialVerdict& trial) {
  ordered_json goals = ordered_json::array();
  for (const GoalVerdict& goal : trial.goals)
    goals.push_back({{"node", goal.path},
                     {"goal", goal.goal},
                     {"begin_s", goal.begin_s},
                     {"end_s", goal.end_s},
                     {"end", std::string(name_of(goal.end))},
                     {"reason", goal.reason},
                     {"reachable", goal.is_reachable},
                     {"mapped", goal.is_mapped},
                     {"struck", goal.is_struck},
                     {"displaced", goal.is_displaced}});
  ordered_json fast = ordered_json::array();
  for (const TimedContact& touch : trial.fast_contacts)
    fast.push_back({{"time_s", touch.time_s}, {"speed_mps", touch.contact.speed_mps}});
  return {{"contacts", trial.contacts},
          {"fast_contacts", std::move(fast)},
          {"longest_stand_s", trial.stand.for_s},
          {"silences", trial.silences.silences},
          {"worst_stop_ticks", trial.silences.worst_stop_ticks},
          {"faults", trial.fault_count},
          {"goals", std::move(goals)}};
}

std::string cell_text(const Estimate& estimate) {
  return " " + text_of(estimate, 4) + " |";
}

// What can be said of a mission: of some run at least.
std::vector<RunMeasure> measures_for(const std::vector<ExperimentRow>& rows, const std::string& mission) {
  std::vector<RunMeasure> measures;
  for (const RunMeasure& measure : map_measures())
    if (std::any_of(rows.begin(), rows.end(),
                    [&](const ExperimentRow& row) { return row.mission == mission && measure.is_known(row); }))
      measures.push_back(measure);
  return measures;
}

std::string map_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows,
                      const std::string& mission) {
  const std::vector<RunMeasure> measures = measures_for(rows, mission);
  if (measures.empty())
    return "Nothing to measure: no true world and no reading held out, or no run that ended well.\n";
  const bool compared = !config.baseline.empty();
  std::vector<std::string> columns{"variant"};
  for (const RunMeasure& measure : measures) columns.push_back(measure.name);
  if (compared) columns.push_back(measures.front().name + " less " + config.baseline + "'s");
  std::string text = table_head(columns);
  const auto baseline = rows_of(rows, mission, config.baseline);
  for (const ExperimentVariant& variant : config.variants) {
    const auto of_variant = rows_of(rows, mission, variant.name);
    text += "| " + variant.name + " |";
    for (const RunMeasure& measure : measures) text += cell_text(estimate_of(known_values(of_variant, measure)));
    if (compared) text += cell_text(difference(of_variant, baseline, measures.front()));
    text += "\n";
  }
  return text;
}

std::string maps_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  std::string text;
  for (const std::string& mission : missions_of(rows)) {
    const std::size_t runs = rows_of(rows, mission, config.variants.front().name).size();
    const auto left_out = std::count_if(rows.begin(), rows.end(), [&](const ExperimentRow& row) {
      return row.mission == mission && row.result.outcome != MissionOutcome::done;
    });
    text += fmt::format("## {}\n\n{} {} of each variant; mean and 95 % interval.{}\n\n", mission, runs,
                        runs == 1 ? "run" : "runs",
                        left_out == 0 ? "" : fmt::format(" {} that did not end well left out.", left_out));
    text += map_table(config, rows, mission) + "\n";
  }
  return text;
}

ordered_json json_of(const ExperimentRow& row, const ExperimentConfig& config) {
  ordered_json json = {{"mission", row.mission},
                       {"variant", row.variant},
                       {"seed", row.seed},
                       {"outcome", std::string(name_of(row.result.outcome))},
                       {"reason", row.result.reason},
                       {"found", row.score.matched.size()},
                       {"missed", row.score.missed_objects},
                       {"false", row.score.false_landmarks},
                       {"worst_error_m", row.worst_error_m},
                       {"distance_m", row.result.distance_m},
                       {"time_s", row.result.time_s},
                       {"matchings", row.result.matchings},
                       {"collisions", row.result.collisions},
                       {"good", row.is_good()}};
  if (in_random_worlds(config.experiment)) json["verdicts"] = json_of_verdicts(row);
  if (config.experiment == ExperimentKind::curves) json["detectors"] = json_of_sweeps(row);
  if (config.experiment == ExperimentKind::orbit) json["orbit"] = json_of_orbit(config, row);
  if (config.experiment == ExperimentKind::places) json["places"] = json_of_places(config, row);
  if (row.trial) json["trial"] = json_of_trial(*row.trial);
  if (row.home) json["home"] = ordered_json::parse(json_of(*row.home));
  if (row.tags) json["tags"] = ordered_json::parse(json_of(*row.tags));
  if (config.experiment != ExperimentKind::maps) return json;
  for (const RunMeasure& measure : map_measures())
    if (measure.is_known(row)) json[measure.name] = measure.of(row);
  json["held_out"] = row.held_out;
  return json;
}

}  // namespace

bool RunMeasure::is_known(const ExperimentRow& row) const {
  return row.result.outcome == MissionOutcome::done && (needs_truth ? row.quality.has_value() : row.held_out > 0);
}

std::vector<double> known_values(const std::vector<const ExperimentRow*>& rows, const RunMeasure& measure) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const ExperimentRow* row : rows)
    if (measure.is_known(*row)) values.push_back(measure.of(*row));
  return values;
}

const std::vector<RunMeasure>& map_measures() {
  using Row = ExperimentRow;
  static const std::vector<RunMeasure> kMeasures{
      {"log loss", [](const Row& row) { return row.quality->log_loss; }, true},
      {"of walls", [](const Row& row) { return row.quality->wall_log_loss; }, true},
      {"of free cells", [](const Row& row) { return row.quality->free_log_loss; }, true},
      {"Brier score", [](const Row& row) { return row.quality->brier; }, true},
      {"ghost share", [](const Row& row) { return row.quality->ghost_ratio; }, true},
      {"missed share", [](const Row& row) { return row.quality->missed_ratio; }, true},
      {"held-out log-likelihood", [](const Row& row) { return row.held_out_log_likelihood; }, false}};
  return kMeasures;
}

std::vector<const ExperimentRow*> rows_of(const std::vector<ExperimentRow>& rows, const std::string& mission,
                                          const std::string& variant) {
  std::vector<const ExperimentRow*> found;
  for (const ExperimentRow& row : rows)
    if (row.mission == mission && row.variant == variant) found.push_back(&row);
  return found;
}

std::vector<std::string> missions_of(const std::vector<ExperimentRow>& rows) {
  std::vector<std::string> names;
  for (const ExperimentRow& row : rows)
    if (std::find(names.begin(), names.end(), row.mission) == names.end()) names.push_back(row.mission);
  return names;
}

std::string table_head(const std::vector<std::string>& columns, std::size_t texts) {
  std::string head = "|";
  std::string rule = "|";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    head += (columns[i].empty() ? "" : " ") + columns[i] + " |";
    rule += i < texts ? "---|" : "---:|";
  }
  return head + "\n" + rule + "\n";
}

namespace {

// Runs that did not come to their end count in the tables as far as they came.
std::string cancelled_text(const std::vector<ExperimentRow>& rows) {
  const auto cut = std::ranges::count_if(
      rows, [](const ExperimentRow& row) { return row.result.outcome == MissionOutcome::cancelled; });
  return cut == 0 ? "" : fmt::format("**Cancelled: {} of {} runs did not come to their end.**\n\n", cut, rows.size());
}

std::string tables_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  switch (config.experiment) {
    case ExperimentKind::missions:
      return missions_table(config, rows) + contacts_table(config, rows);
    case ExperimentKind::maps:
      return maps_table(config, rows);
    case ExperimentKind::places:
      return places_table(config, rows);
    case ExperimentKind::orbit:
      return orbit_table(config, rows);
    case ExperimentKind::recognition:
      return (config.variants.front().factor.empty() ? recognition_table(config, rows) : "") +
             factor_tables(config, rows) + ring_table(config, rows);
    case ExperimentKind::curves:
      return curves_table(config, rows);
    case ExperimentKind::trials:
      return trials_table(config, rows) + contacts_table(config, rows);
    case ExperimentKind::homes:
      return homes_table(config, rows) + contacts_table(config, rows);
    case ExperimentKind::buildings:
      break;  // runs nothing: its table is made of questions
  }
  return {};
}

}  // namespace

std::string table_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  return cancelled_text(rows) + tables_of(config, rows);
}

std::string json_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows) {
  ordered_json list = ordered_json::array();
  for (const ExperimentRow& row : rows) list.push_back(json_of(row, config));
  ordered_json all = {{"experiment", std::string(name_of(config.experiment))},
                      {"tolerance_m", config.tolerance_m},
                      {"good", good_rows(rows)},
                      {"runs", rows.size()},
                      {"rows", list}};
  if (config.experiment == ExperimentKind::trials) all["broken_limits"] = broken_limits(config, rows);
  return all.dump();
}

}  // namespace cairn
