// Runs a mission: one thread of control, one tick after the other (docs/architecture.md, "One tick").
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/behaviour_tree/node_runs.hpp"
#include "framework/behaviour_tree/runner.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/localisation/self_finder.hpp"
#include "framework/mission/localisation/watch_figures.hpp"
#include "framework/mission/mission.hpp"
#include "framework/mission/orders/order_text.hpp"
#include "framework/mission/run_control.hpp"
#include "framework/modules/module_library.hpp"
#include "framework/modules/stage_clock.hpp"
#include "framework/modules/wall_clock.hpp"
#include "framework/safety/config.hpp"
#include "maps/clustering/cluster_levels.hpp"
#include "maps/pose_graph/relation_errors.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

enum class MissionOutcome { done, step_failed, out_of_time, cancelled, sensor_fault, module_fault, map_not_saved };
[[nodiscard]] std::string_view name_of(MissionOutcome outcome);

// A saved map in which the robot finds out where it is, and which is left alone.
struct LocaliseIn {
  const SavedMap* map = nullptr;     // must outlive the runner
  std::optional<Pose2> T_map_start;  // none: anywhere
};

struct RunOptions {
  std::filesystem::path out;  // folder of everything written; must exist
  // Seconds of the mission in a second of the wall clock, at most; 0: as fast as the machine. Changes no result.
  double pace = 0.0;
  const std::atomic<bool>* cancel = nullptr;
  bool autosave = false;                // as the mission's settings say
  const SavedMap* resume = nullptr;     // go on from this map; must outlive the constructor's call only
  RunControl* control = nullptr;        // must outlive the runner
  std::vector<RecordedOrder> orders{};  // that are given again
  // For pacing, intervals and the watch over modules.
  std::shared_ptr<const WallClock> wall_clock = std::make_shared<SteadyClock>();
  std::optional<LocaliseIn> localise_in = std::nullopt;  // not with resume
  // With resume: where the robot is, which is not checked then. None: where the map was left.
  std::optional<Pose2> T_map_resumed = std::nullopt;
  // Gets a sentence, once each time that the sensor waits for a robot, by the thread of MissionRunner::run(); and while
  // the runner is made, every ten seconds that the sensor waits for where the robot begins, by another thread.
  std::function<void(const std::string&)> on_wait{};
};

struct StepReport {
  std::string name;
  Status status;
  double begin_s = 0.0;
  double end_s = 0.0;
};

struct MissionResult {
  MissionOutcome outcome = MissionOutcome::done;
  std::string reason;  // a sentence for people; empty when all went well
  std::vector<StepReport> steps;
  NodeRuns node_runs;             // each time that a node ran
  std::vector<NodeReport> nodes;  // of all nodes that were ticked, the steps among them, in the order of the file
  std::int64_t readings = 0;
  std::int64_t matchings = 0;
  std::int64_t collisions = 0;
  double distance_m = 0.0;
  double time_s = 0.0;                             // simulated or recorded
  double paused_s = 0.0;                           // not in time_s
  double explored_ratio = 0.0;                     // of the map as it was last saved, or would have been
  std::optional<double> resumed_s = std::nullopt;  // mission time at which this run went on from a saved map
  CollisionMonitorFigures collision_monitor{};
  std::string hearing{};  // for people: which transducers were deaf, and when; empty: none
  AutosaveFigures autosave{};
  ClusterTree clusters{};  // of the landmarks, as they were last clustered
  std::vector<ClusterLevel> cluster_levels{};
  std::vector<StampedPose> poses{};  // of all observations, as known at the end; none for most missions that drive
  std::optional<LocalisationFigures> localisation{};  // of a run that leaves its map alone
  std::optional<PoseCheck> start_check{};             // of a run that goes on with a map, and drives
  WatchFigures watch{};                               // whether the robot was carried under way
  std::optional<SubmapCounts> pose_graph{};           // of the map as it was last saved, earlier runs' part too
  std::uint64_t map_moves = 0;                        // how often the map was drawn anew, or exchanged
  std::string map_file;                               // name in the output folder; empty: could not be saved
};

class MissionLoop;

class MissionRunner {
 public:
  // Builds every module; the library must outlive the runner. Throws ConfigError (the user's files), ModuleFault (a
  // module's fault) or StoreError (the map to go on from does not fit).
  MissionRunner(const Mission& mission, const ModuleLibrary& library, const RunOptions& options);
  ~MissionRunner();

  // The listener must outlive the runner. It cannot change what happens: one that throws gets
  // nothing more, and what it threw is kept.
  void subscribe(Listener& listener);
  [[nodiscard]] const std::vector<std::string>& listener_faults() const;
  // Where the robot begins: as the mission says, or the sensor.
  [[nodiscard]] const Pose2& T_map_start() const;
  // A robot is driven, simulated or real; else a log is played back.
  [[nodiscard]] bool has_drive() const;
  // The mission runs in a thread of its own, watched by this one every 20 ms: when no tick has ended for the collision
  // monitor's stop_after_s, the wheels are stopped until one does; a module whose call does not return within the
  // mission's watchdog_s (0: never), or that calls exit(), ends the mission (outcome module_fault) and is left behind.
  MissionResult run();
  // A thread was left behind: in a module's call, in exit(), or in on_wait of the options. So the process should end
  // without tearing anything down (std::_Exit).
  [[nodiscard]] bool gave_up() const { return gave_up_; }

  // How it stands, and where it has driven: for listeners, while an event is published.
  [[nodiscard]] RunStatus status() const;
  [[nodiscard]] std::vector<NodeReport> node_reports() const;  // of all nodes that were ticked
  [[nodiscard]] const std::vector<Pose2>& driven_path() const;
  [[nodiscard]] ClusterTree clusters() const;  // as they were last brought in line

  // After run(). The grids are null when the module that was left behind was working on them.
  [[nodiscard]] const OccupancyGrid* grid() const;
  [[nodiscard]] const CoarseGrid* coarse_grid() const;
  [[nodiscard]] const LandmarkGraph& graph() const;
  [[nodiscard]] std::vector<StageTime> times() const;  // wall clock: differs from run to run

 private:
  void watch();

  std::shared_ptr<MissionLoop> loop_;
  std::shared_ptr<const WallClock> wall_clock_;
  RunControl* control_ = nullptr;
  double longest_call_s_ = 0.0;
  std::function<void(const std::string&)> on_wait_;
  bool gave_up_ = false;
};

}  // namespace cairn
