// What has come of many random missions: figures with 95 % intervals, the limits that were not kept, and every case
// that somebody should look into.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "framework/experiments/experiment.hpp"
#include "framework/experiments/statistics.hpp"

namespace cairn {

// Goals, of which each share is of those before it; intervals are Wilson's.
struct TrialFigures {
  std::int64_t missions = 0;
  std::int64_t done = 0;
  std::int64_t without_outcome = 0;  // not done, and no reason
  std::int64_t faults = 0;           // of modules or of sensors: crashes
  std::int64_t hangs = 0;
  std::int64_t contacts = 0;
  std::int64_t fast_contacts = 0;
  std::int64_t silences = 0;
  int worst_stop_ticks = 0;
  std::int64_t struck_by = 0;  // faults of the simulation
  std::int64_t goals = 0;
  std::int64_t reachable = 0;
  std::int64_t unfaulted = 0;      // of these, neither struck nor displaced
  std::int64_t unstruck = 0;       // of the reachable, no fault was active; maybe displaced by one before
  std::int64_t unmapped = 0;       // of the unfaulted, missed and never explored
  std::int64_t false_success = 0;  // of the unfaulted
  double driven_m = 0.0;
  double time_s = 0.0;
  Interval reached;           // of the reachable
  Interval reached_unstruck;  // of the unstruck
  Interval reached_fairly;    // of the unfaulted
  Interval reached_mapped;    // of the unfaulted but for the unmapped: what at_least_ratio asks of
};
[[nodiscard]] TrialFigures trial_figures(const TrialsConfig& config, const std::vector<const ExperimentRow*>& rows);

// A sentence for each limit that a variant has not kept; none of the wall clock.
[[nodiscard]] std::vector<std::string> broken_limits(const ExperimentConfig& config,
                                                     const std::vector<ExperimentRow>& rows);
// Seeds that took longer than trials.max_wall_s, as a sentence each.
[[nodiscard]] std::vector<std::string> too_long(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

// Markdown.
[[nodiscard]] std::string trials_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);
// Markdown, of the wall clock: how long a mission took, and its ticks.
[[nodiscard]] std::string trial_times_table(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
