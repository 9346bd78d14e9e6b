// Modules that break their contracts, each in one way, run through the suites: every one must fail the test
// that is for it. A program of its own, because its tests fail on purpose; faulty_modules_test.cpp judges it.
#include "tests/conformance/behaviour.hpp"
#include "tests/conformance/controller.hpp"
#include "tests/conformance/detector.hpp"
#include "tests/conformance/localizer.hpp"
#include "tests/conformance/map.hpp"
#include "tests/conformance/path_planner.hpp"
#include "tests/conformance/planner.hpp"
#include "tests/conformance/route_planner.hpp"
#include "tests/conformance/sensor.hpp"

namespace cairn::conformance {
namespace {

const std::filesystem::path kModules = std::filesystem::path(CAIRN_BINARY_DIR) / "lib" / "cairn";

// A subject whose objects wrap those of a shipped module.
template <class Interface, class Wrapper>
Subject<Interface> wrapped(const std::string& name, const Subject<Interface>& inner) {
  return {name, [inner](const ContextOf<Interface>& context) -> std::shared_ptr<Interface> {
            return std::make_shared<Wrapper>(inner.make(context.seed));
          }};
}

class WrappedMapper : public Mapper {
 public:
  explicit WrappedMapper(std::shared_ptr<Mapper> inner) : inner_(std::move(inner)) {}
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    changes_ = inner_->integrate(observation, pose);
    return changes_;
  }
  [[nodiscard]] const OccupancyGrid& grid() const override { return inner_->grid(); }

 protected:
  std::shared_ptr<Mapper> inner_;
  CellChanges changes_;
};

class SilentMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    (void)WrappedMapper::integrate(observation, pose);
    if (!changes_.spans.empty()) changes_.spans.pop_back();
    return changes_;
  }
};

class UnsortedMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    (void)WrappedMapper::integrate(observation, pose);
    std::reverse(changes_.spans.begin(), changes_.spans.end());
    return changes_;
  }
};

class AllocatingMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    const std::vector<RangeReading> copy = observation.ranges;
    return copy.empty() ? changes_ : WrappedMapper::integrate(observation, pose);
  }
};

// Takes every reading for an echo, and a bad one for an error.
class TrustingMapper : public WrappedMapper {
 public:
  using WrappedMapper::WrappedMapper;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    Observation seen = observation;
    for (RangeReading& reading : seen.ranges) {
      if (std::isnan(reading.range_m)) throw std::runtime_error("range is NaN");
      reading.range_m = std::min(reading.range_m, 0.5 * reading.max_m);
    }
    return WrappedMapper::integrate(seen, pose);
  }
};

Subject<Mapper> shipped_map() {
  return module<Mapper>(kModules, "bayes");
}
INSTANTIATE_TEST_SUITE_P(Faulty, MapperConformance,
                         testing::Values(wrapped<Mapper, SilentMapper>("forgets a span", shipped_map()),
                                         wrapped<Mapper, UnsortedMapper>("unsorted spans", shipped_map()),
                                         wrapped<Mapper, AllocatingMapper>("copies its input", shipped_map()),
                                         wrapped<Mapper, TrustingMapper>("trusts every range", shipped_map())));

class SureLocalizer : public Localizer {
 public:
  explicit SureLocalizer(const Pose2& T_map_start) : T_map_start_(T_map_start) {}
  PoseEstimate update(const Observation& observation, const KnownMap&) override {
    return {T_map_start_ * observation.T_odom_robot, 1e-4 * Eigen::Matrix3d::Identity()};
  }

 private:
  Pose2 T_map_start_;
};

class LopsidedLocalizer : public SureLocalizer {
 public:
  using SureLocalizer::SureLocalizer;
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    PoseEstimate estimate = SureLocalizer::update(observation, known);
    estimate.covariance(0, 1) = 1e-2;
    return estimate;
  }
};

// What one object is given, all know.
class SharedLocalizer : public Localizer {
 public:
  explicit SharedLocalizer(const Pose2&) {}
  PoseEstimate update(const Observation& observation, const KnownMap&) override {
    static double travelled_m = 0.0;
    travelled_m += 0.1;
    return {{observation.T_odom_robot.x_m + travelled_m, 0.0, 0.0}, travelled_m * Eigen::Matrix3d::Identity()};
  }
};

template <class Type>
Subject<Localizer> localizer(const std::string& name) {
  return {name, [](const LocalizerContext& context) { return std::make_shared<Type>(context.T_map_start); }};
}
INSTANTIATE_TEST_SUITE_P(Faulty, LocalizerConformance,
                         testing::Values(localizer<SureLocalizer>("never in doubt"),
                                         localizer<LopsidedLocalizer>("lopsided covariance"),
                                         localizer<SharedLocalizer>("keeps its state in a static")));

// Small errors of a source around the simulated robot.
class WrappedSensor : public Sensor {
 public:
  explicit WrappedSensor(std::shared_ptr<Sensor> inner) : inner_(std::move(inner)) {}
  SensorStep next(const Budget& budget) override { return inner_->next(budget); }
  Drive* drive() override { return inner_->drive(); }

 protected:
  std::shared_ptr<Sensor> inner_;
};

class BackwardSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    SensorStep step = inner_->next(budget);
    if (++count_ % 7 == 0) step.observation.stamp_s -= 1.0;
    return step;
  }

 private:
  int count_ = 0;
};

class RestartingSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    if (++count_ % 20 == 0) return {};
    return inner_->next(budget);
  }

 private:
  int count_ = 0;
};

class UnboundedRangeSensor : public WrappedSensor {
 public:
  using WrappedSensor::WrappedSensor;
  SensorStep next(const Budget& budget) override {
    SensorStep step = inner_->next(budget);
    for (RangeReading& reading : step.observation.ranges)
      if (reading.range_m == kInfinity) reading.range_m = 1e4;
    return step;
  }
};

class RunawaySensor : public WrappedSensor, public Drive {
 public:
  using WrappedSensor::WrappedSensor;
  Drive* drive() override { return this; }
  void command(const Twist& twist, double valid_for_s) override {
    if (twist != Twist{}) inner_->drive()->command(twist, valid_for_s);
  }
  void stop() noexcept override {}
};

Subject<Sensor> shipped_robot() {
  return module<Sensor>(kModules, "simulated_robot");
}
INSTANTIATE_TEST_SUITE_P(Faulty, SensorConformance,
                         testing::Values(wrapped<Sensor, BackwardSensor>("time goes back", shipped_robot()),
                                         wrapped<Sensor, RestartingSensor>("ends and goes on", shipped_robot()),
                                         wrapped<Sensor, UnboundedRangeSensor>("no echo as 10 km", shipped_robot()),
                                         wrapped<Sensor, RunawaySensor>("does not stop", shipped_robot())));

class WrappedDetector : public Detector {
 public:
  explicit WrappedDetector(std::shared_ptr<Detector> inner) : inner_(std::move(inner)) {}
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    return inner_->detect(grid, changes, budget);
  }

 protected:
  std::shared_ptr<Detector> inner_;
};

class PercentDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    DetectionReport report = inner_->detect(grid, changes, budget);
    for (Matching& matching : report.matchings)
      for (CategoryDegree& degree : matching.degrees) degree.degree *= 100.0;
    return report;
  }
};

class RepeatingDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    DetectionReport report = inner_->detect(grid, changes, budget);
    if (report.matchings.empty()) return last_;
    last_ = report;
    return report;
  }

 private:
  DetectionReport last_;
};

class ThoroughDetector : public WrappedDetector {
 public:
  using WrappedDetector::WrappedDetector;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget&) override {
    return inner_->detect(grid, changes, Budget{});
  }
};

Subject<Detector> shipped_detector() {
  return module<Detector>(kModules, "template_matcher");
}
INSTANTIATE_TEST_SUITE_P(Faulty, DetectorConformance,
                         testing::Values(wrapped<Detector, PercentDetector>("degrees in percent", shipped_detector()),
                                         wrapped<Detector, RepeatingDetector>("repeats itself", shipped_detector()),
                                         wrapped<Detector, ThoroughDetector>("ignores its budget",
                                                                             shipped_detector())));

class WrappedPlanner : public Planner {
 public:
  explicit WrappedPlanner(std::shared_ptr<Planner> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    return inner_->plan(request, world, budget);
  }

 protected:
  std::shared_ptr<Planner> inner_;
};

class StubbornPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world, const Budget&) const override {
    return inner_->plan(request, world, Budget{});
  }
};

class ThinPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    PlanRequest thin = request;
    thin.radius_m = 0.0;
    return inner_->plan(thin, world, budget);
  }
};

// Straight through everything.
class BlindPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    PlanResult result = inner_->plan(request, world, budget);
    if (!request.from.pose || !request.to.pose || budget.exhausted()) return result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, *request.to.pose};
    result.length_m = length_of(result.path);
    return result;
  }
};

// Remembers an answer under its two ends, whatever has become of the map.
class ForgetfulPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    if (!request.from.pose || !request.to.pose) return inner_->plan(request, world, budget);
    const std::string key = text_of(*request.from.pose) + text_of(*request.to.pose);
    const std::lock_guard lock(mutex_);
    const auto known = answers_.find(key);
    if (known != answers_.end()) return known->second;
    return answers_[key] = inner_->plan(request, world, budget);
  }

 private:
  mutable std::mutex mutex_;
  mutable std::map<std::string, PlanResult> answers_;
};

Subject<Planner> shipped_planner() {
  return module<Planner>(kModules, "ompl", "{iterations: 300}");
}
INSTANTIATE_TEST_SUITE_P(Faulty, PlannerConformance,
                         testing::Values(wrapped<Planner, StubbornPlanner>("ignores cancel", shipped_planner()),
                                         wrapped<Planner, ThinPlanner>("forgets the radius", shipped_planner()),
                                         wrapped<Planner, BlindPlanner>("sees no walls", shipped_planner()),
                                         wrapped<Planner, ForgetfulPlanner>("keeps old answers", shipped_planner())));

class WrappedPathPlanner : public PathPlanner {
 public:
  explicit WrappedPathPlanner(std::shared_ptr<PathPlanner> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] PlannerTraits traits() const override { return inner_->traits(); }
  [[nodiscard]] PathResult plan(const PathRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    return inner_->plan(request, world, budget);
  }

 protected:
  std::shared_ptr<PathPlanner> inner_;
};

// Says that it keeps a margin, and that it stays on known ground.
class PretendingPathPlanner : public WrappedPathPlanner {
 public:
  using WrappedPathPlanner::WrappedPathPlanner;
  [[nodiscard]] PlannerTraits traits() const override { return {.margin_m = 0.1}; }
};

class MoodyPathPlanner : public WrappedPathPlanner {
 public:
  using WrappedPathPlanner::WrappedPathPlanner;
  [[nodiscard]] PlannerTraits traits() const override { return {.margin_m = 0.001 * ++asked_}; }

 private:
  mutable int asked_ = 0;
};

INSTANTIATE_TEST_SUITE_P(
    Faulty, PathPlannerConformance,
    testing::Values(
        wrapped<PathPlanner, PretendingPathPlanner>("promises what it does not keep",
                                                    module<PathPlanner>(kModules, "ompl", "{unknown: allow}")),
        wrapped<PathPlanner, MoodyPathPlanner>("changes its traits", module<PathPlanner>(kModules, "ompl"))));

class WrappedRoutePlanner : public RoutePlanner {
 public:
  explicit WrappedRoutePlanner(std::shared_ptr<RoutePlanner> inner) : inner_(std::move(inner)) {}

 protected:
  std::shared_ptr<RoutePlanner> inner_;
};

// Forgets everything of a request but its landmarks.
class ForgetfulRoutePlanner : public WrappedRoutePlanner {
 public:
  using WrappedRoutePlanner::WrappedRoutePlanner;
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override {
    RouteRequest ends;
    for (const RouteEnd& end : request.from) ends.from.push_back({end.landmark, 0.0});
    for (const RouteEnd& end : request.to) ends.to.push_back({end.landmark, 0.0});
    return inner_->plan(ends, world, budget);
  }
};

// Leaves the last route out.
class ShortRoutePlanner : public WrappedRoutePlanner {
 public:
  using WrappedRoutePlanner::WrappedRoutePlanner;
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override {
    RouteResult result = inner_->plan(request, world, budget);
    if (!result.routes.empty()) result.routes.pop_back();
    return result;
  }
};

Subject<RoutePlanner> shipped_route_planner() {
  return module<RoutePlanner>(kModules, "landmark_search");
}
INSTANTIATE_TEST_SUITE_P(
    Faulty, RoutePlannerConformance,
    testing::Values(wrapped<RoutePlanner, ForgetfulRoutePlanner>("forgets what is closed", shipped_route_planner()),
                    wrapped<RoutePlanner, ShortRoutePlanner>("leaves a route out", shipped_route_planner())));

class WrappedBehaviour : public Behaviour {
 public:
  explicit WrappedBehaviour(std::shared_ptr<Behaviour> inner) : inner_(std::move(inner)) {}
  Status tick(const WorldView& world, BehaviourContext& orders) override { return inner_->tick(world, orders); }
  void halt() override { inner_->halt(); }

 protected:
  std::shared_ptr<Behaviour> inner_;
};

class LateBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  Status tick(const WorldView& world, BehaviourContext& orders) override {
    context_ = &orders;
    return inner_->tick(world, orders);
  }
  void halt() override {
    if (context_ != nullptr) context_->drive(Twist{});
    inner_->halt();
  }

 private:
  BehaviourContext* context_ = nullptr;
};

class ForgetfulBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  void halt() override {}
};

class NanBehaviour : public WrappedBehaviour {
 public:
  using WrappedBehaviour::WrappedBehaviour;
  Status tick(const WorldView& world, BehaviourContext& orders) override {
    orders.drive({0.0 * kInfinity, 0.0});
    return inner_->tick(world, orders);
  }
};

Subject<Behaviour> shipped_drive() {
  return module<Behaviour>(kModules, "drive", "{points_m: [[1.5, 1], [1.5, 4]]}");
}
INSTANTIATE_TEST_SUITE_P(Faulty, BehaviourConformance,
                         testing::Values(wrapped<Behaviour, LateBehaviour>("drives in halt", shipped_drive()),
                                         wrapped<Behaviour, ForgetfulBehaviour>("halts not", shipped_drive()),
                                         wrapped<Behaviour, NanBehaviour>("orders NaN", shipped_drive())));

class WrappedController : public Controller {
 public:
  explicit WrappedController(std::shared_ptr<Controller> inner) : inner_(std::move(inner)) {}
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    return inner_->control(request, world);
  }

 protected:
  std::shared_ptr<Controller> inner_;
};

class BlindController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    ControlRequest blind = request;
    blind.obstacles = {};
    return inner_->control(blind, world);
  }
};

// Follows the first path for ever.
class StubbornController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    if (path_.empty()) path_.assign(request.path.begin(), request.path.end());
    ControlRequest first = request;
    if (!request.path.empty()) first.path = path_;
    return inner_->control(first, world);
  }

 private:
  std::vector<Point> path_;
};

class HastyController : public WrappedController {
 public:
  using WrappedController::WrappedController;
  ControlResult control(const ControlRequest& request, const WorldView& world) override {
    ControlResult result = inner_->control(request, world);
    result.twist.v_mps *= 3.0;
    return result;
  }
};

std::vector<Subject<Controller>> faulty_controllers() {
  const auto shipped = module<Controller>(kModules, "pursuit_dwa");
  return {wrapped<Controller, BlindController>("sees no obstacles", shipped),
          wrapped<Controller, StubbornController>("keeps the first path", shipped),
          wrapped<Controller, HastyController>("too fast", shipped)};
}

INSTANTIATE_TEST_SUITE_P(Faulty, ControllerConformance, testing::ValuesIn(faulty_controllers()));

}  // namespace
}  // namespace cairn::conformance
