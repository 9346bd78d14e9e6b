// Modules that work, until they fail in one of many ways: for the table of stopping times (tests/bench/stop_table.py)
// and for tests with a base of its own. Each writes the time into a file at the moment when it fails.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "framework/contracts/module.hpp"

namespace {

using namespace cairn;
using std::chrono::steady_clock;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

enum class Fault {
  none,
  throws,
  hangs,
  stalls,
  crashes,
  aborts,
  exits,
  exits_at_once,
  absurd,
  floods,
  leaps,
  grows,
  killed,
  stopped
};

// What every one of the modules is made with.
struct Settings {
  Fault fault = Fault::none;
  double after_s = 5.0;
  std::filesystem::path note;
  ConfigValue of;
  double speed_mps = 0.3;
  std::string asks;  // of the behaviour: plan, control

  static void describe(Fields<Settings>& fields) {
    fields.choice("fault", &Settings::fault,
                  {{"none", Fault::none},
                   {"throw", Fault::throws},
                   {"hang", Fault::hangs},
                   {"stall", Fault::stalls},
                   {"crash", Fault::crashes},
                   {"abort", Fault::aborts},
                   {"exit", Fault::exits},
                   {"_exit", Fault::exits_at_once},
                   {"absurd", Fault::absurd},
                   {"flood", Fault::floods},
                   {"leap", Fault::leaps},
                   {"growth", Fault::grows},
                   {"kill", Fault::killed},
                   {"stop", Fault::stopped}},
                  "how it fails");
    fields.number("after_s", &Settings::after_s, {0.0, 1e6}, "s", "so long after its first call");
    fields.file("note", &Settings::note, "file that gets the time when it fails");
    fields.raw("of", &Settings::of, "module", "the module that works until then");
    fields.number("speed_mps", &Settings::speed_mps, {0.0, 10.0}, "m/s", "how fast the behaviour drives");
    fields.text("asks", &Settings::asks, "what the behaviour asks for in each tick, or after the time: plan, control");
  }
};

class Failure {
 public:
  explicit Failure(const Settings& settings) : settings_(settings) {}
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;

  // True, once: what is returned now is to be absurd, or too much.
  bool is_absurd() {
    const steady_clock::time_point now = steady_clock::now();
    if (!begin_) begin_ = now;
    if (has_failed_ || settings_.fault == Fault::none) return false;
    if (std::chrono::duration<double>(now - *begin_).count() < settings_.after_s) return false;
    has_failed_ = settings_.fault != Fault::grows && settings_.fault != Fault::throws;
    note(now);
    return fail();
  }

 private:
  void note(steady_clock::time_point now) {
    if (is_noted_ || settings_.note.empty()) return;
    is_noted_ = true;
    std::FILE* const file = std::fopen(settings_.note.c_str(), "w");
    if (file == nullptr) return;
    std::fprintf(file, "%.4f\n", std::chrono::duration<double>(now.time_since_epoch()).count());
    std::fclose(file);
  }
  bool fail() {
    switch (settings_.fault) {
      case Fault::throws:
        throw std::runtime_error("as the test wants it");
      case Fault::hangs:
        std::this_thread::sleep_for(std::chrono::hours(1));
        break;
      case Fault::stalls:
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        break;
      case Fault::crashes:
        *static_cast<volatile int*>(nullptr) = 1;  // NOLINT: a fault of a module
        break;
      case Fault::aborts:
        std::abort();
      case Fault::exits:
        std::exit(0);  // NOLINT: a fault of a module
      case Fault::exits_at_once:
        ::_exit(0);
      case Fault::grows:
        while (true) hoard_.push_back(std::make_unique<char[]>(std::size_t{1} << 26U));
      case Fault::killed:
        ::kill(::getpid(), SIGKILL);
        break;
      case Fault::stopped:
        ::kill(::getpid(), SIGSTOP);
        break;
      case Fault::leaps:
      case Fault::absurd:
      case Fault::floods:
        return true;
      case Fault::none:
        break;
    }
    return false;
  }

  Settings settings_;
  std::optional<steady_clock::time_point> begin_;
  bool has_failed_ = false;
  bool is_noted_ = false;
  std::vector<std::unique_ptr<char[]>> hoard_;
};

template <class Interface>
std::shared_ptr<Interface> inner(const Settings& settings, const ContextOf<Interface>& context) {
  return context.modules->template make<Interface>(config_detail::to_plugin(settings.of, "of"), context);
}

class FailingSensor : public Sensor, public Drive {
 public:
  FailingSensor(const Settings& settings, const SensorContext& context, bool is_drive)
      : leap_m_(settings.fault == Fault::leaps ? 9.0 : 1e12),
        failure_(settings),
        inner_(inner<Sensor>(settings, context)),
        is_drive_(is_drive) {}
  SensorStep next(const Budget& budget) override {
    SensorStep step = inner_->next(budget);
    if (!is_drive_ && failure_.is_absurd()) step.observation.T_odom_robot.x_m += leap_m_;
    return step;
  }
  Drive* drive() override { return this; }
  const GroundTruthSource* truth() const override { return inner_->truth(); }
  void command(const Twist& twist, double valid_for_s) override {
    if (is_drive_) (void)failure_.is_absurd();
    inner_->drive()->command(twist, valid_for_s);
  }
  void stop() noexcept override { inner_->drive()->stop(); }

 private:
  double leap_m_;
  Failure failure_;
  std::shared_ptr<Sensor> inner_;
  bool is_drive_;
};

class FailingLocalizer : public Localizer {
 public:
  FailingLocalizer(const Settings& settings, const LocalizerContext& context)
      : failure_(settings), inner_(inner<Localizer>(settings, context)) {}
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    PoseEstimate pose = inner_->update(observation, known);
    if (failure_.is_absurd()) pose.T_map_robot.x_m = 1e12;
    return pose;
  }

 private:
  Failure failure_;
  std::shared_ptr<Localizer> inner_;
};

class FailingMapper : public Mapper {
 public:
  FailingMapper(const Settings& settings, const MapperContext& context)
      : failure_(settings), inner_(inner<Mapper>(settings, context)) {}
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    (void)failure_.is_absurd();
    return inner_->integrate(observation, pose);
  }
  const OccupancyGrid& grid() const override { return inner_->grid(); }

 private:
  Failure failure_;
  std::shared_ptr<Mapper> inner_;
};

class FailingDetector : public Detector {
 public:
  FailingDetector(const Settings& settings, const DetectorContext&)
      : floods_(settings.fault == Fault::floods), failure_(settings) {}
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget&) override {
    if (!failure_.is_absurd()) return {};
    if (floods_) return flood();
    Matching matching;
    matching.detection = Detection{"ghost", {1e9, 0.0, 0.0}, 0.9, {}};
    return {{matching}};
  }

 private:
  // Each of them is valid; the host is busy for more than a second with all of them.
  static DetectionReport flood() {
    constexpr int kASide = 1000;
    constexpr double kStep_m = 0.003;  // over what has been seen when the robot has driven a metre
    DetectionReport report;
    for (int i = 0; i < kASide * kASide; ++i) {
      Matching matching;
      const Point at_m(1.0 + kStep_m * (i % kASide), 0.5 + kStep_m * (i / kASide));
      matching.detection = Detection{"ghost", {at_m.x(), at_m.y(), 0.0}, 0.9, {}};
      report.matchings.push_back(matching);
    }
    return report;
  }

  bool floods_;
  Failure failure_;
};

class FailingPlanner : public Planner {
 public:
  FailingPlanner(const Settings& settings, const ModuleContext&) : failure_(settings) {}
  PlanResult plan(const PlanRequest&, const WorldView&, const Budget&) const override {
    PlanResult result;
    if (failure_.is_absurd()) {
      result.outcome = PlanOutcome::solved;
      result.length_m = kNan;
    }
    return result;
  }

 private:
  mutable Failure failure_;
};

class FailingController : public Controller {
 public:
  FailingController(const Settings& settings, const ModuleContext&) : failure_(settings) {}
  ControlResult control(const ControlRequest& request, const WorldView&) override {
    ControlResult result;
    result.twist.v_mps = failure_.is_absurd() ? kNan : request.speed_mps;
    return result;
  }

 private:
  Failure failure_;
};

// Drives straight on.
class FailingBehaviour : public Behaviour {
 public:
  FailingBehaviour(const Settings& settings, const BehaviourFactoryContext&)
      : settings_(settings), failure_(settings) {}
  Status tick(const WorldView& world, BehaviourContext& context) override {
    if (!begin_s_) begin_s_ = world.time_s;
    Twist wanted{settings_.speed_mps, 0.0};
    if (settings_.asks == "control") {
      const Point ahead[] = {world.pose.T_map_robot.position(), world.pose.T_map_robot * Point(2.0, 0.0)};
      ControlRequest request;
      request.path = ahead;
      request.speed_mps = settings_.speed_mps;
      wanted = context.control(request).twist;
    }
    if (settings_.asks == "plan" && world.time_s - *begin_s_ > settings_.after_s) (void)context.plan({});
    if (failure_.is_absurd()) wanted.v_mps = kNan;
    context.drive(wanted);
    return {};
  }
  void halt() override {}

 private:
  Settings settings_;
  Failure failure_;
  std::optional<double> begin_s_;
};

template <class Interface, class Type>
void add(Registrar& registrar, const char* name) {
  registrar.add<Interface, Settings>(name, "for tests: works, then fails",
                                     [](const Settings& settings, const ContextOf<Interface>& context) {
                                       return std::make_unique<Type>(settings, context);
                                     });
}

void register_module(Registrar& registrar) {
  for (const bool is_drive : {false, true})
    registrar.add<Sensor, Settings>(is_drive ? "failing_drive" : "failing_sensor", "for tests: works, then fails",
                                    [is_drive](const Settings& settings, const SensorContext& context) {
                                      return std::make_unique<FailingSensor>(settings, context, is_drive);
                                    });
  add<Localizer, FailingLocalizer>(registrar, "failing_localizer");
  add<Mapper, FailingMapper>(registrar, "failing_map");
  add<Detector, FailingDetector>(registrar, "failing_detector");
  add<Planner, FailingPlanner>(registrar, "failing_planner");
  add<Controller, FailingController>(registrar, "failing_controller");
  add<Behaviour, FailingBehaviour>(registrar, "straight");
}

}  // namespace

CAIRN_MODULE(register_module)
