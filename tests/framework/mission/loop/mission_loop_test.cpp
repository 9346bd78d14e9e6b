// A whole mission of modules that write down what they get: the order of a tick, its end, and that no module gets
// anything of the ground truth.
#include "framework/mission/loop/mission_loop.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <sstream>

#include "tests/framework/mission/still_modules.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;

// What all modules of a mission are asked, in order.
struct Notes {
  std::vector<std::string> calls;  // stages
  std::vector<std::string> seen;   // all that they get of observations and the world, to the last bit
  std::vector<std::string> made_with_the_world;
  std::vector<Twist> commands;
};

std::string text_of(const Pose2& pose) {
  std::ostringstream out;
  out << std::hexfloat << pose.x_m << ' ' << pose.y_m << ' ' << pose.theta_rad << ' ';
  return out.str();
}

// Does not compile when an observation holds anything else.
std::string text_of(const Observation& observation) {
  const auto& [stamp_s, recorded_s, T_odom_robot, compass_rad, ranges, bumped, battery_ratio, stopped_by, images,
               markers] = observation;
  std::ostringstream out;
  out << std::hexfloat << stamp_s << ' ' << recorded_s.value_or(9.0) << ' ' << text_of(T_odom_robot)
      << compass_rad.value_or(9.0) << ' ' << bumped << ' ' << battery_ratio.value_or(9.0) << ' ' << stopped_by << ' '
      << images.size() << ' ' << markers.size();
  for (const RangeReading& reading : ranges) out << ' ' << reading.range_m;
  return out.str();
}

std::string text_of(const WorldView& world) {
  return text_of(world.pose.T_map_robot) + std::to_string(world.time_s) + " " + text_of(world.T_map_start) +
         std::to_string(world.speed_reduction_ratio) + " " +
         (world.observation == nullptr ? "nothing" : text_of(*world.observation));
}

// Really stands off_m beside where its odometry says, and touches something at its third tick.
class SpySensor : public Sensor, public Drive, public GroundTruthSource {
 public:
  SpySensor(Notes& notes, double off_m) : notes_(notes), off_m_(off_m) {}
  SensorStep next(const Budget&) override {
    notes_.calls.emplace_back("sensor");
    SensorStep step;
    if (++tick_ > 8) return step;
    step.state = SensorState::observation;
    step.observation.stamp_s = 0.04 * tick_;
    step.observation.T_odom_robot = {0.01 * tick_, 0.0, 0.0};
    step.observation.compass_rad = 0.0;
    step.observation.ranges = {still::nothing_ahead()};
    step.observation.bumped = tick_ == 3;
    return step;
  }
  Drive* drive() override { return this; }
  void stop() noexcept override { notes_.commands.emplace_back(); }
  void command(const Twist& twist, double /*valid_for_s*/) override {
    notes_.calls.emplace_back("drive");
    notes_.commands.push_back(twist);
  }
  [[nodiscard]] const GroundTruthSource* truth() const override { return this; }
  [[nodiscard]] std::optional<GroundTruth> last_truth() const override {
    GroundTruth truth{{0.01 * tick_, off_m_, 0.0}};
    if (tick_ == 3) truth.contact = Contact{off_m_, true};
    return truth;
  }

 private:
  Notes& notes_;
  double off_m_;
  int tick_ = 0;
};

class SpyLocalizer : public Localizer {
 public:
  explicit SpyLocalizer(Notes& notes) : notes_(notes) {}
  PoseEstimate update(const Observation& observation, const KnownMap&) override {
    notes_.calls.emplace_back("localizer");
    notes_.seen.push_back(text_of(observation));
    PoseEstimate pose;
    pose.T_map_robot = observation.T_odom_robot;
    return pose;
  }

 private:
  Notes& notes_;
};

class SpyMapper : public Mapper {
 public:
  explicit SpyMapper(Notes& notes) : notes_(notes) {}
  const CellChanges& integrate(const Observation& observation, const PoseEstimate& pose) override {
    notes_.calls.emplace_back("map");
    notes_.seen.push_back(text_of(observation) + text_of(pose.T_map_robot));
    return changes_;
  }
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }

 private:
  Notes& notes_;
  OccupancyGrid grid_{0.1};
  CellChanges changes_;
};

class SpyDetector : public Detector {
 public:
  explicit SpyDetector(Notes& notes) : notes_(notes) {}
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget&) override {
    notes_.calls.emplace_back("detector");
    return {};
  }

 private:
  Notes& notes_;
};

class SpyPlanner : public Planner {
 public:
  explicit SpyPlanner(Notes& notes) : notes_(notes) {}
  PlanResult plan(const PlanRequest&, const WorldView& world, const Budget&) const override {
    notes_.seen.push_back("planner " + text_of(world));
    return {};
  }

 private:
  Notes& notes_;
};

class SpyBehaviour : public Behaviour {
 public:
  explicit SpyBehaviour(Notes& notes) : notes_(notes) {}
  Status tick(const WorldView& world, BehaviourContext& context) override {
    notes_.calls.emplace_back("behaviour");
    notes_.seen.push_back(text_of(world));
    if (++tick_ == 2) (void)context.plan({});
    context.drive({0.1, 0.0});
    if (tick_ == 6) return {StepState::success, "seen enough"};
    return {};
  }
  void halt() override {}

 private:
  Notes& notes_;
  int tick_ = 0;
};

// What listeners get of the truth.
class TruthListener : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override {
    if (std::holds_alternative<TickDone>(event)) truth.push_back(view.truth.value());
  }
  std::vector<GroundTruth> truth;
};

class LoopOfSpies : public testing::Test {
 protected:
  LoopOfSpies() { std::filesystem::create_directories(folder_); }
  ~LoopOfSpies() override { std::filesystem::remove_all(folder_); }

  static ModuleLibrary library_of(Notes& notes, double off_m) {
    Registrar registrar;
    const auto add = [&]<class Interface>(std::type_identity<Interface>, const char* name, auto make) {
      registrar.add<Interface, NoConfig>(name, "writes down",
                                         [&notes, name, make](const NoConfig&, const ContextOf<Interface>& context) {
                                           if constexpr (requires { context.world; })
                                             if (context.world != nullptr) notes.made_with_the_world.emplace_back(name);
                                           return make();
                                         });
    };
    add(std::type_identity<Sensor>(), "spy_sensor",
        [&notes, off_m] { return std::make_unique<SpySensor>(notes, off_m); });
    add(std::type_identity<Localizer>(), "spy_localizer", [&] { return std::make_unique<SpyLocalizer>(notes); });
    add(std::type_identity<Mapper>(), "spy_map", [&] { return std::make_unique<SpyMapper>(notes); });
    add(std::type_identity<Detector>(), "spy_detector", [&] { return std::make_unique<SpyDetector>(notes); });
    add(std::type_identity<Planner>(), "spy_planner", [&] { return std::make_unique<SpyPlanner>(notes); });
    add(std::type_identity<Behaviour>(), "spy_step", [&] { return std::make_unique<SpyBehaviour>(notes); });
    ModuleLibrary library({});
    library.add("(spies)", registrar);
    return library;
  }
  static Mission mission() {
    Mission mission;
    mission.config.mission = "spied";
    const auto choice = [](const char* name) {
      PluginChoice c{name, {}};
      c.config.kind = ConfigValue::Kind::map;
      return c;
    };
    mission.config.sensor = choice("spy_sensor");
    mission.config.localizer = choice("spy_localizer");
    mission.config.map = choice("spy_map");
    mission.config.detector = choice("spy_detector");
    mission.config.planner = choice("spy_planner");
    mission.steps.push_back({NodeKind::behaviour, "spy_step", choice("spy_step"), "1"});
    mission.world.emplace();
    return mission;
  }
  MissionResult run(Notes& notes, double off_m, Listener& listener) {
    const ModuleLibrary library = library_of(notes, off_m);
    MissionRunner runner(mission(), library, {folder_});
    runner.subscribe(listener);
    return runner.run();
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / ("cairn_spied_" + std::to_string(getpid()));
};

TEST_F(LoopOfSpies, ATickAsksItsStagesInTheirOrder) {
  Notes notes;
  TruthListener listener;
  const MissionResult result = run(notes, 0.0, listener);
  ASSERT_EQ(result.outcome, MissionOutcome::done) << result.reason;
  ASSERT_GE(notes.calls.size(), 6U);
  notes.calls.resize(6);
  EXPECT_THAT(notes.calls, ElementsAre("sensor", "localizer", "map", "detector", "behaviour", "drive"));
  EXPECT_EQ(result.collisions, 1);
  EXPECT_NEAR(result.distance_m, 0.05, 1e-9);
}

TEST_F(LoopOfSpies, TheRobotStandsAtTheEndOfTheMissionAndWhilePlanning) {
  Notes notes;
  TruthListener listener;
  (void)run(notes, 0.0, listener);
  ASSERT_GE(notes.commands.size(), 3U);
  EXPECT_EQ(notes.commands.back(), Twist{});
  EXPECT_EQ(notes.commands[0], (Twist{0.1, 0.0}));
  EXPECT_EQ(notes.commands[1], Twist{}) << "the second tick plans";
  EXPECT_EQ(notes.commands[2], (Twist{0.1, 0.0}));
}

// Two simulations that differ in nothing but what really is.
TEST_F(LoopOfSpies, ModulesGetTheSameWhateverTheTruthIsAndListenersGetTheTruth) {
  Notes here, elsewhere;
  TruthListener at_0, at_5;
  const MissionResult result = run(here, 0.0, at_0);
  const SavedMap map_here = load_map(folder_ / result.map_file);
  (void)run(elsewhere, 5.0, at_5);
  const SavedMap map_elsewhere = load_map(folder_ / result.map_file);

  EXPECT_EQ(here.seen.size(), 6 * 3 + 1U);
  EXPECT_EQ(here.seen, elsewhere.seen);
  EXPECT_EQ(here.calls, elsewhere.calls);
  EXPECT_EQ(here.commands, elsewhere.commands);

  ASSERT_EQ(at_5.truth.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(at_5.truth[i].T_map_robot, (Pose2{0.01 * static_cast<double>(i + 1), 5.0, 0.0})) << "of that very tick";
    EXPECT_EQ(at_0.truth[i].T_map_robot.y_m, 0.0);
    EXPECT_EQ(at_5.truth[i].contact.has_value(), i == 2);
  }
  EXPECT_EQ(map_here.progress->true_T_map_robot->y_m, 0.0) << "for going on with a simulation";
  EXPECT_EQ(map_elsewhere.progress->true_T_map_robot->y_m, 5.0);
  EXPECT_EQ(map_elsewhere.progress->T_map_robot, map_here.progress->T_map_robot);
}

TEST_F(LoopOfSpies, OnlyTheSensorIsMadeWithTheSimulatedWorld) {
  Notes notes;
  const ModuleLibrary library = library_of(notes, 0.0);
  const MissionRunner runner(mission(), library, {folder_});
  EXPECT_THAT(notes.made_with_the_world, ElementsAre("spy_sensor"));
}

}  // namespace
}  // namespace cairn
