// Trials: a random world and a random mission a seed, and what has come of each against the truth.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/experiments/trials/goals.hpp"
#include "framework/experiments/trials/random_world.hpp"
#include "framework/reporting/report.hpp"

namespace cairn {

// Writes world.yaml and mission.yaml into the folder, which it makes; returns the mission's file. `cairn run` of it
// with that seed gives the run again. Throws ConfigError.
[[nodiscard]] std::filesystem::path write_trial(const TrialsConfig& config, const RandomWorldConfig& worlds,
                                                std::int64_t seed, const std::filesystem::path& folder);

struct TrialVerdict {
  int contacts = 0;                         // of any kind
  std::vector<TimedContact> fast_contacts;  // with what could be seen
  Stand stand;                              // the longest
  SilenceFigures silences;
  std::vector<GoalVerdict> goals;
  int fault_count = 0;  // that began in the time that the mission lasted

  [[nodiscard]] bool hangs(const TrialsConfig& config) const { return stand.for_s > config.longest_stand_s; }
};
[[nodiscard]] TrialVerdict judge_trial(const TrialsConfig& config, const TrialEvidence& evidence,
                                       const std::vector<TimedContact>& contacts);

}  // namespace cairn
