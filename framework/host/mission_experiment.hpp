// An experiment over missions: the same mission on many seeds, each judged against the true world.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/host/mission_runner.hpp"
#include "framework/host/module_library.hpp"
#include "framework/host/run_report.hpp"

namespace cairn {

enum class ExperimentKind { missions };

struct SeedRange {
  std::int64_t from = 1;
  int count = 20;
  static void describe(Fields<SeedRange>& fields);
};

// config/experiments/*.yaml
struct ExperimentConfig {
  ExperimentKind experiment = ExperimentKind::missions;
  std::filesystem::path mission;
  SeedRange seeds;
  double tolerance_m = 0.10;    // a landmark further from the truth is false
  double at_least_ratio = 0.0;  // share of good runs that makes the experiment a success
  std::vector<std::string> overrides;
  static void describe(Fields<ExperimentConfig>& fields);
};

struct ExperimentRow {
  std::int64_t seed = 0;
  MissionResult result;
  TruthScore score;
  double worst_error_m = 0.0;
  double wall_s = 0.0;

  // All landmarks of the world found within the tolerance, none besides, nothing bumped into.
  [[nodiscard]] bool is_good() const;
};

[[nodiscard]] ExperimentConfig load_experiment(const std::filesystem::path& file);

// Runs every seed, two at a time where the machine has two cores; rows come in the order of seeds.
// Each run writes its map and report into out/seed_N. Throws ConfigError or ModuleFault.
[[nodiscard]] std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                                        const std::filesystem::path& out,
                                                        const std::atomic<bool>& cancel);

// A table in Markdown and the same as JSON; neither holds wall clock times.
[[nodiscard]] std::string table_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);
[[nodiscard]] std::string json_of(const ExperimentConfig& config, const std::vector<ExperimentRow>& rows);

}  // namespace cairn
