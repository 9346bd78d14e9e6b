// An experiment: missions, each in several variants and on many seeds, and what is measured of every run.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "framework/experiments/config.hpp"
#include "framework/experiments/homes/record.hpp"
#include "framework/experiments/homes/tag_record.hpp"
#include "framework/experiments/jobs.hpp"
#include "framework/experiments/map_quality.hpp"
#include "framework/experiments/recognition/curves.hpp"
#include "framework/experiments/recognition/orbit.hpp"
#include "framework/experiments/recognition/places.hpp"
#include "framework/experiments/recognition/recognition.hpp"
#include "framework/experiments/recognition/ring_profile.hpp"
#include "framework/experiments/trials/trials.hpp"
#include "framework/mission/runner.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/reporting/report.hpp"

namespace cairn {

struct ExperimentRow {
  std::string mission;
  std::string variant;
  std::int64_t seed = 0;
  std::filesystem::path folder;  // of the run
  MissionResult result;
  TruthScore score;
  double worst_error_m = 0.0;
  std::optional<MapQuality> quality;  // where there is a true world
  std::int64_t held_out = 0;
  double held_out_log_likelihood = 0.0;  // mean, nat
  std::vector<PlaceDegrees> places;      // one a place of the experiment
  std::vector<OrbitSample> orbit;        // of the experiment's lap
  std::vector<Verdict> verdicts;         // of an experiment of recognition or of curves
  RingProfile ring;                      // of an experiment of recognition that asks for it
  std::vector<DetectorSweep> sweeps;     // of an experiment of curves, one a detector
  std::vector<TimedContact> contacts;    // by the truth, where it is known
  std::optional<TrialVerdict> trial;     // of an experiment of trials
  std::optional<HomeVerdict> home;       // of an experiment of homes
  std::optional<TagVerdict> tags;        // where tags hang in them and the robot has a camera
  StageTime tick;                        // wall clock of the host's ticks, all but the sensor's part
  double step_rad = 0.0;                 // between the orientations of the templates
  double wall_s = 0.0;
  double detector_wall_s = 0.0;
  bool gave_up = false;  // a module was left behind: see MissionRunner::gave_up()

  // All landmarks of the world found within the tolerance, none besides, nothing bumped into.
  [[nodiscard]] bool is_good() const;
};

// Which runs, by their place in jobs_of(), and what is called after each, one at a time.
struct RunFilter {
  std::function<bool(std::size_t)> is_wanted{};  // none: all
  std::function<bool(std::size_t)> may_begin{};  // asked when the run would begin, from any thread; none: it may
  std::function<void(const ExperimentRow&)> has_run{};
};

// Runs everything, as many at a time as the machine has cores, but at most eight; rows come by mission, variant and
// seed. A recorded log is the same in each run: it is run on as many seeds as withhold other readings. Each run writes
// its map and report into a folder of its own under out. Throws ConfigError or ModuleFault; the first fault stops the
// runs that have not begun. ended: told after each run how many have ended, of how many, from any thread but one at a
// time.
[[nodiscard]] std::vector<ExperimentRow> run_experiment(const ExperimentConfig& config, const ModuleLibrary& library,
                                                        const std::filesystem::path& out,
                                                        const std::atomic<bool>& cancel,
                                                        const std::function<void(std::size_t, std::size_t)>& ended = {},
                                                        const RunFilter& filter = {});

// A run that has not begun: cancelled.
[[nodiscard]] ExperimentRow row_before_run(const ExperimentJob& job);

}  // namespace cairn
