#include "framework/mission/loop.hpp"

#include <cmath>

#include "framework/landmarks/evidence.hpp"
#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

constexpr double kFreedCheck_s = 1.0;  // between looks at the places of all landmarks

}  // namespace

MissionLoop::MissionLoop(const Mission& mission, const ModuleLibrary& library, const RunOptions& options)
    : mission_(mission),
      options_(options),
      modules_(build_modules(mission_, library, options.resume)),
      tracker_(mission_.config.landmarks, mission_.robot, mission_.shapes),
      sightings_(mission_.shapes),
      hierarchies_(tracker_.graph(), options.resume != nullptr ? options.resume->clusters : ClusterTree{},
                   {mission_.robot.max_v_mps, mission_.robot.max_w_radps, mission_.robot.radius_m}),
      collision_monitor_(mission_.config.collision_monitor, mission_.robot),
      hold_out_(mission_.config.hold_out_every, mission_.config.seed),
      autosaver_(options_.out / autosave_file_of(mission_.config),
                 options_.autosave ? mission_.config.autosave.every_s : 0.0) {
  budget_.cancel = options_.cancel;
  pose_.T_map_robot = T_map_first_start_ = modules_.T_map_start;
  const MissionConfig& config = mission_.config;
  tick_ = clock_.add("tick", "");
  sensor_ = clock_.add("sensor", config.sensor.name);
  localizer_ = clock_.add("localizer", config.localizer.name);
  mapper_ = clock_.add("map", config.map.name);
  if (modules_.detector) detector_ = clock_.add("detector", config.detector.name);
  if (modules_.planner) {
    planner_ = clock_.add("planner", config.planner.name);
    routes_ = clock_.add("routes", config.planner.name);
  }
  build_trees();
  drive_stage_ = clock_.add("drive", config.sensor.name);
  if (options.resume != nullptr) restore(*options.resume);
}

void MissionLoop::run() {
  try {
    drive_ = in_stage(sensor_, [&] { return modules_.sensor->drive(); });
    grid_ = &in_stage(mapper_, [&]() -> const OccupancyGrid& { return modules_.mapper->grid(); });
    if (result_.resumed_s) show_grid_to_detector();
    result_.outcome = loop();
  } catch (const GivenUp&) {
    return;  // the one who gave up tells
  } catch (const std::exception& fault) {
    result_.outcome = MissionOutcome::module_fault;
    result_.reason = fault.what();
  }
  try {
    finish();
  } catch (const GivenUp&) {
  }
}

bool MissionLoop::give_up_after(std::chrono::nanoseconds longest) {
  const StageClock::Id stage = clock_.give_up_after(longest);
  if (stage == StageClock::kHost) return false;
  // From here on this thread is the only one that touches the mission; only what the lost call works
  // on may still change.
  result_.outcome = MissionOutcome::module_fault;
  result_.reason = "module " + clock_.module_of(stage) + " has not returned from stage " + clock_.stage_of(stage) +
                   " for " + std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(longest).count()) +
                   " ms and was given up";
  if (step_begun_) {
    result_.steps.back().status = {Progress::failure, "given up: " + result_.reason};
    result_.steps.back().end_s = result_.time_s;
    tree_left_ = trees_[step_].state();
    trees_[step_].abandon(result_.time_s, result_.steps.back().status.reason);
  }
  note_nodes();
  if (drive_ != nullptr && stage != sensor_ && stage != drive_stage_) stop();
  grid_is_lost_ = stage == mapper_ || grid_ == nullptr;
  if (grid_is_lost_)
    result_.reason += "; the map it works on could not be saved";
  else
    write_last_map();
  return true;
}

MissionOutcome MissionLoop::loop() {
  if (!not_restored_.empty()) publish(Message{not_restored_});
  if (options_.control != nullptr) options_.control->publish(status());
  if (step_ == mission_.steps.size() && drive_ != nullptr) return MissionOutcome::done;
  while (true) {
    wait_while_paused();
    if (budget_.cancelled()) return ended(MissionOutcome::cancelled, "cancelled by the user");
    SensorStep step = in_stage(sensor_, [&] { return modules_.sensor->next(budget_); });
    if (step.state == SensorState::fault) return ended(MissionOutcome::sensor_fault, step.reason);
    if (step.state == SensorState::end_of_data) return at_end_of_data(step.reason);
    observation_ = std::move(step.observation);
    if (!std::isfinite(observation_.stamp_s) || !is_finite(observation_.T_odom_robot))
      throw ModuleFault("sensor", clock_.module_of(sensor_), "returned a stamp or an odometry that is not finite");
    if (is_known_already(observation_)) continue;
    const auto begin = std::chrono::steady_clock::now();
    tick();
    if (!pace_) clock_.add_time(tick_, std::chrono::steady_clock::now() - begin);
    if (failed_step_) return ended(MissionOutcome::step_failed, failure_);
    if (!mission_.steps.empty() && step_ == mission_.steps.size()) return MissionOutcome::done;
    if (result_.time_s >= mission_.config.at_most_s)
      return ended(MissionOutcome::out_of_time, "the mission's at_most_s has passed");
  }
}

// One tick: a list of sentences, each stage a value in and a value out.
void MissionLoop::tick() {
  account_for(observation_);
  pose_ = localize();
  tracker_.record_pose(pose_.T_map_robot);
  const CellChanges& changes = build_map();
  detect(changes);
  collision_monitor_.see(observation_);
  apply_control();
  behave();
  drive_on();
  publish(TickDone{});
  if (options_.control != nullptr) options_.control->tick([this] { return status(); });
  autosave();
}

void MissionLoop::account_for(const Observation& observation) {
  if (!begun_ && !skipped_) begin_s_ = observation.stamp_s - result_.resumed_s.value_or(0.0);
  if (begun_) result_.distance_m += (observation.T_odom_robot.position() - T_odom_last_.position()).norm();
  // The clock stands while the mission is paused.
  if (paused_) {
    begin_s_ += observation.stamp_s - last_stamp_s_;
    result_.paused_s += observation.stamp_s - last_stamp_s_;
  }
  last_stamp_s_ = observation.stamp_s;
  begun_ = true;
  T_odom_last_ = observation.T_odom_robot;
  result_.time_s = observation.stamp_s - begin_s_;
  result_.readings += static_cast<std::int64_t>(observation.ranges.size());
  if (observation.bumped && !bumped_) {
    ++result_.collisions;
    publish(Bumped{});
  }
  bumped_ = observation.bumped;
  pace(observation.stamp_s);
}

// With the first observation there is no telling where the odometry begins.
std::span<const LandmarkSighting> MissionLoop::see_again() {
  if (!localized_ || !mission_.config.landmarks.correct_pose) return {};
  return sightings_.look(observation_, pose_, T_odom_localized_, tracker_.graph(), *grid_);
}

PoseEstimate MissionLoop::localize() {
  const std::span<const LandmarkSighting> seen = see_again();
  PoseEstimate pose = in_stage(localizer_, [&] { return modules_.localizer->update(observation_, seen); });
  T_odom_localized_ = observation_.T_odom_robot;
  localized_ = true;
  if (!is_finite(pose.T_map_robot) || !pose.covariance.allFinite())
    throw ModuleFault("localizer", clock_.module_of(localizer_), "returned a pose that is not finite");
  return pose;
}

const CellChanges& MissionLoop::build_map() {
  const bool all = mission_.config.hold_out_every == 0;
  if (!all) {
    for_map_ = observation_;
    std::erase_if(for_map_.ranges, [&](const RangeReading&) { return hold_out_.next(); });
  }
  const Observation& seen = all ? observation_ : for_map_;
  return in_stage(mapper_, [&]() -> const CellChanges& { return modules_.mapper->integrate(seen, pose_); });
}

void MissionLoop::detect(const CellChanges& changes) {
  if (!modules_.detector) return;
  const DetectionReport report = in_stage(detector_, [&] {
    DetectionReport found = modules_.detector->detect(*grid_, changes, budget_);
    coarse_ = modules_.detector->coarse_grid();
    return found;
  });
  for (const Matching& matching : report.matchings) {
    ++result_.matchings;
    publish(MatchingDone{matching});
    if (!is_finite(matching))
      throw ModuleFault("detector", clock_.module_of(detector_), "returned a detection that is not finite");
    report_changes(tracker_.update(matching));
  }
  if (result_.time_s < last_freed_check_s_ + kFreedCheck_s) return;
  last_freed_check_s_ = result_.time_s;
  report_changes(tracker_.retire_freed(*grid_));
}

// What the earlier run has mapped is no news: it is shown with a budget that allows no matching, so that old evidence
// does not count twice.
void MissionLoop::show_grid_to_detector() {
  if (!modules_.detector || grid_->bounds().empty()) return;
  const std::atomic<bool> cancelled = true;
  Budget nothing;
  nothing.cancel = &cancelled;
  in_stage(detector_, [&] {
    (void)modules_.detector->detect(*grid_, everything_in(grid_->bounds()), nothing);
    coarse_ = modules_.detector->coarse_grid();
  });
}

void MissionLoop::report_changes(const std::vector<LandmarkTracker::Change>& changes) {
  for (const auto& [id, kind] : changes) {
    if (kind == LandmarkTracker::ChangeKind::retired) {
      const RetiredLandmark& retired = tracker_.graph().retired().at(id);
      publish(LandmarkRetired{retired.landmark, retired.reason});
    } else {
      publish(LandmarkChanged{*tracker_.graph().find(id), kind == LandmarkTracker::ChangeKind::found});
    }
  }
}

void MissionLoop::drive_on() {
  if (drive_ == nullptr) return;
  commanded_ = collision_monitor_.limit(wanted_);
  speed_reduction_ratio_ = collision_monitor_.speed_reduction_ratio(wanted_, commanded_);
  result_.collision_monitor = collision_monitor_.figures();
  in_stage(drive_stage_, [&] { drive_->command(commanded_); });
}

// A command holds until the next one: the robot stands while the host is at something that may take long, and is
// ordered on at the end of the tick.
void MissionLoop::stop_while_blocking() {
  if (drive_ != nullptr) in_stage(drive_stage_, [&] { drive_->command(Twist{}); });
}

void MissionLoop::connect_landmarks() {
  if (!modules_.planner || grid_ == nullptr || tracker_.graph().landmarks().empty()) return;
  stop_while_blocking();
  const WorldView world = view();
  const auto plan = [&](const PlanRequest& request) {
    return in_stage(routes_, [&] { return modules_.planner->plan(request, world, budget_); });
  };
  tracker_.connect(world, plan, module_seed(mission_.config.seed, PluginKind::planner, 1));
}

MissionOutcome MissionLoop::at_end_of_data(const std::string& reason) {
  if (mission_.steps.empty()) return ended(MissionOutcome::done, reason);
  return ended(MissionOutcome::step_failed, "the sensor's data ended before the steps did");
}

MissionOutcome MissionLoop::ended(MissionOutcome outcome, std::string reason) {
  result_.reason = std::move(reason);
  return outcome;
}

void MissionLoop::stop() {
  try {
    drive_->command(Twist{});
  } catch (...) {
    // The module has failed already and is being left; there is no one else to tell.
  }
}

WorldView MissionLoop::view() const {
  WorldView world{*grid_,
                  tracker_.graph(),
                  mission_.robot,
                  pose_,
                  result_.time_s,
                  begun_ ? &observation_ : nullptr,
                  speed_reduction_ratio_};
  world.T_map_start = T_map_first_start_;
  return world;
}

void MissionLoop::publish(const Event& event) {
  if (grid_ == nullptr) return;  // there is nothing to show yet
  const WorldView world = view();
  const MissionView seen{world, coarse_, commanded_};
  std::erase_if(listeners_, [&](Listener* listener) {
    // What a listener throws must not change the mission: it is told nothing more.
    try {
      listener->on(event, seen);
      return false;
    } catch (const std::exception& error) {
      listener_faults_.emplace_back(error.what());
    } catch (...) {
      listener_faults_.emplace_back("something that is no std::exception");
    }
    return true;
  });
}

// What behaviours order is the host's work again: it cannot be given up half-way.

void MissionLoop::drive(const Twist& wanted) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  if (drive_ == nullptr)
    throw std::runtime_error("wants to drive, but the sensor " + mission_.config.sensor.name + " cannot be driven");
  if (!std::isfinite(wanted.v_mps) || !std::isfinite(wanted.w_radps))
    throw std::runtime_error("asked for a velocity that is not finite");
  ordered_ = wanted;
}

PlanResult MissionLoop::plan(const PlanRequest& request) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  if (!modules_.planner) {
    PlanResult none;
    none.reason = "the mission names no planner";
    return none;
  }
  stop_while_blocking();
  WorldView world = view();
  hierarchies_.update();
  world.hierarchies = &hierarchies_;
  PlanResult result = in_stage(planner_, [&] { return modules_.planner->plan(request, world, budget_); });
  publish(PlanDone{result});
  return result;
}

void MissionLoop::say(const std::string& sentence) {
  const StageClock::Visit visit(clock_, StageClock::kHost);
  publish(Message{sentence});
}

}  // namespace cairn
