#include "framework/host/mission_runner.hpp"

#include <cmath>
#include <thread>

#include "framework/host/fence.hpp"
#include "framework/host/landmark_keeper.hpp"
#include "framework/host/mission_modules.hpp"
#include "framework/host/stop_layer.hpp"

namespace cairn {
namespace {

bool is_finite(const PoseEstimate& pose) {
  return std::isfinite(pose.T_map_robot.x_m) && std::isfinite(pose.T_map_robot.y_m) &&
         std::isfinite(pose.T_map_robot.theta_rad) && pose.covariance.allFinite();
}

}  // namespace

std::string_view name_of(MissionOutcome outcome) {
  switch (outcome) {
    case MissionOutcome::done:
      return "done";
    case MissionOutcome::step_failed:
      return "step_failed";
    case MissionOutcome::out_of_time:
      return "out_of_time";
    case MissionOutcome::cancelled:
      return "cancelled";
    case MissionOutcome::sensor_fault:
      return "sensor_fault";
    case MissionOutcome::module_fault:
      return "module_fault";
  }
  return "?";
}

class MissionRunner::Impl : private Orders {
 public:
  Impl(const Mission& mission, const ModuleLibrary& library, RunOptions options)
      : mission_(mission),
        options_(std::move(options)),
        modules_(build_modules(mission_, library)),
        keeper_(mission_.config.landmarks, mission_.robot),
        stop_layer_(mission_.config.stop_layer, mission_.robot) {
    budget_.cancel = options_.cancel;
    pose_.T_map_robot = modules_.T_map_start;
  }

  MissionResult run() {
    try {
      result_.outcome = loop();
    } catch (const ModuleFault& fault) {
      result_.outcome = MissionOutcome::module_fault;
      result_.reason = fault.what();
    }
    finish();
    return result_;
  }

  const Mission& mission() const { return mission_; }
  const MissionModules& modules() const { return modules_; }
  const LandmarkKeeper& keeper() const { return keeper_; }
  void subscribe(Listener& listener) { listeners_.push_back(&listener); }

 private:
  MissionOutcome loop() {
    if (mission_.steps.empty() && modules_.sensor->drive() != nullptr) return MissionOutcome::done;
    while (true) {
      if (budget_.cancelled()) return ended(MissionOutcome::cancelled, "cancelled by the user");
      SensorStep step = fenced("sensor", mission_.config.sensor.name, [&] { return modules_.sensor->next(budget_); });
      if (step.state == SensorState::fault) return ended(MissionOutcome::sensor_fault, step.reason);
      if (step.state == SensorState::end_of_data) return at_end_of_data(step.reason);
      observation_ = std::move(step.observation);
      tick();
      if (failed_step_) return ended(MissionOutcome::step_failed, failure_);
      if (!mission_.steps.empty() && step_ == mission_.steps.size()) return MissionOutcome::done;
      if (result_.time_s >= mission_.config.at_most_s)
        return ended(MissionOutcome::out_of_time, "the mission's at_most_s has passed");
    }
  }

  // One tick: a list of sentences, each stage a value in and a value out.
  void tick() {
    account_for(observation_);
    pose_ = localize();
    keeper_.follow(pose_.T_map_robot);
    const CellChanges& changes = fenced("map", mission_.config.map.name, [&]() -> const CellChanges& {
      return modules_.mapper->integrate(observation_, pose_);
    });
    detect(changes);
    stop_layer_.see(observation_);
    behave();
    drive_on();
    tell(TickDone{});
  }

  void account_for(const Observation& observation) {
    if (!begun_) begin_s_ = observation.stamp_s;
    if (begun_) result_.distance_m += (observation.T_odom_robot.position() - T_odom_last_.position()).norm();
    begun_ = true;
    T_odom_last_ = observation.T_odom_robot;
    result_.time_s = observation.stamp_s - begin_s_;
    result_.readings += static_cast<std::int64_t>(observation.ranges.size());
    if (observation.bumped && !bumped_) {
      ++result_.collisions;
      tell(Bumped{});
    }
    bumped_ = observation.bumped;
    if (options_.realtime) std::this_thread::sleep_until(wall_begin_ + std::chrono::duration<double>(result_.time_s));
  }

  PoseEstimate localize() {
    const std::string& name = mission_.config.localizer.name;
    const PoseEstimate pose = fenced("localizer", name, [&] { return modules_.localizer->update(observation_, {}); });
    if (!is_finite(pose)) throw ModuleFault("localizer", name, "returned a pose that is not finite");
    return pose;
  }

  void detect(const CellChanges& changes) {
    if (!modules_.detector) return;
    const DetectionReport report = fenced("detector", mission_.config.detector.name, [&] {
      return modules_.detector->detect(modules_.mapper->grid(), changes, budget_);
    });
    for (const Matching& matching : report.matchings) {
      ++result_.matchings;
      tell(MatchingDone{matching});
      if (!matching.detection) continue;
      const LandmarkKeeper::Change change = keeper_.fold(*matching.detection);
      if (change.improved) tell(LandmarkChanged{*keeper_.graph().find(change.landmark), change.is_new});
    }
  }

  void behave() {
    wanted_ = Twist{};
    if (step_ >= modules_.behaviours.size()) return;
    const std::string& name = mission_.steps[step_].name;
    if (!step_begun_) begin_step(name);
    const Status status = fenced("behaviour", name, [&] { return modules_.behaviours[step_]->tick(view(), *this); });
    if (status.progress != Progress::running) end_step(name, status);
  }

  void begin_step(const std::string& name) {
    step_begun_ = true;
    result_.steps.push_back({name, {}, result_.time_s, result_.time_s});
    tell(StepStarted{static_cast<int>(step_), name});
  }

  void end_step(const std::string& name, const Status& status) {
    result_.steps.back().status = status;
    result_.steps.back().end_s = result_.time_s;
    tell(StepEnded{static_cast<int>(step_), name, status});
    wanted_ = Twist{};
    step_begun_ = false;
    ++step_;
    failed_step_ = status.progress == Progress::failure;
    failure_ = "step " + std::to_string(step_) + " (" + name + "): " + status.reason;
    connect_landmarks();
  }

  void drive_on() {
    Drive* const drive = modules_.sensor->drive();
    if (drive == nullptr) return;
    const Twist allowed = stop_layer_.limit(wanted_);
    held_back_ratio_ = stop_layer_.held_back_ratio(wanted_, allowed);
    fenced("drive", mission_.config.sensor.name, [&] { drive->command(allowed); });
  }

  void connect_landmarks() {
    if (!modules_.planner || keeper_.graph().landmarks().empty()) return;
    fenced("planner", mission_.config.planner.name, [&] {
      keeper_.connect(view(), *modules_.planner, budget_, module_seed(mission_.config.seed, PluginKind::planner, 1));
    });
  }

  MissionOutcome at_end_of_data(const std::string& reason) {
    if (mission_.steps.empty()) return ended(MissionOutcome::done, reason);
    return ended(MissionOutcome::step_failed, "the sensor's data ended before the steps did");
  }

  MissionOutcome ended(MissionOutcome outcome, std::string reason) {
    result_.reason = std::move(reason);
    return outcome;
  }

  // Whatever happened: the robot stops, and the map so far is saved.
  void finish() {
    if (Drive* const drive = modules_.sensor->drive()) stop(*drive);
    if (step_begun_) halt_step();
    try {
      if (result_.outcome != MissionOutcome::cancelled) connect_landmarks();
    } catch (const ModuleFault& fault) {
      result_.reason += (result_.reason.empty() ? "" : "; ") + std::string(fault.what());
      result_.outcome = MissionOutcome::module_fault;
    }
    save(mission_.config.mission + ".cairn");
  }

  static void stop(Drive& drive) {
    try {
      drive.command(Twist{});
    } catch (...) {
      // The module has failed already and is being left; there is no one else to tell.
    }
  }

  void halt_step() {
    result_.steps.back().status = {Progress::failure, "halted: " + result_.reason};
    result_.steps.back().end_s = result_.time_s;
    try {
      fenced("behaviour", mission_.steps[step_].name, [&] { modules_.behaviours[step_]->halt(); });
    } catch (const ModuleFault& fault) {
      result_.reason += std::string("; ") + fault.what();
    }
  }

  [[nodiscard]] WorldView view() const {
    return {modules_.mapper->grid(),          keeper_.graph(), mission_.robot, pose_, result_.time_s,
            begun_ ? &observation_ : nullptr, held_back_ratio_};
  }

  void tell(const Event& event) const {
    const WorldView world = view();
    const MissionView seen{world, modules_.detector ? modules_.detector->coarse_grid() : nullptr};
    for (Listener* listener : listeners_) listener->on(event, seen);
  }

  // Orders of behaviours.
  void drive(const Twist& wanted) override {
    if (modules_.sensor->drive() == nullptr)
      throw std::runtime_error("wants to drive, but the sensor " + mission_.config.sensor.name + " cannot be driven");
    if (!std::isfinite(wanted.v_mps) || !std::isfinite(wanted.w_radps))
      throw std::runtime_error("asked for a velocity that is not finite");
    wanted_ = wanted;
  }

  PlanResult plan(const PlanRequest& request) override {
    if (!modules_.planner) throw std::runtime_error("asked for a plan, but the mission names no planner");
    PlanResult result = fenced("planner", mission_.config.planner.name,
                               [&] { return modules_.planner->plan(request, view(), budget_); });
    tell(PlanDone{result});
    return result;
  }

  void save(const std::string& file_name) override {
    SavedMap map;
    map.grid = modules_.mapper->grid();
    map.graph = keeper_.graph();
    map.shapes = mission_.shapes;
    map.driven_path = keeper_.driven_path();
    map.properties = {{"mission", mission_.config.mission},
                      {"seed", std::to_string(mission_.config.seed)},
                      {"robot", mission_.robot.name},
                      {"robot_radius_m", std::to_string(mission_.robot.radius_m)}};
    try {
      save_map(options_.out / file_name, map);
    } catch (const StoreError& error) {
      result_.reason +=
          (result_.reason.empty() ? "" : "; ") + std::string("the map could not be saved: ") + error.what();
      return;
    }
    result_.map_file = file_name;
    tell(MapSaved{file_name});
  }

  void say(const std::string& sentence) override { tell(Said{sentence}); }

  const Mission mission_;
  const RunOptions options_;
  MissionModules modules_;
  LandmarkKeeper keeper_;
  StopLayer stop_layer_;
  std::vector<Listener*> listeners_;
  MissionResult result_;
  Budget budget_;
  Observation observation_;
  PoseEstimate pose_;
  Pose2 T_odom_last_;
  Twist wanted_;
  double begin_s_ = 0.0;
  double held_back_ratio_ = 0.0;
  std::size_t step_ = 0;
  bool begun_ = false;
  bool bumped_ = false;
  bool step_begun_ = false;
  bool failed_step_ = false;
  std::string failure_;
  const std::chrono::steady_clock::time_point wall_begin_ = std::chrono::steady_clock::now();
};

MissionRunner::MissionRunner(const Mission& mission, const ModuleLibrary& library, RunOptions options)
    : impl_(std::make_unique<Impl>(mission, library, std::move(options))) {}
MissionRunner::~MissionRunner() = default;
void MissionRunner::subscribe(Listener& listener) {
  impl_->subscribe(listener);
}
MissionResult MissionRunner::run() {
  return impl_->run();
}
const OccupancyGrid& MissionRunner::grid() const {
  return impl_->modules().mapper->grid();
}
const CoarseGrid* MissionRunner::coarse_grid() const {
  return impl_->modules().detector ? impl_->modules().detector->coarse_grid() : nullptr;
}
const LandmarkGraph& MissionRunner::graph() const {
  return impl_->keeper().graph();
}
const std::vector<Pose2>& MissionRunner::driven_path() const {
  return impl_->keeper().driven_path();
}
const TemplateSet* MissionRunner::templates() const {
  return impl_->modules().templates.get();
}

}  // namespace cairn
