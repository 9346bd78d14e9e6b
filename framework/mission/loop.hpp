// The one thread of control of a mission: one tick after the other (DESIGN, "One tick, as data").
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "framework/behaviour_tree/condition.hpp"
#include "framework/behaviour_tree/runner.hpp"
#include "framework/landmarks/sightings.hpp"
#include "framework/landmarks/tracker.hpp"
#include "framework/mission/held_out.hpp"
#include "framework/mission/modules.hpp"
#include "framework/mission/named_values.hpp"
#include "framework/mission/runner.hpp"
#include "framework/modules/fence.hpp"
#include "framework/modules/stage_clock.hpp"
#include "framework/safety/collision_monitor.hpp"
#include "maps/hierarchy/hierarchies.hpp"

namespace cairn {

class MissionLoop : private BehaviourContext, private TreeHost {
 public:
  // Throws ConfigError, ModuleFault or StoreError.
  MissionLoop(const Mission& mission, const ModuleLibrary& library, const RunOptions& options);

  void subscribe(Listener& listener) { listeners_.push_back(&listener); }
  // To the end, whatever happens. Throws nothing.
  void run();
  // From another thread, while run() runs: when one call of a module has lasted longer than that, ends
  // the mission in its place (stops the robot, saves the map) and returns true. run() then returns as
  // soon as the lost call does, if ever, and touches nothing more.
  bool give_up_after(std::chrono::nanoseconds longest);

  // While run() runs, in its thread.
  [[nodiscard]] RunStatus status() const;
  // After run(), or after give_up_after() returned true.
  [[nodiscard]] const MissionResult& result() const { return result_; }
  [[nodiscard]] RunStatus last_status() const;
  [[nodiscard]] const OccupancyGrid* grid() const { return grid_is_lost_ ? nullptr : grid_; }
  [[nodiscard]] const CoarseGrid* coarse_grid() const { return grid_is_lost_ ? nullptr : coarse_; }
  [[nodiscard]] const LandmarkTracker& tracker() const { return tracker_; }
  [[nodiscard]] std::vector<StageTime> times() const { return clock_.times(); }
  [[nodiscard]] const Pose2& T_map_start() const { return modules_.T_map_start; }
  [[nodiscard]] const std::vector<std::string>& listener_faults() const { return listener_faults_; }

 private:
  template <class Call>
  auto in_stage(StageClock::Id stage, Call&& call) -> decltype(call());
  MissionOutcome loop();
  void tick();
  void account_for(const Observation& observation);
  PoseEstimate localize();
  std::span<const LandmarkSighting> see_again();
  const CellChanges& build_map();
  void detect(const CellChanges& changes);
  void report_changes(const std::vector<LandmarkTracker::Change>& changes);
  void pace(double stamp_s);
  void wait_while_paused();
  void apply_control();
  [[nodiscard]] bool is_pause_wanted() const;
  [[nodiscard]] std::optional<TimeLeft> time_left() const;
  void behave();
  void build_trees();
  void begin_step(const std::string& name);
  void end_step(const TreeNode& step, const Status& status);
  void note_nodes();
  void drive_on();
  void stop_while_blocking();
  void connect_landmarks();
  MissionOutcome at_end_of_data(const std::string& reason);
  MissionOutcome ended(MissionOutcome outcome, std::string reason);
  void restore(const SavedMap& map);
  void restore_tree(const SavedMap& map);
  void show_grid_to_detector();
  [[nodiscard]] bool is_known_already(const Observation& observation);
  [[nodiscard]] MissionProgress progress() const;
  [[nodiscard]] SavedMap map_so_far(ClusterTree clusters) const;
  void autosave();
  void report_of_autosave();
  void finish();
  void write_last_map();
  void keep_finished_map(const std::string& name);
  void stop();
  void halt_step();
  Status write_map(const std::string& file_name);
  [[nodiscard]] WorldView view() const;
  void publish(const Event& event);

  void drive(const Twist& wanted) override;
  ControlResult control(const ControlRequest& request) override;
  std::optional<Place> input(const std::string& name) override;
  void output(const std::string& name, const Place& place) override;
  PlanResult plan(const PlanRequest& request) override;
  Status save(const std::string& file_name) override;
  Status answer(const PlanQuestion& question, const std::string& file_name) override;
  Status write(const OutputText& output) override;
  void say(const std::string& sentence) override;

  LeafTick tick_leaf(const TreeNode& leaf) override;
  void halt_leaf(const TreeNode& leaf) override;
  void started(const TreeNode& node) override;
  void ended(const TreeNode& node, const NodeReport& how) override;
  void ran(const TreeNode& node, const NodeReport& how, double begun_s) override;

  const Mission mission_;
  const RunOptions options_;
  MissionModules modules_;
  LandmarkTracker tracker_;
  LandmarkSightings sightings_;
  Hierarchies hierarchies_;  // of the keeper's graph, brought in line before it is used
  double last_freed_check_s_ = 0.0;
  CollisionMonitor collision_monitor_;
  std::vector<Listener*> listeners_;
  std::vector<std::string> listener_faults_;
  StageClock clock_;
  StageClock::Id tick_ = 0, sensor_ = 0, localizer_ = 0, mapper_ = 0, detector_ = 0, planner_ = 0, routes_ = 0,
                 controller_ = 0, drive_stage_ = 0;
  struct Leaf {
    Behaviour* behaviour = nullptr;
    StageClock::Id stage = 0;
    bool has_ended = false;
  };
  std::map<const TreeNode*, Leaf> behaviours_;
  std::vector<TreeRunner> trees_;         // one a step
  const TreeNode* ticked_ = nullptr;      // the leaf that was ticked last
  const TreeNode* controlled_ = nullptr;  // the leaf that used the controller last
  NamedValues values_;                    // that behaviours hand over
  NodeTimes node_times_;
  std::optional<TreeState> tree_left_;  // of the step under way, before it was halted
  ConditionCheck check_;
  MissionResult result_;
  Budget budget_;
  Drive* drive_ = nullptr;               // of the sensor; null for a log
  const OccupancyGrid* grid_ = nullptr;  // of the mapper
  const CoarseGrid* coarse_ = nullptr;   // of the detector
  bool grid_is_lost_ = false;            // its module was given up while it worked on it
  Observation observation_;
  HoldOut hold_out_;
  Observation for_map_;  // without what is withheld
  PoseEstimate pose_;
  Pose2 T_odom_last_;
  Pose2 T_odom_localized_;  // where pose_ is from
  Twist wanted_;
  Twist commanded_;
  std::optional<Twist> ordered_;  // by the leaf that is ticked
  double begin_s_ = 0.0;
  double speed_reduction_ratio_ = 0.0;
  std::size_t step_ = 0;
  bool begun_ = false;
  bool localized_ = false;
  bool skipped_ = false;  // observations that the map gone on from holds already
  bool bumped_ = false;
  bool step_begun_ = false;
  bool failed_step_ = false;
  std::string failure_;
  bool save_failed_ = false;  // in this tick
  std::string not_saved_;     // the first reason
  Autosaver autosaver_;
  bool autosave_has_failed_ = false;
  std::optional<Pose2> resumed_true_pose_;
  Pose2 T_map_first_start_;        // resumed or not
  std::set<std::string> written_;  // names of the texts of this run
  std::string not_restored_;       // a sentence on where a resumed mission goes on
  bool paused_ = false;
  double paused_before_s_ = 0.0;  // when this pause began
  double last_stamp_s_ = 0.0;
  struct Pace {
    std::chrono::steady_clock::time_point wall;
    double stamp_s;
  };
  std::optional<Pace> pace_;  // wall clock and observations go together from here on
};

// However the call comes back, a mission that was given up meanwhile is touched no more.
template <class Call>
auto MissionLoop::in_stage(StageClock::Id stage, Call&& call) -> decltype(call()) {
  const auto visit_and_call = [&]() -> decltype(call()) {
    const StageClock::Visit visit(clock_, stage);
    return fenced(clock_.stage_of(stage), clock_.module_of(stage), std::forward<Call>(call));
  };
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      visit_and_call();
      clock_.check();
    } else {
      decltype(auto) result = visit_and_call();
      clock_.check();
      return result;
    }
  } catch (const ModuleFault&) {
    clock_.check();
    throw;
  }
}

}  // namespace cairn
