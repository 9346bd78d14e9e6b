// What an experiment's `trials` says: how random its missions are, and what is asked of them.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/files/fault_rates.hpp"

namespace cairn {

struct TrialsConfig {
  // What is drawn.
  std::vector<std::filesystem::path> robots;
  std::filesystem::path templates;
  double max_specular_ratio = 0.0;
  double explore_at_most_s = 400.0;
  int min_goals = 3;
  int max_goals = 6;
  double goal_at_most_s = 900.0;
  double anywhere_ratio = 0.1;
  FaultRates faults_per_hour;
  double fault_for_s = 8.0;
  double battery_ratio = 0.0;
  // How it is judged.
  double clearance_m = 0.12;
  double off_m = 0.3;
  double fast_mps = 0.05;
  double longest_stand_s = 120.0;
  // Limits.
  int max_fast_contacts = 0;
  int max_stop_ticks = 2;
  double max_wall_s = 300.0;
  static void describe(Fields<TrialsConfig>& fields);
};

}  // namespace cairn
