#include "framework/host/mission_experiment.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <fstream>
#include <thread>

#include "framework/host/mission.hpp"
#include "framework/host/withheld.hpp"

namespace cairn {
namespace {

struct Job {
  std::filesystem::path mission;
  ExperimentVariant variant;
  std::int64_t seed = 0;
  std::filesystem::path out;
};

std::vector<Job> jobs_of(const ExperimentConfig& config, const std::filesystem::path& out) {
  std::vector<Job> jobs;
  for (const std::filesystem::path& mission : config.missions) {
    const bool is_log = !load_mission(mission, config.overrides).world;
    const int seeds = is_log ? std::min(config.seeds.count, std::max(config.withhold_every, 1)) : config.seeds.count;
    for (const ExperimentVariant& variant : config.variants)
      for (int i = 0; i < seeds; ++i) {
        const std::int64_t seed = config.seeds.from + i;
        const std::string name = "seed_" + std::to_string(seed);
        // One mission as it stands needs no folders of its own.
        const bool alone = config.missions.size() == 1 && config.variants.size() == 1;
        jobs.push_back({mission, variant, seed, alone ? out / name : out / mission.stem() / variant.name / name});
      }
  }
  return jobs;
}

Mission mission_of(const ExperimentConfig& config, const Job& job) {
  std::vector<std::string> overrides = config.overrides;
  overrides.insert(overrides.end(), job.variant.overrides.begin(), job.variant.overrides.end());
  if (config.withhold_every > 0) overrides.push_back("withhold_every=" + std::to_string(config.withhold_every));
  return load_mission(job.mission, overrides, job.seed);
}

// A fault in the last variant's settings is told before the first one has run for an hour.
void check(const ExperimentConfig& config, const ModuleLibrary& library, const std::vector<Job>& jobs) {
  for (const Job& job : jobs)
    if (job.seed == config.seeds.from) MissionRunner(mission_of(config, job), library, {job.out, false, nullptr});
}

ExperimentRow run_job(const ExperimentConfig& config, const ModuleLibrary& library, const std::atomic<bool>& cancel,
                      const Job& job) {
  const auto begin = std::chrono::steady_clock::now();
  const Mission mission = mission_of(config, job);
  std::filesystem::create_directories(job.out);
  MissionRunner runner(mission, library, {job.out, false, &cancel});
  RunReport report;
  TruePath path;
  WithheldReadings withheld(mission.config.withhold_every, mission.config.seed);
  runner.subscribe(report);
  runner.subscribe(path);
  runner.subscribe(withheld);
  const MissionResult result = runner.run();
  ExperimentRow row{job.mission.stem(), job.variant.name, job.seed, result, {}, 0.0, {}, 0, 0.0, 0.0, runner.gave_up()};
  for (const std::string& fault : runner.listener_faults()) {
    row.result.outcome = MissionOutcome::module_fault;  // what was measured is not of the whole run
    row.result.reason += "; a listener failed: " + fault;
  }
  std::ofstream(job.out / "report.json") << report.report_json(mission, row.result, runner.graph(), {});
  if (mission.world) row.score = score_against(*mission.world, runner.graph(), config.tolerance_m);
  for (const LandmarkTruth& matched : row.score.matched)
    row.worst_error_m = std::max(row.worst_error_m, matched.error_m);
  if (config.experiment == ExperimentKind::maps && runner.grid() != nullptr) {
    if (mission.world) row.quality = map_quality(*runner.grid(), *mission.world, path.places_m());
    row.withheld = withheld.count();
    row.withheld_log_likelihood = withheld.mean_log_likelihood(*runner.grid());
  }
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return row;
}

}  // namespace

void SeedRange::describe(Fields<SeedRange>& fields) {
  fields.integer("from", &SeedRange::from, {0.0, 9.0e15}, "first seed");
  fields.integer("count", &SeedRange::count, {1.0, 100000.0}, "how many seeds");
}

void ExperimentVariant::describe(Fields<ExperimentVariant>& fields) {
  fields.text("name", &ExperimentVariant::name, "what it is called in tables").required = true;
  fields.texts("set", &ExperimentVariant::overrides, "settings of the missions to override, each `key=value`");
}

void ExperimentConfig::describe(Fields<ExperimentConfig>& fields) {
  using C = ExperimentConfig;
  fields
      .choice("experiment", &C::experiment, {{"missions", ExperimentKind::missions}, {"maps", ExperimentKind::maps}},
              "what is measured: `missions`, whether the landmarks were found; `maps`, how good the map is against "
              "the true world, and how well it foretells readings that were withheld from it")
      .required = true;
  fields.files("missions", &C::missions, "mission files").required = true;
  fields.list("variants", &C::variants, "each mission is run in each of them; without any, as it stands");
  fields.text("baseline", &C::baseline, "name of the variant that the others are compared with, seed by seed");
  fields.group("seeds", &C::seeds, "which seeds");
  fields.integer("withhold_every", &C::withhold_every, {0.0, 1e6}, "as the missions' setting of this name");
  fields.number("tolerance_m", &C::tolerance_m, {0.0, 100.0}, "m", "a landmark further from the truth counts as false");
  fields.number("at_least_ratio", &C::at_least_ratio, {0.0, 1.0}, "",
                "share of good runs that makes the experiment a success");
  fields.texts("set", &C::overrides, "settings of the missions to override, each `key=value`");
}

bool ExperimentRow::is_good() const {
  return result.outcome == MissionOutcome::done && score.missed_objects == 0 && score.false_landmarks == 0 &&
         result.collisions == 0;
}

ExperimentConfig load_experiment(const std::filesystem::path& file) {
  const ConfigValue root = read_config_file(file);
  auto config = load_config<ExperimentConfig>(root, "experiment");
  if (config.missions.empty()) throw ConfigError(root.find("missions")->place, "missions must list at least one file");
  if (config.variants.empty()) config.variants.push_back({"as_is", {}});
  std::vector<std::string> names;
  for (const ExperimentVariant& variant : config.variants) {
    if (variant.name.empty() || variant.name.find('/') != std::string::npos || variant.name.front() == '.')
      throw ConfigError(root.find("variants")->place,
                        "a variant's name is also a folder's, and \"" + variant.name + "\" cannot be one");
    if (std::find(names.begin(), names.end(), variant.name) != names.end())
      throw ConfigError(root.find("variants")->place, "two variants are called \"" + variant.name + "\"");
    names.push_back(variant.name);
  }
  std::vector<std::string> stems;
  for (const std::filesystem::path& mission : config.missions) {
    if (std::find(stems.begin(), stems.end(), mission.stem()) != stems.end())
      throw ConfigError(root.find("missions")->place, "two missions have the file name \"" + mission.stem().string() +
                                                          "\"; tables and folders are "
                                                          "named by it");
    stems.push_back(mission.stem());
  }
  if (!config.baseline.empty() && std::find(names.begin(), names.end(), config.baseline) == names.end())
    throw ConfigError(root.find("baseline")->place,
                      "no variant is called \"" + config.baseline + "\"" + did_you_mean(config.baseline, names));
  return config;
}

std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                          const std::filesystem::path& out, const std::atomic<bool>& cancel) {
  const std::vector<Job> jobs = jobs_of(config, out);
  check(config, library, jobs);
  std::vector<ExperimentRow> rows(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    rows[i].mission = jobs[i].mission.stem();
    rows[i].variant = jobs[i].variant.name;
    rows[i].seed = jobs[i].seed;
    rows[i].result.outcome = MissionOutcome::cancelled;  // until it has run
  }
  std::vector<std::exception_ptr> errors(jobs.size());
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < jobs.size() && !cancel.load(); i = next++) {
      try {
        rows[i] = run_job(config, library, cancel, jobs[i]);
      } catch (...) {
        errors[i] = std::current_exception();
        next = jobs.size();
      }
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t threads =
        std::min<std::size_t>(std::clamp(std::thread::hardware_concurrency(), 1U, 8U), jobs.size());
    for (std::size_t i = 0; i < threads; ++i) workers.emplace_back(work);
  }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return rows;
}

}  // namespace cairn
