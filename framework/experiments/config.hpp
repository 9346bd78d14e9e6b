// What an experiment's file says (config/experiments/*.yaml).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/experiments/buildings/config.hpp"
#include "framework/experiments/homes/home.hpp"
#include "framework/experiments/trials/config.hpp"
#include "framework/experiments/trials/random_world.hpp"

namespace cairn {

// What is asked of the runs: were the landmarks found; how good are the maps; how well does each category
// fit at given places of the drive, and along an orbit round a landmark; what is recognised in random worlds,
// and what other detectors recognise on the same grids; what comes of random missions in random worlds; what questions
// to the maps of large buildings cost, for which nothing is run; how much of random homes is explored.
enum class ExperimentKind { missions, maps, places, orbit, recognition, curves, trials, buildings, homes };
[[nodiscard]] std::string_view name_of(ExperimentKind kind);

struct SeedRange {
  std::int64_t from = 1;
  int count = 20;
  static void describe(Fields<SeedRange>& fields);
};

struct ExperimentVariant {
  std::string name;
  std::vector<std::string> overrides;
  std::filesystem::path robot{};  // after loading one of the overrides, as the world
  std::filesystem::path world{};
  double specular_ratio = 0.0;
  // After loading:
  std::vector<std::string> robot_overrides{};  // settings of the robot file, without the "robot." before them
  std::optional<RandomWorldConfig> worlds{};   // in place of the experiment's, where settings of it are overridden
  std::string factor{};                        // of a factor's value: the factor's name and the value
  std::string value{};
  static void describe(Fields<ExperimentVariant>& fields);
};

// One factor of a study: a variant for each value, all else as it is.
struct FactorConfig {
  std::string name;
  std::string label;             // of the chart's axis, with the unit; after loading never empty
  std::vector<std::string> set;  // each `key=value` with {} where the factor's value goes
  std::vector<std::string> values;
  static void describe(Fields<FactorConfig>& fields);
};

// A place of the drive, at the end of one of the mission's steps: the first place at that of the first
// step, and so on.
struct PlaceConfig {
  std::string name;
  std::string looks_at;          // category of the one landmark that is looked at from there
  std::vector<double> expected;  // degrees that somebody else has published, as the experiment's categories
  static void describe(Fields<PlaceConfig>& fields);
};

// An orbit round one landmark.
struct OrbitConfig {
  std::string around;  // category of the landmark; the world has one of it
  double bin_rad = radians(15.0);
  static void describe(Fields<OrbitConfig>& fields);
};

// A detector that is compared with others on the same grids.
struct ComparedDetector {
  std::string name;
  PluginChoice choice;
};

// config/experiments/*.yaml
struct ExperimentConfig {
  ExperimentKind experiment = ExperimentKind::missions;
  std::vector<std::filesystem::path> missions;
  std::vector<ExperimentVariant> variants;  // after loading at least one
  std::vector<FactorConfig> vary;           // after loading the variants hold their values too
  std::string baseline;                     // a variant's name
  SeedRange seeds;
  int hold_out_every = 0;
  double tolerance_m = 0.10;              // a landmark further from the truth is false
  std::optional<double> max_contact_mps;  // limit of missions and trials
  double at_least_ratio = 0.0;            // share of good runs that makes the experiment a success
  std::vector<std::string> overrides;
  std::vector<std::string> categories;  // columns of the table of places
  std::vector<PlaceConfig> places;
  std::optional<OrbitConfig> orbit;
  RandomWorldConfig worlds;
  TrialsConfig trials;
  BuildingsConfig buildings;
  HomesConfig homes;
  ConfigValue detectors_as_given;
  std::vector<ComparedDetector> detectors;  // after loading
  bool ring_profile = false;
  double looks_within_m = 0.35;
  int expected_matchings = 0;  // 0: none published
  static void describe(Fields<ExperimentConfig>& fields);
};

// Whether the experiment puts a random world with landmarks in place of each mission's own.
[[nodiscard]] bool in_random_worlds(ExperimentKind kind);

// overrides: "key=value" texts of --set. Throws ConfigError.
[[nodiscard]] ExperimentConfig load_experiment(const std::filesystem::path& file,
                                               const std::vector<std::string>& overrides = {});

}  // namespace cairn
