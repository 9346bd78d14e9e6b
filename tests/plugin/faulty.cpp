// Modules that fail in every way that a mission must survive, and a small sensor that works.
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <future>
#include <limits>
#include <memory>
#include <stdexcept>
#include <thread>

#include "framework/contracts/module.hpp"

namespace {

using namespace cairn;

// Long enough to be given up, short enough for a test program to end after it.
void hang() {
  std::this_thread::sleep_for(std::chrono::seconds(3));
}

struct CountingConfig {
  int readings = 5;
  static void describe(Fields<CountingConfig>& fields) {
    fields.integer("readings", &CountingConfig::readings, {0.0, 1000.0}, "observations before the data ends");
  }
};

class CountingSensor : public Sensor, public Drive {
 public:
  explicit CountingSensor(int readings) : left_(readings) {}
  SensorStep next(const Budget&) override {
    SensorStep step;
    if (left_-- <= 0) {
      step.reason = "all readings given";
      return step;
    }
    step.state = SensorState::observation;
    step.observation.stamp_s = 0.04 * ++count_;
    return step;
  }
  Drive* drive() override { return this; }
  void command(const Twist&, double) override {}
  void stop() noexcept override {}

 private:
  int left_;
  int count_ = 0;
};

class NanSensor : public CountingSensor {
 public:
  NanSensor() : CountingSensor(5) {}
  SensorStep next(const Budget& budget) override {
    SensorStep step = CountingSensor::next(budget);
    step.observation.T_odom_robot.x_m = std::numeric_limits<double>::quiet_NaN();
    return step;
  }
};

class LeapingSensor : public CountingSensor {
 public:
  LeapingSensor() : CountingSensor(5) {}
  SensorStep next(const Budget& budget) override {
    SensorStep step = CountingSensor::next(budget);
    if (++steps_ == 3) step.observation.T_odom_robot.x_m = 1e12;
    return step;
  }

 private:
  int steps_ = 0;
};

class StillLocalizer : public Localizer {
 public:
  PoseEstimate update(const Observation&, const KnownMap&) override { return {}; }
};

class NanLocalizer : public Localizer {
 public:
  PoseEstimate update(const Observation&, const KnownMap&) override {
    PoseEstimate pose;
    pose.T_map_robot.x_m = std::numeric_limits<double>::quiet_NaN();
    return pose;
  }
};

// Asks its loop closer in a thread of its own, as a localizer with a back end does.
class AskingLocalizer : public Localizer {
 public:
  explicit AskingLocalizer(std::shared_ptr<LoopCloser> closer) : closer_(std::move(closer)) {}
  PoseEstimate update(const Observation&, const KnownMap&) override {
    const PassedSubmap passed[] = {{std::make_shared<Submap>(0, 0.1), {}, 1.0}};
    LoopQuery query;
    query.submaps = passed;
    const auto ask = [&] { return closer_->propose(query, Budget{}).size(); };
    if (std::async(std::launch::async, ask).get() != 1) std::abort();
    return {};
  }

 private:
  std::shared_ptr<LoopCloser> closer_;
};

// Proposes the first submap, in one way or another.
class FaultyCloser : public LoopCloser {
 public:
  explicit FaultyCloser(LoopProposal (*propose)()) : propose_(propose) {}
  std::vector<LoopProposal> propose(const LoopQuery&, const Budget&) override { return {propose_()}; }

 private:
  LoopProposal (*propose_)();
};

LoopProposal throw_no_memory() {
  throw std::runtime_error("no memory of this place");
}

LoopProposal throw_number() {
  throw 42;
}

LoopProposal propose_nan() {
  LoopProposal proposal;
  proposal.T_submap_node.y_m = std::numeric_limits<double>::quiet_NaN();
  return proposal;
}

LoopProposal propose_second() {
  LoopProposal proposal;
  proposal.submap = 1;
  return proposal;
}

LoopProposal hang_and_propose() {
  hang();
  return {};
}

template <LoopProposal (*propose)()>
void add_closer(Registrar& registrar, const char* name) {
  registrar.add<LoopCloser, NoConfig>(
      name, "for tests", [](const NoConfig&, const ModuleContext&) { return std::make_unique<FaultyCloser>(propose); });
}

class EmptyMapper : public Mapper {
 public:
  const CellChanges& integrate(const Observation&, const PoseEstimate&) override { return none_; }
  const OccupancyGrid& grid() const override { return grid_; }

 private:
  OccupancyGrid grid_{0.1};
  CellChanges none_;
};

class ThrowingMapper : public EmptyMapper {
 public:
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    if (++calls_ == 3) throw std::runtime_error("the map is torn");
    return EmptyMapper::integrate(observation, pose);
  }

 private:
  int calls_ = 0;
};

class HangingMapper : public EmptyMapper {
 public:
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    hang();
    return EmptyMapper::integrate(observation, pose);
  }
};

class NumberThrowingMapper : public EmptyMapper {
 public:
  const CellChanges& integrate(const Observation&, const PoseEstimate&) override { throw 42; }
};

class NanDetector : public Detector {
 public:
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget&) override {
    Matching matching;
    matching.detection = Detection{"ghost", {std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, 0.9, {}};
    return {{matching}};
  }
};

class HangingBehaviour : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext& context) override {
    context.drive({0.1, 0.0});
    hang();
    context.report("back again");
    return {};
  }
  void halt() override {}
};

// Comes back after it was given up.
class LateBehaviour : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext&) override {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return {StepState::success, "late, but here"};
  }
  void halt() override {}
};

class NanBehaviour : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext& context) override {
    context.drive({std::numeric_limits<double>::quiet_NaN(), 0.0});
    return {};
  }
  void halt() override {}
};

// Ends the process, in one way or another.
class EndingBehaviour : public Behaviour {
 public:
  explicit EndingBehaviour(void (*end)()) : end_(end) {}
  Status tick(const WorldView&, BehaviourContext& context) override {
    context.drive({0.1, 0.0});
    if (++ticks_ == 3) end_();
    return {};
  }
  void halt() override {}

 private:
  void (*end_)();
  int ticks_ = 0;
};

void crash() {
  volatile int* nowhere = nullptr;
  *nowhere = 1;  // NOLINT: a fault of a module
}

void terminate() {
  std::thread([] { throw std::runtime_error("nobody catches this"); }).join();
}

void exit_well() {
  std::exit(0);  // NOLINT: a fault of a module
}

void exit_quickly() {
  std::quick_exit(0);  // NOLINT: a fault of a module
}

void alarm() {
  (void)std::raise(SIGALRM);
}

std::unique_ptr<Localizer> exit_while_made() {
  std::exit(0);  // NOLINT: a fault of a module
}

std::unique_ptr<Localizer> crash_while_made() {
  crash();
  return nullptr;
}

template <class Interface>
std::unique_ptr<Interface> hang_while_made() {
  std::puts("hangs while it is made");
  std::fflush(stdout);
  for (;;) std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

template <class Interface>
void add_unmakable(Registrar& registrar, const char* name, std::unique_ptr<Interface> (*make)()) {
  registrar.add<Interface, NoConfig>(name, "for tests",
                                     [make](const NoConfig&, const ModuleContext&) { return make(); });
}

void exit_elsewhere() {
  std::thread([] { std::exit(0); }).detach();  // NOLINT: a fault of a module
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
}

int overflow(volatile int* depth) {
  volatile int mine[1024] = {*depth};
  return overflow(mine) + mine[7];  // NOLINT: a fault of a module
}

void overflow_the_stack() {
  volatile int depth = 0;
  (void)overflow(&depth);
}

template <void (*end)()>
void add_ending(Registrar& registrar, const char* name) {
  registrar.add<Behaviour, NoConfig>(
      name, "for tests", [](const NoConfig&, const ModuleContext&) { return std::make_unique<EndingBehaviour>(end); });
}

class FailingBehaviour : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext&) override { return {StepState::failure, "does not feel like it"}; }
  void halt() override {}
};

class EndlessBehaviour : public Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext&) override { return {StepState::running, "going on"}; }
  void halt() override {}
};

template <class Interface, class Type>
void add_plain(Registrar& registrar, const char* name) {
  registrar.add<Interface, NoConfig>(name, "for tests",
                                     [](const NoConfig&, const ModuleContext&) { return std::make_unique<Type>(); });
}

void register_module(Registrar& registrar) {
  registrar.add<Sensor, CountingConfig>(
      "counting_sensor", "for tests",
      [](const CountingConfig& c, const ModuleContext&) { return std::make_unique<CountingSensor>(c.readings); });
  add_plain<Sensor, NanSensor>(registrar, "nan_sensor");
  add_plain<Sensor, LeapingSensor>(registrar, "leaping_sensor");
  registrar.add<Sensor, NoConfig>("refusing_sensor", "for tests",
                                  [](const NoConfig&, const ModuleContext&) -> std::unique_ptr<Sensor> {
                                    throw ConfigError({"robot.yaml", 3, 9}, "there is no such port");
                                  });
  add_plain<Localizer, StillLocalizer>(registrar, "still_localizer");
  add_plain<Localizer, NanLocalizer>(registrar, "nan_localizer");
  registrar.add<Localizer, NoConfig>("asking_localizer", "for tests",
                                     [](const NoConfig&, const LocalizerContext& context) {
                                       return std::make_unique<AskingLocalizer>(context.loop_closer());
                                     });
  add_closer<throw_no_memory>(registrar, "throwing_closer");
  add_closer<throw_number>(registrar, "number_throwing_closer");
  add_closer<propose_nan>(registrar, "nan_closer");
  add_closer<propose_second>(registrar, "elsewhere_closer");
  add_closer<hang_and_propose>(registrar, "hanging_closer");
  add_plain<Mapper, EmptyMapper>(registrar, "empty_map");
  add_plain<Mapper, ThrowingMapper>(registrar, "throwing_map");
  add_plain<Mapper, NumberThrowingMapper>(registrar, "number_throwing_map");
  add_plain<Behaviour, FailingBehaviour>(registrar, "fail");
  add_plain<Mapper, HangingMapper>(registrar, "hanging_map");
  add_plain<Detector, NanDetector>(registrar, "nan_detector");
  add_plain<Behaviour, HangingBehaviour>(registrar, "hang");
  add_plain<Behaviour, LateBehaviour>(registrar, "late");
  add_plain<Behaviour, NanBehaviour>(registrar, "drive_nan");
  add_plain<Behaviour, EndlessBehaviour>(registrar, "endless");
  add_ending<crash>(registrar, "crash");
  add_ending<terminate>(registrar, "terminate");
  add_ending<exit_well>(registrar, "exit_well");
  add_ending<exit_elsewhere>(registrar, "exit_elsewhere");
  add_ending<exit_quickly>(registrar, "exit_quickly");
  add_ending<alarm>(registrar, "alarm");
  add_unmakable(registrar, "exiting_constructor", exit_while_made);
  add_unmakable(registrar, "crashing_constructor", crash_while_made);
  add_unmakable(registrar, "hanging_constructor", hang_while_made<Localizer>);
  add_unmakable(registrar, "hanging_sensor", hang_while_made<Sensor>);
  add_ending<overflow_the_stack>(registrar, "overflow");
  registrar.add<Localizer, NoConfig>("throwing_constructor", "for tests",
                                     [](const NoConfig&, const ModuleContext&) -> std::unique_ptr<Localizer> {
                                       throw std::runtime_error("no such device");
                                     });
}

}  // namespace

CAIRN_MODULE(register_module)
