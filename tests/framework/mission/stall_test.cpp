// Whatever a mission is busy with for long: the wheels are stopped meanwhile, and drive on when it is over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "framework/mission/runner.hpp"
#include "tests/framework/mission/still_modules.hpp"
#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

// Which stage is busy, once, until the wheels have been stopped; by a clock that moves on there only.
struct Busy {
  std::string stage;
  int steps = 10;  // of the clock meanwhile; 1: nobody sees that it goes on
  std::shared_ptr<TestClock> clock = std::make_shared<TestClock>();
  std::atomic<int> stops = 0;
  std::atomic<bool> is_over = false;
  std::vector<Twist> commands_after;

  void visit(const std::string& now) {
    constexpr int kPatience = 20'000'000;  // yields: the test fails instead of hanging
    if (now != stage || is_over) return;
    // Who watches has looked once, before the clock moves.
    for (int i = 0; i < kPatience && clock->waits() < 2; ++i) std::this_thread::yield();
    for (int step = 0; step < steps; ++step) {
      clock->advance(std::chrono::milliseconds(600) / steps);
      // Until who watches has looked at this time: once more than the wait that may have begun before.
      const int waits = clock->waits();
      for (int i = 0; i < kPatience && clock->waits() < waits + 2; ++i) std::this_thread::yield();
    }
    for (int i = 0; i < kPatience && stops == 0; ++i) std::this_thread::yield();
    is_over = true;
  }
};

template <class Base>
class Visiting : public Base {
 public:
  template <class... Arguments>
  explicit Visiting(Busy& busy, Arguments&&... arguments) : Base(std::forward<Arguments>(arguments)...), busy_(busy) {}

 protected:
  Busy& busy_;
};

class BusySensor : public Visiting<still::Sensor> {
 public:
  using Visiting::Visiting;
  SensorStep next(const Budget& budget) override {
    SensorStep step = still::Sensor::next(budget);
    if (step.observation.stamp_s > 0.1) busy_.visit("sensor");
    step.observation.ranges = {still::nothing_ahead()};
    return step;
  }
  void command(const Twist& twist, double) override {
    busy_.visit("drive");
    if (busy_.is_over) busy_.commands_after.push_back(twist);
  }
  void stop() noexcept override { ++busy_.stops; }
};

class BusyLocalizer : public Visiting<still::Localizer> {
 public:
  using Visiting::Visiting;
  PoseEstimate update(const Observation& observation, const KnownMap& known) override {
    busy_.visit("localizer");
    return still::Localizer::update(observation, known);
  }
};

class BusyMapper : public Visiting<still::Mapper> {
 public:
  using Visiting::Visiting;
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    busy_.visit("map");
    return still::Mapper::integrate(observation, pose);
  }
};

class BusyDetector : public Visiting<still::Detector> {
 public:
  using Visiting::Visiting;
  DetectionReport detect(const OccupancyGrid& grid, const CellChanges& changes, const Budget& budget) override {
    busy_.visit("detector");
    return still::Detector::detect(grid, changes, budget);
  }
};

class BusyBehaviour : public Visiting<still::Behaviour> {
 public:
  using Visiting::Visiting;
  Status tick(const WorldView& world, BehaviourContext& context) override {
    busy_.visit("behaviour");
    return still::Behaviour::tick(world, context);
  }
};

// The host's own work, as far as a test can hold it: listeners are called by it.
class BusyListener : public Listener {
 public:
  explicit BusyListener(Busy& busy) : busy_(busy) {}
  void on(const Event& event, const MissionView&) override {
    if (std::holds_alternative<TickDone>(event)) busy_.visit("host");
    if (const auto* stalled = std::get_if<Stalled>(&event)) stalls.push_back(*stalled);
  }
  std::vector<Stalled> stalls;

 private:
  Busy& busy_;
};

class StallIn : public testing::TestWithParam<const char*> {
 protected:
  StallIn() { std::filesystem::create_directories(folder_); }
  ~StallIn() override { std::filesystem::remove_all(folder_); }

  static ModuleLibrary library_of(Busy& busy) {
    Registrar registrar;
    const auto add = [&]<class Interface, class Type>(const char* name, std::type_identity<Interface>,
                                                      std::type_identity<Type>) {
      registrar.add<Interface, NoConfig>(name, "is busy now and then", [&busy](const NoConfig&, const ModuleContext&) {
        if constexpr (std::is_same_v<Type, BusySensor>)
          return std::make_unique<Type>(busy, 50);
        else
          return std::make_unique<Type>(busy);
      });
    };
    add("busy_sensor", std::type_identity<Sensor>(), std::type_identity<BusySensor>());
    add("busy_localizer", std::type_identity<Localizer>(), std::type_identity<BusyLocalizer>());
    add("busy_map", std::type_identity<Mapper>(), std::type_identity<BusyMapper>());
    add("busy_detector", std::type_identity<Detector>(), std::type_identity<BusyDetector>());
    add("busy_step", std::type_identity<Behaviour>(), std::type_identity<BusyBehaviour>());
    ModuleLibrary library({});
    library.add("(busy)", registrar);
    return library;
  }
  static Mission mission() {
    Mission mission = still::mission(50);
    mission.config.sensor.name = "busy_sensor";
    mission.config.sensor.config.entries.clear();
    mission.config.localizer.name = "busy_localizer";
    mission.config.map.name = "busy_map";
    mission.config.detector.name = "busy_detector";
    mission.steps.front().choice.name = "busy_step";
    return mission;
  }

  const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                        ("cairn_stall_" + std::to_string(getpid()) + "_" + std::string(GetParam()));
};

TEST_P(StallIn, StopsTheWheelsAndDrivesOnAfterwards) {
  Busy busy{GetParam()};
  const ModuleLibrary library = library_of(busy);
  RunOptions options{folder_};
  options.wall_clock = busy.clock;
  BusyListener listener(busy);
  MissionRunner runner(mission(), library, options);
  runner.subscribe(listener);
  const MissionResult result = runner.run();
  EXPECT_TRUE(busy.is_over);
  EXPECT_GT(busy.stops, 0) << "while it lasted";
  EXPECT_EQ(result.reason, "the sensor's data ended before the steps did") << "nothing was given up";
  ASSERT_FALSE(busy.commands_after.empty());
  EXPECT_EQ(busy.commands_after.back(), (Twist{0.1, 0.0})) << "the robot drives on by itself";
  ASSERT_EQ(listener.stalls.size(), 1U);
  EXPECT_EQ(listener.stalls[0].stage, GetParam());
  EXPECT_NEAR(listener.stalls[0].for_s, 0.6, 1e-9);
}

TEST_P(StallIn, OfAWholeProcessBlamesNoStage) {
  Busy busy{GetParam(), 1};
  const ModuleLibrary library = library_of(busy);
  RunOptions options{folder_};
  options.wall_clock = busy.clock;
  BusyListener listener(busy);
  MissionRunner runner(mission(), library, options);
  runner.subscribe(listener);
  (void)runner.run();
  ASSERT_EQ(listener.stalls.size(), 1U);
  EXPECT_EQ(listener.stalls[0].stage, "");
}

INSTANTIATE_TEST_SUITE_P(EachStage, StallIn,
                         testing::Values("sensor", "localizer", "map", "detector", "behaviour", "drive", "host"));

}  // namespace
}  // namespace cairn
