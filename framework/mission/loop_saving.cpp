// What the mission writes. Its map: at its end, when a step asks for it, and meanwhile; and how it goes on from there.

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "framework/mission/loop.hpp"
#include "framework/mission/resume.hpp"
#include "framework/mission/saved_content.hpp"
#include "framework/planning/plan_answer.hpp"
#include "framework/planning/plan_task.hpp"
#include "framework/planning/tour.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

void add_sentence(std::string& reason, const std::string& sentence) {
  reason += (reason.empty() ? "" : "; ") + sentence;
}

bool is_of_a_finished_mission(const std::filesystem::path& map) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(map, error)) return false;
  try {
    const auto progress = MapFile(map).without_cells().progress;
    return progress && progress->step_name.empty();
  } catch (const StoreError&) {
    return false;
  }
}

}  // namespace

void MissionLoop::restore(const SavedMap& map) {
  const MissionProgress& progress = *map.progress;
  tracker_.restore(map.graph, progress.candidates, map.driven_path);
  result_.resumed_s = result_.time_s = last_freed_check_s_ = progress.time_s;
  result_.distance_m = progress.distance_m;
  result_.paused_s = paused_before(map);
  result_.readings = progress.readings;
  result_.matchings = progress.matchings;
  result_.collisions = progress.collisions;
  step_ = static_cast<std::size_t>(progress.step);
  resumed_true_pose_ = progress.true_T_map_robot;
  if (!map.driven_path.empty()) T_map_first_start_ = map.driven_path.front();
  values_ = saved_named_values(map);
  restore_tree(map);
}

// Only into the tree that it is of: with another one the step begins afresh.
void MissionLoop::restore_tree(const SavedMap& map) {
  if (step_ >= trees_.size()) return;
  const std::optional<SavedTree> saved = saved_tree(map);
  if (!saved) return;
  if (saved->fingerprint != tree_fingerprint(mission_.steps[step_])) {
    not_restored_ = "step " + std::to_string(step_ + 1) + " (" + mission_.steps[step_].name +
                    ") is not written as when the map was saved: it begins afresh";
    return;
  }
  try {
    trees_[step_].restore(saved->state, result_.time_s);
  } catch (const std::invalid_argument& error) {
    throw StoreError(std::string("cannot be gone on from: its property ") + kTreeStateProperty + ": " + error.what());
  }
}

// A log begins at its beginning again. The last observation that the map holds tells the localizer where the odometry
// was then.
bool MissionLoop::is_known_already(const Observation& observation) {
  if (drive_ != nullptr || !result_.resumed_s || begun_) return false;
  if (!skipped_) begin_s_ = observation.stamp_s;
  skipped_ = true;
  const double time_s = observation.stamp_s - begin_s_;
  if (time_s > *result_.resumed_s) return false;
  if (time_s == *result_.resumed_s) {
    pose_ = localize();
    T_odom_last_ = observation.T_odom_robot;
  }
  return true;
}

MissionProgress MissionLoop::progress() const {
  MissionProgress progress;
  progress.time_s = result_.time_s;
  const std::size_t step = failed_step_ ? step_ - 1 : step_;
  progress.step = static_cast<int>(step);
  if (step < mission_.steps.size()) progress.step_name = mission_.steps[step].name;
  progress.T_map_robot = pose_.T_map_robot;
  progress.true_T_map_robot = begun_ ? observation_.true_T_map_robot : resumed_true_pose_;
  progress.distance_m = result_.distance_m;
  progress.readings = result_.readings;
  progress.matchings = result_.matchings;
  progress.collisions = result_.collisions;
  return progress;
}

// Nothing in here may change what the mission does next. The hierarchies are not brought in line: when they are
// decides which ids their clusters get, and autosaves come when the wall clock says so.
void MissionLoop::autosave() {
  report_of_autosave();
  if (!autosaver_.is_due()) return;
  const Autosaver::Clock::time_point begin = Autosaver::Clock::now();
  autosaver_.save(map_so_far(hierarchies_.last_tree()), begin);
}

SavedMap MissionLoop::map_so_far(ClusterTree clusters) const {
  SavedMap map = map_of_mission(mission_, *grid_, tracker_, std::move(clusters), progress());
  add_pauses(map, result_.paused_s);
  add_named_values(map, values_);
  if (step_ < trees_.size() && step_begun_)
    add_tree(map, {tree_fingerprint(mission_.steps[step_]), tree_left_.value_or(trees_[step_].state())});
  return map;
}

void MissionLoop::report_of_autosave() {
  const auto outcome = autosaver_.last_outcome();
  if (!outcome) return;
  if (outcome->saved)
    publish(Autosaved{autosaver_.file().filename().string(), outcome->time_s, outcome->took_ms});
  else if (!autosave_has_failed_)
    publish(AutosaveFailed{outcome->reason});
  autosave_has_failed_ = autosave_has_failed_ || !outcome->saved;
}

// Whatever happened: the robot stops, and the map so far is saved.
void MissionLoop::finish() {
  try {
    stop_while_blocking();
  } catch (const ModuleFault&) {
    // It has failed already and is being left; there is no one else to tell.
  }
  if (paused_) publish(Resumed{result_.paused_s - paused_before_s_});
  if (step_begun_) halt_step();
  note_nodes();
  try {
    if (result_.outcome != MissionOutcome::cancelled) connect_landmarks();
  } catch (const ModuleFault& fault) {
    add_sentence(result_.reason, fault.what());
    result_.outcome = MissionOutcome::module_fault;
  }
  write_last_map();
}

// What an earlier run has finished is not given up for one that was cut short.
void MissionLoop::keep_finished_map(const std::string& name) {
  const bool is_earlier = result_.map_file != name && !(options_.resume != nullptr && result_.resumed_s);
  if (result_.outcome == MissionOutcome::done || !is_earlier || !is_of_a_finished_mission(options_.out / name)) return;
  if (const auto kept = keep_earlier_autosave(options_.out / name))
    publish(Message{"this mission did not end: the map of an earlier one that did is kept as " +
                    kept->filename().string()});
}

// The autosave has done its work when a whole map has taken its place.
void MissionLoop::write_last_map() {
  autosaver_.finish();
  report_of_autosave();
  result_.autosave = autosaver_.figures();
  const std::string name = mission_.config.mission + ".cairn";
  keep_finished_map(name);
  const Status saved = write_map(name);
  if (saved.progress != Progress::success) {
    not_saved_ = saved.reason;
    if (result_.autosave.saved > 0)
      not_saved_ += "; " + autosaver_.file().filename().string() + " holds it up to " +
                    std::to_string(std::lround(result_.autosave.last_time_s)) + " s";
  } else if (result_.autosave.saved > 0 && autosaver_.file().filename() != name) {
    std::error_code error;
    std::filesystem::remove(autosaver_.file(), error);
  }
  if (not_saved_.empty()) return;
  add_sentence(result_.reason, not_saved_);
  if (result_.outcome == MissionOutcome::done) result_.outcome = MissionOutcome::map_not_saved;
}

// A step that could not save does not end the mission: where it drives matters too.
Status MissionLoop::save(const std::string& file_name) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  stop_while_blocking();
  // Autosaves would write over it, and take it away at the end.
  if (mission_.config.autosave.every_s > 0.0 && file_name == autosaver_.file().filename())
    return {Progress::failure, file_name + " is the name of the mission's autosaves"};
  const Status saved = write_map(file_name);
  if (saved.progress != Progress::success) {
    save_failed_ = true;
    if (not_saved_.empty()) not_saved_ = saved.reason;
  }
  return saved;
}

// Of an earlier mission into the same folder nothing may be left in a file, nor may it be in the way.
Status MissionLoop::write(const OutputText& output) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  const std::string& name = output.file_name;
  const bool is_plain =
      !name.empty() && name != "." && name != ".." && name.find_first_of("/\\\n") == std::string::npos;
  if (!is_plain) return {Progress::failure, "\"" + name + "\" is no plain file name"};
  const bool is_ours = options_.resume != nullptr || written_.contains(name);
  const auto mode = output.append && is_ours ? std::ios::app : std::ios::trunc;
  std::ofstream out(options_.out / name, std::ios::binary | mode);
  out << output.text;
  out.close();
  if (!out) return {Progress::failure, name + " could not be written"};
  written_.insert(name);
  return {Progress::success, "wrote " + name};
}

// The answer goes without the times that it took: the same mission writes the same bytes.
Status MissionLoop::answer(const PlanQuestion& question, const std::string& file_name) {
  hierarchies_.update();
  const ClusterTree clusters = question.avoid.empty() && !question.explain ? ClusterTree{} : hierarchies_.tree();
  PlanTask task;
  try {
    task = task_of(question, tracker_.graph(), clusters, pose_.T_map_robot);
  } catch (const std::exception& error) {
    return {Progress::failure, error.what()};
  }
  task.request.radius_m = mission_.robot.radius_m;
  task.request.seed = module_seed(mission_.config.seed, PluginKind::planner, 2);
  const PlanResult result =
      plan_tour([&](const PlanRequest& request) { return plan(request); }, task.request, task.via);
  const Status written = write({file_name,
                                json_text_of({.question = question,
                                              .result = result,
                                              .graph = tracker_.graph(),
                                              .clusters = clusters,
                                              .with_times = false}) +
                                    "\n",
                                true});
  if (written.progress != Progress::success) return written;
  if (result.outcome == PlanOutcome::solved) return {Progress::success, fmt::format("{:.2f} m", result.length_m)};
  return {Progress::failure, std::string(name_of(result.outcome)) + ": " + result.reason};
}

Status MissionLoop::write_map(const std::string& file_name) {
  if (grid_ == nullptr) return {Progress::failure, "there is no map to save"};
  result_.explored_ratio = known_ratio(*grid_);
  hierarchies_.update();
  try {
    save_map(options_.out / file_name, map_so_far(hierarchies_.tree()));
  } catch (const std::exception& error) {
    return {Progress::failure, std::string("the map could not be saved: ") + error.what()};
  }
  result_.map_file = file_name;
  publish(MapSaved{file_name});
  return {Progress::success, "saved " + file_name};
}

}  // namespace cairn
