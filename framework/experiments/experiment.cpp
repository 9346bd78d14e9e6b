#include "framework/experiments/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "framework/experiments/factors.hpp"
#include "framework/experiments/jobs.hpp"
#include "framework/mission/held_out.hpp"
#include "framework/mission/mission.hpp"
#include "maps/base/in_parallel.hpp"
#include "maps/base/output_file.hpp"

namespace cairn {
namespace {

constexpr std::size_t kMaxRunsAtATime = 8;

// As random worlds: world.yaml in the run's folder. The start is the home's own.
std::vector<std::string> write_home(const ExperimentConfig& config, const ExperimentJob& job) {
  const Home home = random_home(config.homes, static_cast<std::uint64_t>(job.seed));
  std::filesystem::create_directories(job.out);
  const std::filesystem::path file = std::filesystem::absolute(job.out / "world.yaml");
  write_file(file, home.world_yaml);
  return {"world=" + file.string(), fmt::format("start={{at_m: [{:.3f}, {:.3f}], angle_deg: {:g}}}", home.start_m.x(),
                                                home.start_m.y(), home.start_deg)};
}

// The world of a seed stays in the run's folder, so that `cairn run --set world=FILE` gives the run again.
std::string write_world(const ExperimentConfig& config, const ExperimentJob& job,
                        const std::vector<LandmarkShape>& shapes) {
  if (shapes.empty())
    throw ConfigError({job.mission.string(), 0, 0},
                      "an experiment in random worlds needs a mission whose detector has templates");
  std::filesystem::create_directories(job.out);
  const std::filesystem::path file = std::filesystem::absolute(job.out / "world.yaml");
  write_file(file, random_world_yaml(job.variant.worlds.value_or(config.worlds), shapes, job.variant.specular_ratio,
                                     static_cast<std::uint64_t>(job.seed)));
  return file.string();
}

// The robot file of a variant that overrides some of it stays in the run's folder too.
std::string write_robot(const ExperimentJob& job, const std::vector<std::string>& overrides) {
  ConfigValue robot = read_config_file(load_mission(job.mission, overrides).config.robot);
  for (const std::string& assignment : job.variant.robot_overrides) apply_override(robot, assignment);
  std::filesystem::create_directories(job.out);
  const std::filesystem::path file = std::filesystem::absolute(job.out / "robot.yaml");
  write_file(file, yaml_of(robot) + "\n");
  return file.string();
}

Mission mission_of(const ExperimentConfig& config, const ExperimentJob& job) {
  std::vector<std::string> overrides = config.overrides;
  overrides.insert(overrides.end(), job.variant.overrides.begin(), job.variant.overrides.end());
  if (config.hold_out_every > 0) overrides.push_back("hold_out_every=" + std::to_string(config.hold_out_every));
  if (!job.variant.robot_overrides.empty()) overrides.push_back("robot=" + write_robot(job, overrides));
  if (config.experiment == ExperimentKind::trials)
    return load_mission(write_trial(config.trials, config.worlds, job.seed, job.out), overrides, job.seed);
  if (in_random_worlds(config.experiment))
    overrides.push_back("world=" + write_world(config, job, load_mission(job.mission, overrides).shapes));
  if (config.experiment == ExperimentKind::homes) {
    const std::vector<std::string> home = write_home(config, job);
    overrides.insert(overrides.end(), home.begin(), home.end());
  }
  return load_mission(job.mission, overrides, job.seed);
}

// A fault in the last variant's settings is reported before the first one has run for an hour.
void check(const ExperimentConfig& config, const ModuleLibrary& library, const std::vector<ExperimentJob>& jobs) {
  for (const ExperimentJob& job : jobs) {
    if (job.seed != config.seeds.from) continue;
    const Mission mission = mission_of(config, job);
    if (config.experiment == ExperimentKind::places) check_places(config, mission, job.mission);
    if (config.experiment == ExperimentKind::orbit)
      require_one(mission, config.orbit->around, "the orbit goes round", job.mission);
    const MissionRunner tried(mission, library, {job.out, false, nullptr});
    for (const ComparedDetector& detector : config.detectors)
      const MissionRunner compared(with_detector(mission, detector, library), library, {job.out, false, nullptr});
  }
}

// What a run is measured by while it lasts.
struct Listeners {
  Listeners(const ExperimentConfig& config, const Mission& mission)
      : report(mission.config.history), held_out(mission.config.hold_out_every, mission.config.seed) {
    if (config.experiment == ExperimentKind::homes)
      home.emplace(config.homes, random_home(config.homes, static_cast<std::uint64_t>(mission.config.seed)),
                   *mission.world, mission.robot.radius_m);
    if (home && !mission.world->tags.empty() && !mission.robot.cameras.empty()) tags.emplace(*mission.world);
  }
  void subscribe_to(MissionRunner& runner) {
    runner.subscribe(report);
    runner.subscribe(known);
    runner.subscribe(path);
    runner.subscribe(held_out);
    runner.subscribe(trial);
    if (home) runner.subscribe(*home);
    if (tags) runner.subscribe(*tags);
  }

  RunReport report;
  FirstKnown known;
  TruePath path;
  HeldOutReadings held_out;
  TrialRecord trial;
  std::optional<HomeRecord> home;
  std::optional<TagRecord> tags;
};

// What the experiment's kind asks of a run that has ended.
void measure(const ExperimentConfig& config, const Mission& mission, const MissionRunner& runner,
             const Listeners& listeners, ExperimentRow& row) {
  if (mission.world) row.score = score_against(*mission.world, runner.graph(), config.tolerance_m);
  for (const LandmarkTruth& matched : row.score.matched)
    row.worst_error_m = std::max(row.worst_error_m, matched.error_m);
  if (config.experiment == ExperimentKind::maps && runner.grid() != nullptr) {
    if (mission.world) row.quality = map_quality(*runner.grid(), *mission.world, listeners.path.places_m());
    row.held_out = listeners.held_out.count();
    row.held_out_log_likelihood = listeners.held_out.mean_log_likelihood(*runner.grid());
  }
  if (config.experiment == ExperimentKind::places)
    row.places = degrees_at_places(config, *mission.world, listeners.report.degrees(), row.result.steps);
  if (in_random_worlds(config.experiment))
    row.verdicts = judge_recognition(mission, runner.graph(), listeners.known, config.tolerance_m);
  if (config.ring_profile && mission.world && runner.grid() != nullptr)
    row.ring = ring_profile(*runner.grid(), *mission.world);
  const bool was_cancelled = row.result.outcome == MissionOutcome::cancelled;  // by the user: no mission's end
  if (config.experiment == ExperimentKind::trials && !was_cancelled)
    row.trial =
        judge_trial(config.trials, {mission, row.result, listeners.trial, runner.grid()}, listeners.report.contacts());
  row.contacts = listeners.report.contacts();
  if (listeners.home && !was_cancelled) row.home = listeners.home->verdict(row.result, row.contacts);
  if (listeners.tags && !was_cancelled)
    row.tags = listeners.tags->verdict(runner.graph(), config.homes.tag_tolerance_m);
  row.step_rad = mission.template_settings.step_rad;
  if (config.experiment == ExperimentKind::orbit)
    row.orbit =
        degrees_along_orbit(config, *mission.world, runner.T_map_start().position(), listeners.report.degrees());
}

ExperimentRow run_job(const ExperimentConfig& config, const ModuleLibrary& library, const std::atomic<bool>& cancel,
                      const ExperimentJob& job) {
  const auto begin = std::chrono::steady_clock::now();
  const Mission mission = mission_of(config, job);
  std::filesystem::create_directories(job.out);
  MissionRunner runner(mission, library, {job.out, false, &cancel});
  Listeners listeners(config, mission);
  listeners.subscribe_to(runner);
  ExperimentRow row = row_before_run(job);
  row.result = runner.run();
  row.gave_up = runner.gave_up();
  for (const std::string& fault : runner.listener_faults()) {
    row.result.outcome = MissionOutcome::module_fault;  // what was measured is not of the whole run
    row.result.reason += "; a listener failed: " + fault;
  }
  write_file(job.out / "report.json", listeners.report.report_json(mission, row.result, runner.graph(), {}));
  measure(config, mission, runner, listeners, row);
  for (const StageTime& time : runner.times()) {
    if (time.stage == "detector") row.detector_wall_s += time.total_s;
    if (time.stage == "tick") row.tick = time;
  }
  row.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (config.experiment == ExperimentKind::curves && runner.grid() != nullptr)
    for (const ComparedDetector& detector : config.detectors)
      row.sweeps.push_back(sweep(mission, detector, library, *runner.grid(), config.tolerance_m));
  return row;
}

}  // namespace

bool ExperimentRow::is_good() const {
  return result.outcome == MissionOutcome::done && score.missed_objects == 0 && score.false_landmarks == 0 &&
         result.collisions == 0;
}

std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                          const std::filesystem::path& out, const std::atomic<bool>& cancel,
                                          const std::function<void(std::size_t, std::size_t)>& ended,
                                          const RunFilter& filter) {
  std::vector<ExperimentJob> jobs = jobs_of(config, out);
  check(config, library, jobs);
  if (filter.is_wanted) {
    std::size_t at = 0;
    std::erase_if(jobs, [&](const ExperimentJob&) { return !filter.is_wanted(at++); });
  }
  std::vector<ExperimentRow> rows(jobs.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) rows[i] = row_before_run(jobs[i]);
  std::mutex telling;
  std::size_t count = 0;
  in_parallel(
      jobs.size(),
      [&](std::size_t i) {
        if (cancel.load() || (filter.may_begin && !filter.may_begin(i))) return;
        rows[i] = run_job(config, library, cancel, jobs[i]);
        const std::scoped_lock lock(telling);
        ++count;
        if (filter.has_run) filter.has_run(rows[i]);
        if (ended) ended(count, jobs.size());
      },
      kMaxRunsAtATime);
  return rows;
}

ExperimentRow row_before_run(const ExperimentJob& job) {
  ExperimentRow row;
  row.mission = job.mission.stem();
  row.variant = job.variant.name;
  row.seed = job.seed;
  row.folder = job.out;
  row.result.outcome = MissionOutcome::cancelled;  // until it has run
  return row;
}

}  // namespace cairn
