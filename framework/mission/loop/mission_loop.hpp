// The one thread of control of a mission: one tick after the other (docs/architecture.md, "One tick").
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <vector>

#include "framework/contracts/optional/wait_report.hpp"
#include "framework/mission/clock/mission_clock.hpp"
#include "framework/mission/clock/pace.hpp"
#include "framework/mission/clock/pauses.hpp"
#include "framework/mission/hearing/hearing_record.hpp"
#include "framework/mission/localisation/carried_watch.hpp"
#include "framework/mission/localisation/self_finder.hpp"
#include "framework/mission/loop/display_feed.hpp"
#include "framework/mission/loop/hold_record.hpp"
#include "framework/mission/loop/run_counts.hpp"
#include "framework/mission/loop/steps.hpp"
#include "framework/mission/perception/perception.hpp"
#include "framework/modules/plausibility.hpp"
#include "framework/safety/fatal_ends.hpp"

namespace cairn {

class MissionLoop {
 public:
  // Throws ConfigError, ModuleFault or StoreError.
  MissionLoop(const Mission& mission, const ModuleLibrary& library, const RunOptions& options);

  void subscribe(Listener& listener) { publisher_.subscribe(listener); }
  // To the end, whatever happens. Throws nothing.
  void run();
  // From another thread, while run() runs, every few milliseconds: stops the wheels when ticks have stopped ending.
  void stop_if_stalled();
  // From the same thread, for people: what the sensor waits for; empty: nothing.
  [[nodiscard]] std::string waits_for() const;
  // From the same thread: when one call of a module has lasted longer than that (0: none is too long), or a module has
  // called exit(), ends the mission in its place (stops the robot, saves the map) and returns true. run() then returns
  // as soon as the lost call does, if ever, and touches nothing more.
  bool give_up_after(std::chrono::nanoseconds longest);

  // While run() runs, in its thread.
  [[nodiscard]] RunStatus status() const;
  [[nodiscard]] std::vector<NodeReport> node_reports() const { return steps_.node_reports(); }
  // After run(), or after give_up_after() returned true.
  [[nodiscard]] MissionResult result() const;
  [[nodiscard]] RunStatus last_status() const;
  [[nodiscard]] const OccupancyGrid* grid() const { return world_.grid; }
  [[nodiscard]] const CoarseGrid* coarse_grid() const { return world_.coarse; }
  // Of the map that grid() is.
  [[nodiscard]] const LandmarkGraph& graph() const { return world_.known_graph(); }
  [[nodiscard]] const LandmarkTracker& tracker() const { return perception_.tracker(); }
  [[nodiscard]] std::vector<StageTime> times() const { return modules_.clock.times(); }
  [[nodiscard]] ClusterTree clusters() const { return planning_.last_clusters(); }
  [[nodiscard]] bool has_drive() const { return modules_.has_drive; }
  [[nodiscard]] const Pose2& T_map_start() const { return modules_.T_map_start; }
  // exit() was called in a thread of a module's own, which never leaves it.
  [[nodiscard]] bool exit_was_called_elsewhere() const { return fatal_ends_.exit_was_called_elsewhere(); }
  [[nodiscard]] const std::vector<std::string>& listener_faults() const { return publisher_.listener_faults(); }

 private:
  struct Sensed {
    SensorStep step;
    std::optional<GroundTruth> truth{};  // of the step's observation, for listeners only
  };
  static constexpr const char* kExitElsewhere = "exit() was called in a thread of a module's own";
  // Whether the robot was carried; until it has found itself, if so.
  struct OpenCheck {
    PoseCheck check;
    std::shared_ptr<const MapSnapshot> before;  // what it would go back to
    Pose2 T_map_begin;                          // where it was believed to be when the check began
    double begun_s = 0.0;
    std::optional<DoubtCause> cause;  // none: the run goes on with a map
  };
  struct Ending {
    MissionOutcome outcome = MissionOutcome::done;
    std::string reason{};
  };

  Ending loop();
  Sensed sense();
  void tick(Sensed sensed);
  void take(Sensed sensed);
  StepsTick tick_steps();
  void publish_driven(const CellChanges& cells);
  void show();
  // The host's own work, in its stage.
  template <class DoIt>
  auto in(StageClock::Id stage, DoIt&& do_it) -> decltype(do_it()) {
    const StageClock::Work work(modules_.clock, stage);
    return do_it();
  }
  [[nodiscard]] std::vector<ExpectedEcho> expected_of(const Observation& observation) const;
  void keep_pace();
  [[nodiscard]] std::optional<Ending> ending_after_tick() const;
  [[nodiscard]] Ending at_end_of_data(const std::string& reason) const;
  void wait_while_paused();
  bool is_known_already(const Observation& observation);
  void restore(const SavedMap& map);
  [[nodiscard]] SavedMap map_so_far(ClusterTree clusters) const;
  [[nodiscard]] KeptSubmaps submaps_to_save();
  void finish();
  void save_last();
  void redraw_map();
  void publish_work_at_end();
  void move_map();
  void begin_localisation(const LocaliseIn& localise);
  void begin_watch();
  void begin_check(std::shared_ptr<const MapSnapshot> before, const Pose2& T_map_robot,
                   const std::optional<DoubtCause>& cause);
  void begin_check_in_doubt();
  [[nodiscard]] bool is_check_open() const;
  [[nodiscard]] bool may_autosave() const;
  [[nodiscard]] bool is_watched() const;
  void end_search();
  void look_where_robot_is();
  void check_pose();
  void lose_itself();
  void publish_carried(std::size_t landmarks_forgotten);
  void find_itself();
  void connect_landmarks();
  [[nodiscard]] Stalled stalled_for(double for_s) const;
  void publish_any(const std::optional<Event>& event);
  void publish_all(const std::vector<std::string>& sentences);
  [[nodiscard]] RunStatus status_in(RunState state) const;

  const Mission mission_;
  const RunOptions options_;
  const ModuleLibrary& library_;
  const std::optional<OccupancyGrid> grid_so_far_;  // what the map of a run that goes on began with
  const KeptSubmaps submaps_so_far_;                // and its submaps, where they can be used
  const std::string submaps_fault_;                 // why not; empty: they can, or there are none
  const Budget budget_;
  const std::shared_ptr<const OccupancyGrid> map_left_alone_;
  std::optional<LocalisationFigures> localisation_;
  StagedModules modules_;
  Perception perception_;
  WorldState world_;
  Publisher publisher_;
  MissionClock clock_;
  ObservationCheck observation_check_;
  Pace pace_;
  Pauses pauses_;
  RunCounts counts_;
  HoldRecord holds_;
  CollisionMonitor monitor_;
  HearingRecord hearing_;
  std::atomic<const WaitReport*> wait_report_{nullptr};  // of the sensor, if it reports
  std::atomic<StageClock::Id> stalled_stage_{StageClock::kHost};
  Planning planning_;
  MapSaving saving_;
  Orders orders_;
  DisplayFeed display_;
  Steps steps_;
  std::optional<PoseCheck> start_check_;  // of a run that goes on: whether the robot was carried
  std::optional<CarriedWatch> watch_;
  std::optional<OpenCheck> check_;
  std::optional<SelfFinder> finder_;  // while the robot does not know where it is, or is checked
  EndingSearches ending_searches_;    // of finders that are gone
  Ending ending_;
  FatalEnds fatal_ends_;  // the last: what it shows must be there
};

}  // namespace cairn
