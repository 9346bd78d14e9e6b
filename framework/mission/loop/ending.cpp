// How a mission ends, what it leaves, and how it stands until then.

#include <fmt/format.h>

#include "framework/mission/loop/mission_loop.hpp"
#include "framework/mission/saved_content.hpp"
#include "maps/submaps/kept_submaps.hpp"

namespace cairn {
namespace {

constexpr std::chrono::nanoseconds kLongestAfterExit = std::chrono::seconds(1);

void add_sentence(std::string& reason, const std::string& sentence) {
  if (!sentence.empty()) reason += (reason.empty() ? "" : "; ") + sentence;
}

}  // namespace

void MissionLoop::stop_if_stalled() {
  const StageClock::Id stage = modules_.clock.current();
  monitor_.stop_if_stalled([&] { stalled_stage_ = stage; });
}

std::string MissionLoop::waits_for() const {
  const WaitReport* const report = wait_report_;
  return report == nullptr ? std::string() : report->waits_for();
}

bool MissionLoop::give_up_after(std::chrono::nanoseconds longest) {
  const bool has_exited = fatal_ends_.exit_was_called();
  const bool is_exit_elsewhere = fatal_ends_.exit_was_called_elsewhere();
  // The thread that a call waits for may have been the one that called exit().
  if (is_exit_elsewhere && (longest <= std::chrono::nanoseconds(0) || longest > kLongestAfterExit))
    longest = kLongestAfterExit;
  if (!has_exited && longest <= std::chrono::nanoseconds(0)) return false;
  const StageClock::Id lost = modules_.clock.give_up_after(has_exited ? std::chrono::nanoseconds(-1) : longest);
  if (lost == StageClock::kHost) return false;
  const StageClock::Id culprit = has_exited ? lost : modules_.culprit_of(lost);
  // From here on this thread is the only one that touches the mission; only what the lost call works on may still
  // change.
  monitor_.stop_at_once();
  const std::string& module = modules_.clock.module_of(culprit);
  const std::string& stage = modules_.clock.stage_of(culprit);
  const auto longest_ms = std::chrono::duration_cast<std::chrono::milliseconds>(longest).count();
  ending_ = {MissionOutcome::module_fault,
             has_exited          ? fmt::format("module {} called exit() in stage {}", module, stage)
             : is_exit_elsewhere ? kExitElsewhere
                                 : fmt::format("module {} has not returned from stage {} for {} ms and was given up",
                                               module, stage, longest_ms)};
  steps_.abandon(clock_.time_s(), ending_.reason);
  if (lost == modules_.mapper.stage() || world_.grid == nullptr) {
    world_.grid = nullptr;
    world_.coarse = nullptr;
    add_sentence(ending_.reason, "the map it works on could not be saved");
  } else {
    save_last();
  }
  return true;
}

std::optional<MissionLoop::Ending> MissionLoop::ending_after_tick() const {
  if (steps_.failure()) return Ending{MissionOutcome::step_failed, *steps_.failure()};
  if (!mission_.steps.empty() && steps_.are_done()) return Ending{};
  if (clock_.time_s() >= mission_.config.at_most_s)
    return Ending{MissionOutcome::out_of_time, "the mission's at_most_s has passed"};
  return std::nullopt;
}

MissionLoop::Ending MissionLoop::at_end_of_data(const std::string& reason) const {
  if (mission_.steps.empty()) return {MissionOutcome::done, reason};
  return {MissionOutcome::step_failed, "the sensor's data ended before the steps did"};
}

// It may take a minute, in which no tick comes.
void MissionLoop::publish_work_at_end() {
  if (options_.control == nullptr || world_.grid == nullptr || !perception_.has_history()) return;
  RunStatus status = status_in(RunState::running);
  status.doing = "the poses are corrected and the map is drawn for the last time";
  options_.control->publish(status);
}

// Whatever happened: the robot stops, and the map so far is saved.
void MissionLoop::finish() {
  try {
    monitor_.stop();
  } catch (const ModuleFault&) {
    // It has failed already and is being left; there is no one to report to.
  }
  publish_any(pauses_.end(clock_.paused_s()));
  if (ending_.outcome != MissionOutcome::done && hearing_.is_deaf()) add_sentence(ending_.reason, hearing_.summary());
  for (const std::string& fault : steps_.halt(clock_.time_s(), ending_.reason)) add_sentence(ending_.reason, fault);
  try {
    publish_work_at_end();
    if (world_.grid != nullptr && perception_.finish()) {
      redraw_map();
      world_.pose.T_map_robot = perception_.past().poses().back().T_map_robot;
    }
    if (ending_.outcome != MissionOutcome::cancelled && world_.grid != nullptr) connect_landmarks();
  } catch (const std::exception& fault) {  // whatever it is: the map is saved
    add_sentence(ending_.reason, fault.what());
    ending_.outcome = MissionOutcome::module_fault;
  }
  if (is_check_open() && check_->cause)
    publisher_.publish(
        Message{"the mission ends while it is checked whether the robot was carried: its place is in doubt"});
  save_last();  // first: searches may take a while
  ending_searches_.wait();
}

void MissionLoop::save_last() {
  const std::string not_saved = saving_.save_last(ending_.outcome == MissionOutcome::done);
  if (not_saved.empty()) return;
  add_sentence(ending_.reason, not_saved);
  if (ending_.outcome == MissionOutcome::done) ending_.outcome = MissionOutcome::map_not_saved;
}

void MissionLoop::restore(const SavedMap& map) {
  const MissionProgress& progress = *map.progress;
  perception_.restore(map);
  clock_.restore(progress.time_s, paused_before(map));
  counts_.restore({progress.readings, progress.matchings, progress.collisions, progress.distance_m});
  world_.time_s = progress.time_s;
  if (progress.true_T_map_robot) world_.truth = GroundTruth{*progress.true_T_map_robot};
  if (!map.driven_path.empty()) world_.T_map_start = map.driven_path.front();
  steps_.restore(map);
}

SavedMap MissionLoop::map_so_far(ClusterTree clusters) const {
  MissionProgress progress;
  progress.time_s = clock_.time_s();
  progress.T_map_robot = world_.map_before == nullptr ? world_.pose.T_map_robot : world_.T_map_before;
  if (world_.truth) progress.true_T_map_robot = world_.truth->T_map_robot;
  progress.distance_m = counts_.figures().distance_m;
  progress.readings = counts_.figures().readings;
  progress.matchings = counts_.figures().matchings;
  progress.collisions = counts_.figures().collisions;
  steps_.describe(progress);
  SavedMap map =
      map_of_mission(mission_, world_.mission_map(), perception_.tracker(), std::move(clusters), std::move(progress));
  map.submaps = submaps_so_far_;  // in autosaves, which do not wait for this run's
  add_pauses(map, clock_.paused_s());
  steps_.describe(map);
  return map;
}

// The map is worth more than they are: a module that fails at this costs only those of this run. A localizer that keeps
// none leaves those of earlier runs as they are; their part of the map has not moved.
KeptSubmaps MissionLoop::submaps_to_save() {
  if (ending_.outcome == MissionOutcome::module_fault) return submaps_so_far_;
  try {
    KeptSubmaps submaps = perception_.submaps();
    if (const std::string fault = fault_of(submaps); !fault.empty()) throw modules_.localizer.fault(fault);
    return submaps.empty() ? submaps_so_far_ : submaps;
  } catch (const ModuleFault& fault) {
    publisher_.publish(Message{std::string("the map is saved without the submaps of this run: ") + fault.what()});
    return submaps_so_far_;
  }
}

MissionResult MissionLoop::result() const {
  const RunFigures& counted = counts_.figures();
  MissionResult result;
  result.outcome = ending_.outcome;
  result.reason = ending_.reason;
  result.steps = steps_.reports();
  result.node_runs = steps_.node_runs();
  result.nodes = steps_.node_reports();
  result.readings = counted.readings;
  result.matchings = counted.matchings;
  result.collisions = counted.collisions;
  result.distance_m = counted.distance_m;
  result.time_s = clock_.time_s();
  result.paused_s = clock_.paused_s();
  result.explored_ratio = saving_.explored_ratio();
  result.resumed_s = clock_.resumed_s();
  result.collision_monitor = monitor_.figures();
  result.hearing = hearing_.summary();
  result.autosave = saving_.figures();
  result.localisation = localisation_;
  result.start_check = start_check_;
  if (watch_) result.watch = watch_->figures();
  if (is_check_open() && check_->cause) result.watch.add({check_->begun_s, *check_->cause, check_->check});
  result.pose_graph = saving_.pose_graph();
  result.map_moves = world_.map_moves;
  result.map_file = saving_.map_file();
  result.clusters = planning_.last_clusters();
  result.poses = perception_.past().poses();
  result.cluster_levels = levels_of(result.clusters, world_.graph);
  return result;
}

RunStatus MissionLoop::status_in(RunState state) const {
  RunStatus status;
  status.state = state;
  status.mission = mission_.config.mission;
  status.time_s = clock_.time_s();
  status.paused_s = clock_.paused_s();
  status.explored_ratio = world_.explored_ratio();
  status.T_map_robot = world_.pose.T_map_robot;
  status.trust = world_.pose.trust;
  status.distance_m = counts_.figures().distance_m;
  status.landmarks = world_.known_graph().landmarks().size();
  steps_.describe(status);
  return status;
}

RunStatus MissionLoop::status() const {
  RunStatus status = status_in(pauses_.is_paused() ? RunState::paused : RunState::running);
  steps_.describe_doing(status);
  status.left = steps_.time_left(clock_.time_s(), mission_.config.at_most_s - clock_.time_s());
  return status;
}

RunStatus MissionLoop::last_status() const {
  RunStatus status = status_in(RunState::ended);
  status.outcome = name_of(ending_.outcome);
  status.reason = ending_.reason;
  status.map_file = saving_.map_file();
  return status;
}

}  // namespace cairn
