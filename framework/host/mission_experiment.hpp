// An experiment: missions, each in several variants and on many seeds, and what is measured of every run.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/host/map_quality.hpp"
#include "framework/host/mission_runner.hpp"
#include "framework/host/module_library.hpp"
#include "framework/host/run_report.hpp"

namespace cairn {

// What is asked of the runs: were the landmarks found; how good are the maps.
enum class ExperimentKind { missions, maps };

struct SeedRange {
  std::int64_t from = 1;
  int count = 20;
  static void describe(Fields<SeedRange>& fields);
};

struct ExperimentVariant {
  std::string name;
  std::vector<std::string> overrides;
  static void describe(Fields<ExperimentVariant>& fields);
};

// config/experiments/*.yaml
struct ExperimentConfig {
  ExperimentKind experiment = ExperimentKind::missions;
  std::vector<std::filesystem::path> missions;
  std::vector<ExperimentVariant> variants;  // after loading at least one
  std::string baseline;                     // a variant's name
  SeedRange seeds;
  int withhold_every = 0;
  double tolerance_m = 0.10;    // a landmark further from the truth is false
  double at_least_ratio = 0.0;  // share of good runs that makes the experiment a success
  std::vector<std::string> overrides;
  static void describe(Fields<ExperimentConfig>& fields);
};

struct ExperimentRow {
  std::string mission;
  std::string variant;
  std::int64_t seed = 0;
  MissionResult result;
  TruthScore score;
  double worst_error_m = 0.0;
  std::optional<MapQuality> quality;  // where there is a true world
  std::int64_t withheld = 0;
  double withheld_log_likelihood = 0.0;  // mean, nat
  double wall_s = 0.0;
  bool gave_up = false;  // a module was left behind: see MissionRunner::gave_up()

  // All landmarks of the world found within the tolerance, none besides, nothing bumped into.
  [[nodiscard]] bool is_good() const;
};

// Throws ConfigError.
[[nodiscard]] ExperimentConfig load_experiment(const std::filesystem::path& file);

// Runs everything, as many at a time as the machine has cores, but at most eight; rows come by mission, variant and
// seed. A recorded log is the same in each run: it is run on as many seeds as withhold other readings. Each run writes
// its map and report into a folder of its own under out. Throws ConfigError or ModuleFault; the first fault stops the
// runs that have not begun.
[[nodiscard]] std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                                        const std::filesystem::path& out,
                                                        const std::atomic<bool>& cancel);

}  // namespace cairn
