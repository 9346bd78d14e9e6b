#include "plugins/behaviours/following/waiting_while_stopped.hpp"

#include <gmock/gmock.h>

#include "plugins/behaviours/errands/go_to.hpp"
#include "plugins/behaviours/errands/simple_steps.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::HasSubstr;

const std::string kRoom = R"(
  ########################
  #......................#
  #......................#
  #......................#
  #......................#
  #....R.................#
  #......................#
  #......................#
  #......................#
  #......................#
  ########################
)";
constexpr double kPressed_s = 2.0;
constexpr double kReleased_s = 62.0;

// Somebody holds the wheels for a minute.
class StoppedHost : public FakeHost {
 public:
  StoppedHost() : FakeHost(kRoom, {.all_known = true}) {
    observe = [](const FakeHost& host) {
      Observation seen;
      if (is_stopped(host.time_s)) seen.stopped_by = "the red button";
      return seen;
    };
    collision_monitor = [this](const Pose2&, const Twist& wanted) { return is_stopped(time_s) ? Twist{} : wanted; };
  }

 private:
  static bool is_stopped(double time_s) { return time_s >= kPressed_s && time_s < kReleased_s; }
};

std::unique_ptr<Behaviour> go_to(double x_m, double y_m) {
  GoToConfig config;
  config.at_m = Point(x_m, y_m);
  config.at_most_s = 30.0;
  return std::make_unique<GoTo>(config, 1);
}

std::unique_ptr<Behaviour> drive(double x_m, double y_m) {
  DriveConfig config;
  config.points_m = {{x_m, y_m}};
  return std::make_unique<DriveTo>(config, 1);
}

TEST(WaitingWhileStopped, AStepWouldFailOtherwise) {
  StoppedHost host;
  EXPECT_EQ(host.run(*drive(1.8, 0.5), 120.0).state, StepState::failure);
}

TEST(WaitingWhileStopped, GoesOnAfterALongStop) {
  for (const auto& make : {go_to, drive}) {
    StoppedHost host;
    WaitingWhileStopped step(make(1.8, 0.5));
    EXPECT_EQ(host.run(step, 30.0).reason, "waits: the robot is stopped by the red button");
    const Pose2 held = host.T_map_robot;
    EXPECT_EQ(host.run(step, 30.0).state, StepState::running);
    EXPECT_EQ(host.T_map_robot, held);
    const Status end = host.run(step, 60.0);
    EXPECT_EQ(end.state, StepState::success) << end.reason;
    EXPECT_LT((host.T_map_robot.position() - Point(1.8, 0.5)).norm(), 0.15);
    EXPECT_GT(host.time_s, kReleased_s);
  }
}

TEST(WaitingWhileStopped, TheTimeOfAStopIsNoneOfTheSteps) {
  StoppedHost host;
  WaitingWhileStopped step(go_to(5.0, 5.0));
  host.collision_monitor = [](const Pose2&, const Twist&) { return Twist{}; };
  (void)host.run(step, kReleased_s + 1.0);
  EXPECT_EQ(host.tick(step).state, StepState::running);
  EXPECT_EQ(host.run(step, 40.0).state, StepState::failure);
}

TEST(WaitingWhileStopped, AStepThatIsLeftMeanwhileBeginsAfresh) {
  StoppedHost host;
  WaitingWhileStopped step(go_to(1.8, 0.5));
  EXPECT_EQ(host.run(step, 10.0).state, StepState::running);
  step.halt();
  EXPECT_EQ(host.run(step, 120.0).state, StepState::success);
}

}  // namespace
}  // namespace cairn::behaviours
