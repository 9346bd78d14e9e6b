#include "framework/mission/loop/mission_loop.hpp"

#include <fmt/format.h>

#include "framework/mission/hearing/expected_echoes.hpp"

namespace cairn {
namespace {

Budget budget_of(const RunOptions& options) {
  Budget budget;
  budget.cancel = options.cancel;
  return budget;
}

const SavedMap* map_of(const RunOptions& options) {
  return options.localise_in ? options.localise_in->map : options.resume;
}

std::optional<LocalizerStart> start_of(const RunOptions& options, const RobotModel& robot) {
  const auto in_map = [&](const Pose2& T_map_start) {
    return LocalizerStart{T_map_start, kFoundUncertainty, usable_submaps(map_of(options))};
  };
  if (options.T_map_resumed) return in_map(*options.T_map_resumed);
  if (!options.localise_in) return std::nullopt;
  if (options.localise_in->T_map_start) return in_map(*options.localise_in->T_map_start);
  // A frame of its own, turned as the compass says.
  return LocalizerStart{{}, own_frame(robot)};
}

KeptSubmaps submaps_to_begin_with(const RunOptions& options) {
  const KeptSubmaps* const submaps = usable_submaps(map_of(options));
  return submaps == nullptr ? KeptSubmaps{} : *submaps;
}

}  // namespace

MissionLoop::MissionLoop(const Mission& mission, const ModuleLibrary& library, const RunOptions& options)
    : mission_(mission),
      options_(options),
      library_(library),
      grid_so_far_(options.resume != nullptr ? std::optional(options.resume->grid) : std::nullopt),
      submaps_so_far_(submaps_to_begin_with(options)),
      submaps_fault_(map_of(options) == nullptr ? std::string() : fault_of(map_of(options)->submaps)),
      budget_(budget_of(options)),
      map_left_alone_(options.localise_in ? std::make_shared<const OccupancyGrid>(options.localise_in->map->grid)
                                          : nullptr),
      modules_(build_modules(mission_, library, options.resume, {options.cancel, options.on_wait},
                             start_of(options, mission_.robot)),
               mission_, options.wall_clock),
      perception_(mission_, modules_, budget_),
      world_{mission_.robot, perception_.tracker().graph(), modules_.T_map_start},
      publisher_(world_, &modules_.clock, modules_.host.listeners),
      observation_check_(mission_.robot, options.wall_clock),
      pace_(options.wall_clock),
      pauses_(options.control, options.wall_clock),
      monitor_(mission_.config.collision_monitor, mission_.robot, options.wall_clock),
      planning_(mission_, modules_, world_.graph, clusters_to_begin_with(mission_.config.clusters, map_of(options)),
                monitor_, budget_),
      saving_(
          mission_,
          {options.out, options.autosave && !options.localise_in, options.resume != nullptr, options.wall_clock,
           options.localise_in.has_value()},
          planning_, world_, publisher_, [this](ClusterTree clusters) { return map_so_far(std::move(clusters)); },
          [this] { return submaps_to_save(); }),
      orders_(options.control == nullptr ? nullptr : &options.control->orders(), options.orders, options.out),
      display_(modules_.display),
      steps_({mission_, modules_.clock, world_, publisher_, monitor_, planning_, saving_, modules_.controller,
              perception_.tracker(), orders_},
             modules_.behaviours, TextFiles(options.out, options.resume != nullptr)),
      fatal_ends_(monitor_, modules_.clock) {
  check_orders(options.orders, mission_, library);
  if (display_) publisher_.subscribe(display_);
  world_.pose.T_map_robot = modules_.T_map_start;
  world_.hierarchies = &planning_.hierarchies();
  world_.speed_law = mission_.config.collision_monitor.speed_law();
  if (options.resume != nullptr) restore(*options.resume);
  begin_watch();
  if (options.localise_in) begin_localisation(*options.localise_in);
}

// A map that is left alone keeps the routes that it has.
void MissionLoop::connect_landmarks() {
  if (!options_.localise_in && !world_.is_lost()) planning_.connect(perception_.tracker(), world_.view());
}

void MissionLoop::run() {
  const FatalEnds::Thread here(fatal_ends_);
  try {
    wait_report_ = modules_.sensor.call([](Sensor& sensor) { return dynamic_cast<const WaitReport*>(&sensor); });
    Drive* drive = modules_.sensor.call([](Sensor& sensor) { return sensor.drive(); });
    monitor_.attach({modules_.sensor.part(drive), modules_.clock, modules_.drive});
    if (drive != nullptr) observation_check_.expect_live();
    world_.grid = &perception_.begin(drive == nullptr);
    world_.coarse = perception_.show_earlier_map();
    ending_ = loop();
  } catch (const GivenUp&) {
    return;  // the thread that gave up reports
  } catch (const std::exception& fault) {
    ending_ = {MissionOutcome::module_fault, fault.what()};
  }
  try {
    finish();
    if (ending_.outcome == MissionOutcome::done && fatal_ends_.exit_was_called_elsewhere())
      ending_ = {MissionOutcome::module_fault, kExitElsewhere};
  } catch (const GivenUp&) {
  }
}

MissionLoop::Ending MissionLoop::loop() {
  if (!submaps_fault_.empty())
    publisher_.publish(Message{"the submaps of the saved map are not used: " + submaps_fault_});
  if (!steps_.not_restored().empty()) publisher_.publish(Message{steps_.not_restored()});
  if (options_.control != nullptr) options_.control->publish(status());
  if (steps_.are_done() && monitor_.has_drive()) return {};
  while (true) {
    wait_while_paused();
    if (budget_.cancelled()) return {MissionOutcome::cancelled, "cancelled by the user"};
    if (fatal_ends_.exit_was_called_elsewhere()) return {MissionOutcome::module_fault, kExitElsewhere};
    Sensed sensed = sense();
    if (sensed.step.state == SensorState::fault && budget_.cancelled()) continue;
    if (sensed.step.state == SensorState::fault) return {MissionOutcome::sensor_fault, sensed.step.reason};
    if (sensed.step.state == SensorState::end_of_data) return at_end_of_data(sensed.step.reason);
    if (is_known_already(sensed.step.observation)) continue;
    {
      StageClock::Work whole(modules_.clock, modules_.tick);
      tick(std::move(sensed));
      if (pace_.is_kept()) whole.leave_out();
    }
    if (const auto ending = ending_after_tick()) return *ending;
  }
}

MissionLoop::Sensed MissionLoop::sense() {
  Sensed sensed = modules_.sensor.call([&](Sensor& sensor) -> Sensed {
    SensorStep step = sensor.next(budget_);
    const GroundTruthSource* truth = sensor.truth();
    return {std::move(step), truth == nullptr ? std::nullopt : truth->last_truth()};
  });
  if (sensed.step.state != SensorState::observation) return sensed;
  if (const std::string fault = observation_check_.fault_of(sensed.step.observation); !fault.empty())
    throw modules_.sensor.fault(fault);
  if (sensed.truth)
    if (const std::string fault = fault_of(*sensed.truth); !fault.empty()) throw modules_.sensor.fault(fault);
  return sensed;
}

// One tick: each sentence takes values and hands a value on. The world shows them to those who look on.
void MissionLoop::tick(Sensed sensed) {
  const HostStages& stages = modules_.host;
  in(stages.observation, [&] { take(std::move(sensed)); });
  const Observation& observation = world_.observation;
  in(stages.perception, [&] { perception_.see_markers(world_.observation); });

  world_.pose = in(stages.perception, [&] {
    begin_check_in_doubt();
    return perception_.localize(observation);
  });
  in(stages.perception, [&] { look_where_robot_is(); });
  in(stages.perception, [&] { move_map(); });
  const std::vector<ExpectedEcho> expected = in(stages.echo_prediction, [&] { return expected_of(observation); });
  const CellChanges& cells = in(stages.perception, [&]() -> const CellChanges& {
    return perception_.map(observation, world_.pose, monitor_.hearing().deaf());
  });
  const Recognition recognised =
      in(stages.landmark_tracker, [&] { return perception_.recognise(cells, world_.time_s, observation.markers); });
  world_.coarse = recognised.coarse;
  counts_.count_matchings(recognised.matchings);
  for (const Event& event : recognised.events) publisher_.publish(event);

  const StepsTick steps = in(stages.behaviour_tree, [&] { return tick_steps(); });
  if (steps.has_ended_step) in(stages.route_joining, [&] { connect_landmarks(); });
  world_.driven = in(stages.collision_monitor, [&] { return monitor_.drive(observation, steps.wanted, expected); });
  publish_driven(cells);
  show();
  in(stages.run_control, [&] {
    if (options_.control != nullptr) options_.control->tick([this] { return status(); });
  });
  if (may_autosave()) in(stages.autosave, [&] { saving_.autosave(); });
}

void MissionLoop::take(Sensed sensed) {
  world_.time_s = clock_.advance(sensed.step.observation.stamp_s, pauses_.is_paused());
  world_.observe(std::move(sensed.step.observation), sensed.truth);
  keep_pace();
  if (counts_.count(world_.observation)) publisher_.publish(Bumped{});
  for (const Event& event : holds_.update(world_.observation, world_.time_s)) publisher_.publish(event);
}

StepsTick MissionLoop::tick_steps() {
  if (monitor_.has_drive()) publish_any(pauses_.apply(clock_.paused_s()));
  publish_all(display_.hand_orders_to(orders_));
  if (pauses_.is_paused()) {
    publish_all(orders_.refuse_all("the mission is paused"));
    return {};
  }
  orders_.begin_tick(world_.time_s);
  const StepsTick ticked = steps_.tick(world_.time_s);
  publish_all(orders_.end_tick());
  return ticked;
}

void MissionLoop::publish_driven(const CellChanges& cells) {
  if (monitor_.has_drive())
    for (const Event& event : hearing_.update(monitor_.hearing(), world_.time_s)) publisher_.publish(event);
  if (const auto for_s = monitor_.stalled_s()) {
    publisher_.publish(stalled_for(*for_s));
    stalled_stage_ = StageClock::kHost;
  }
  publisher_.publish(TickDone{&cells});
}

void MissionLoop::show() {
  if (!display_) return;
  const auto describe = [this] {
    const RunStatus now = status();
    return now.step_name + (now.doing.empty() ? "" : ": " + now.doing);
  };
  publish_all(display_.show(world_.view(), world_.driven.commanded, describe));
}

// All that look on see the old map or the new one, never a part.
void MissionLoop::move_map() {
  if (perception_.is_map_moved())
    perception_.begin_redraw(build_map(mission_, library_, grid_so_far_ ? &*grid_so_far_ : nullptr));
  const OccupancyGrid* const grid = perception_.redraw_slice(world_.pose);
  if (grid == nullptr) return;
  world_.exchange_map(*grid, &*perception_.last_move());
  steps_.move_places(*perception_.last_move());
}

// The robot stands, and nothing comes any more.
void MissionLoop::redraw_map() {
  const OccupancyGrid& grid =
      perception_.redraw(build_map(mission_, library_, grid_so_far_ ? &*grid_so_far_ : nullptr));
  if (&grid != world_.grid) world_.exchange_map(grid, &*perception_.last_move());  // else it was cancelled
  for (const Event& event : perception_.take_moved_landmarks()) publisher_.publish(event);
}

// By the map as it was before this observation.
std::vector<ExpectedEcho> MissionLoop::expected_of(const Observation& observation) const {
  if (!monitor_.has_drive()) return {};
  return expected_echoes(observation, *world_.grid, world_.pose, mission_.config.collision_monitor.deaf);
}

// As fast as the wall clock when the user wants it so, and while nothing but time passes.
void MissionLoop::keep_pace() {
  const double factor = pauses_.is_paused() ? 1.0 : options_.pace;
  if (factor > 0.0)
    pace_.keep(world_.observation.stamp_s, budget_, factor);
  else
    pace_.release();
}

void MissionLoop::wait_while_paused() {
  if (monitor_.has_drive() || !pauses_.is_wanted()) return;
  pauses_.hold();
  publisher_.publish(Paused{});
  pauses_.wait(budget_, [this] { options_.control->tick([this] { return status(); }); });
  publisher_.publish(Resumed{});
}

// A log begins at its beginning again. The last observation that the map holds shows the localizer where the odometry
// was then.
bool MissionLoop::is_known_already(const Observation& observation) {
  if (monitor_.has_drive() || !clock_.resumed_s() || clock_.has_begun()) return false;
  const double time_s = clock_.replay(observation.stamp_s);
  if (time_s > *clock_.resumed_s()) return false;
  if (time_s == *clock_.resumed_s()) world_.pose = perception_.localize(observation);
  return true;
}

Stalled MissionLoop::stalled_for(double for_s) const {
  if (monitor_.was_watch_held_up()) return {"", "", for_s};
  const StageClock::Id stage = stalled_stage_;
  return {modules_.clock.stage_of(stage), modules_.clock.module_of(stage), for_s};
}

void MissionLoop::publish_any(const std::optional<Event>& event) {
  if (event) publisher_.publish(*event);
}

void MissionLoop::publish_all(const std::vector<std::string>& sentences) {
  for (const std::string& sentence : sentences) publisher_.publish(Message{sentence});
}

}  // namespace cairn
