// Conformance of modules of kind `sensor`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyLog, SensorConformance,
//                            testing::Values(module<cairn::Sensor>(FOLDER, "my_log", "{file: /path/to/short.log}")));
//   }
//
// The source must give at least one observation; a log should be short.
#pragma once

#include <atomic>
#include <thread>

#include "framework/contracts/ground_truth.hpp"
#include "maps/geometry/segments.hpp"
#include "tests/conformance/allocations.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class SensorConformance : public Conformance<Sensor> {
 protected:
  static constexpr int kMax = 400;          // observations looked at
  static constexpr double kValid_s = 60.0;  // longer than any test drives

  // Up to `most` steps, the last one the first that is not an observation. A source that moves goes in a circle.
  static std::vector<SensorStep> steps_of(Sensor& sensor, int most = kMax) {
    std::vector<SensorStep> steps;
    if (sensor.drive() != nullptr) sensor.drive()->command({0.2, 0.3}, kValid_s);
    while (static_cast<int>(steps.size()) < most) {
      steps.push_back(sensor.next(Budget{}));
      if (steps.back().state != SensorState::observation) break;
    }
    return steps;
  }
  static std::string fault_of(const RangeReading& r) {
    if (!is_finite(r.T_robot_sensor)) return "T_robot_sensor is not finite";
    if (!(r.half_beam_rad >= 0.0 && r.half_beam_rad <= std::numbers::pi)) return "half_beam_rad is not in [0, pi]";
    if (!(r.min_m >= 0.0 && r.min_m < r.max_m && std::isfinite(r.max_m))) return "not 0 <= min_m < max_m < inf";
    if (r.sensor < 0) return "sensor is negative";
    if (std::isfinite(r.range_m) && !(r.range_m >= r.min_m && r.range_m <= r.max_m))
      return "a finite range_m outside [min_m, max_m]; +inf is no echo, -inf nearer than min_m, NaN a bad reading";
    return {};
  }
  // How the odometry moves in one observation, as metres and radians a second; empty at equal stamps.
  static std::optional<Twist> speed_between(const Observation& a, const Observation& b) {
    const double took_s = b.stamp_s - a.stamp_s;
    if (!(took_s > 0.0)) return std::nullopt;
    const Pose2 moved = inverse(a.T_odom_robot) * b.T_odom_robot;
    return Twist{moved.position().norm() / took_s, std::abs(moved.theta_rad) / took_s};
  }

  // The first observation at stamp_s or later; a source that ends or whose time stands fails the test after a while.
  static Observation observe_until(Sensor& sensor, Observation last, double stamp_s) {
    constexpr int kMost = 10'000;
    for (int i = 0; last.stamp_s < stamp_s && i < kMost; ++i) last = sensor.next(Budget{}).observation;
    EXPECT_GE(last.stamp_s, stamp_s) << "after " << kMost << " calls of next()";
    return last;
  }

  static void expect_standing(const Observation& a, const Observation& b, const char* because) {
    const auto speed = speed_between(a, b);
    ASSERT_TRUE(speed) << "stamps " << a.stamp_s << " s and " << b.stamp_s << " s: " << because;
    EXPECT_LT(speed->v_mps, 0.01) << because;
    EXPECT_LT(speed->w_radps, 0.05) << because;
  }
};

TEST_P(SensorConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(SensorConformance, OutlivesTheLibraryThatMadeIt) {
  const auto sensor = GetParam().make_outliving_library();
  const SensorStep first = sensor->next(Budget{});
  ASSERT_EQ(first.state, SensorState::observation) << "the suite needs one observation at least: " << first.reason;
}

TEST_P(SensorConformance, StampsNeverGoBack) {
  const auto sensor = make();
  double last_s = -kInfinity;
  for (const SensorStep& step : steps_of(*sensor)) {
    if (step.state != SensorState::observation) break;
    ASSERT_TRUE(std::isfinite(step.observation.stamp_s));
    ASSERT_GE(step.observation.stamp_s, last_s) << "observations come in order of time";
    last_s = step.observation.stamp_s;
  }
  EXPECT_GT(last_s, -kInfinity) << "no observation";
}

TEST_P(SensorConformance, ObservationsKeepTheirContract) {
  const auto sensor = make();
  for (const SensorStep& step : steps_of(*sensor)) {
    if (step.state != SensorState::observation) break;
    const Observation& seen = step.observation;
    ASSERT_TRUE(is_finite(seen.T_odom_robot)) << text_of(step);
    ASSERT_TRUE(std::isfinite(seen.compass_rad.value_or(0.0))) << "no compass is no value, not NaN";
    for (const RangeReading& reading : seen.ranges) ASSERT_EQ(fault_of(reading), "") << text_of(step);
  }
}

TEST_P(SensorConformance, OdometryCountsFromTheFirstObservation) {
  const auto sensor = make();
  const SensorStep first = sensor->next(Budget{});
  ASSERT_EQ(first.state, SensorState::observation) << first.reason;
  EXPECT_LT(first.observation.T_odom_robot.position().norm(), 0.5) << "T_odom_robot is dead reckoning since the start";
}

TEST_P(SensorConformance, AnEndIsFinalAndSaysWhy) {
  const auto sensor = make();
  const std::vector<SensorStep> steps = steps_of(*sensor, 100000);
  if (steps.back().state == SensorState::observation) return;  // a source without an end
  EXPECT_NE(steps.back().reason, "") << "end of data and faults come with a sentence for people";
  for (int i = 0; i < 3; ++i) {
    const SensorStep again = sensor->next(Budget{});
    EXPECT_EQ(again.state, steps.back().state) << "what has ended stays ended";
    EXPECT_NE(again.reason, "");
  }
}

TEST_P(SensorConformance, StartAndDriveAreTheSameAllTheTime) {
  const auto sensor = make();
  const std::optional<Pose2> start = sensor->start();
  Drive* const drive = sensor->drive();
  EXPECT_TRUE(is_finite(start.value_or(Pose2{})));
  (void)steps_of(*sensor, 20);
  EXPECT_EQ(sensor->start(), start) << "the start is known before the first observation and does not move";
  EXPECT_EQ(sensor->drive(), drive);
}

TEST_P(SensorConformance, TheTruthIsThatOfTheLastObservationAndTheSameForTheSameSeed) {
  const auto sensor = make(7);
  const auto again = make(7);
  const GroundTruthSource* const truth = sensor->truth();
  ASSERT_EQ(truth == nullptr, again->truth() == nullptr);
  if (truth == nullptr) return;  // a source that never knows
  EXPECT_FALSE(truth->last_truth()) << "nothing is known before the first observation";
  for (int i = 0; i < 50; ++i) {
    if (steps_of(*sensor, 1).back().state != SensorState::observation) break;
    (void)steps_of(*again, 1);
    const std::optional<GroundTruth> here = truth->last_truth();
    const std::optional<GroundTruth> there = again->truth()->last_truth();
    ASSERT_EQ(here.has_value(), there.has_value());
    if (!here) continue;
    ASSERT_TRUE(is_finite(here->T_map_robot));
    ASSERT_EQ(here->T_map_robot, there->T_map_robot) << "the answer must depend on config, seed and commands only";
    ASSERT_EQ(truth->last_truth()->T_map_robot, here->T_map_robot) << "to ask changes nothing";
  }
  EXPECT_EQ(sensor->truth(), truth);
}

TEST_P(SensorConformance, TheSameSeedGivesTheSameObservations) {
  const auto first = make(7);
  const auto second = make(7);
  EXPECT_EQ(text_of(steps_of(*first)), text_of(steps_of(*second)))
      << "the answer must depend on config, seed and commands only";
}

TEST_P(SensorConformance, TwoObjectsShareNothing) {
  const auto alone = make(7);
  const std::vector<SensorStep> expected = steps_of(*alone, 50);
  const auto sensor = make(7);
  const auto other = make(8);
  if (other->drive() != nullptr) other->drive()->command({-0.1, -0.5}, kValid_s);
  if (sensor->drive() != nullptr) sensor->drive()->command({0.2, 0.3}, kValid_s);
  std::vector<SensorStep> steps;
  while (steps.size() < expected.size()) {
    (void)other->next(Budget{});
    steps.push_back(sensor->next(Budget{}));
  }
  EXPECT_EQ(text_of(steps), text_of(expected)) << "another object of the module changed what this one says";
}

TEST_P(SensorConformance, AUsedUpBudgetEndsACallPromptlyAndLosesNothing) {
  const auto sensor = make();
  ASSERT_EQ(sensor->next(Budget{}).state, SensorState::observation);
  const UsedUpBudget used_up;
  for (const Budget& budget : {used_up.cancelled(), UsedUpBudget::past_deadline()})
    EXPECT_LT(seconds_of([&] { (void)sensor->next(budget); }), kPromptly_s) << "next() waits past its budget";
  const SensorStep after = sensor->next(Budget{});
  EXPECT_NE(after.state, SensorState::fault) << "a cancelled call is no fault of the source: " << after.reason;
}

TEST_P(SensorConformance, ADriveStopsWhenAsked) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;  // a source that does not move
  const RobotModel& robot = setup().robot;
  drive->command({0.2, 0.0}, kValid_s);
  Observation last = sensor->next(Budget{}).observation;
  last = observe_until(*sensor, last, 2.0);
  EXPECT_GT(last.T_odom_robot.position().norm(), 0.05) << "it was commanded to drive 2 s at 0.2 m/s and did not move";
  drive->command(Twist{}, kValid_s);
  const double stopped_s = last.stamp_s + 0.2 / robot.max_acceleration_mps2 + 0.5;
  last = observe_until(*sensor, last, stopped_s);
  const Observation later = sensor->next(Budget{}).observation;
  expect_standing(last, later, "Twist{} stops, as fast as the robot's limits allow");
}

TEST_P(SensorConformance, ADriveStopsByItselfWhenItsCommandIsNotRenewed) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;
  constexpr double kShort_s = 0.5;
  Observation last = sensor->next(Budget{}).observation;
  const double begin_s = last.stamp_s;
  while (last.stamp_s < begin_s + 3.0) {
    drive->command({0.2, 0.0}, kShort_s);
    last = sensor->next(Budget{}).observation;
  }
  EXPECT_GT(last.T_odom_robot.position().norm(), 0.05) << "commands that are renewed drive on";
  const double stopped_s = last.stamp_s + kShort_s + 0.2 / setup().robot.max_acceleration_mps2 + 0.5;
  last = observe_until(*sensor, last, stopped_s);
  const Observation later = sensor->next(Budget{}).observation;
  expect_standing(last, later, "the time of the last command has passed: the wheels stand");
  drive->command({0.2, 0.0}, kShort_s);
  last = sensor->next(Budget{}).observation;
  const auto speed = speed_between(later, last);
  EXPECT_TRUE(speed && speed->v_mps > 0.0) << "a new command drives on";
}

TEST_P(SensorConformance, ADriveStopsForAnotherThread) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;
  std::atomic<bool> is_done = false;
  std::thread stopper([&] {
    while (!is_done) drive->stop();
  });
  Observation last = sensor->next(Budget{}).observation;
  const double end_s = last.stamp_s + 5.0;
  last = observe_until(*sensor, last, end_s);
  is_done = true;
  stopper.join();
  drive->command({0.2, 0.0}, kValid_s);
  last = observe_until(*sensor, last, end_s + 2.0);
  EXPECT_GT(last.T_odom_robot.position().norm(), 0.05) << "the command after a stop drives";
  drive->stop();
  const double stopped_s = last.stamp_s + 0.2 / setup().robot.max_acceleration_mps2 + 0.5;
  last = observe_until(*sensor, last, stopped_s);
  const Observation later = sensor->next(Budget{}).observation;
  expect_standing(last, later, "stop() stops, whatever was commanded before");
}

TEST_P(SensorConformance, ADriveKeepsToTheLimitsOfTheRobot) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;
  const RobotModel& robot = setup().robot;
  Observation last = sensor->next(Budget{}).observation;
  for (const Twist& wild : {Twist{kHuge, 0.0}, Twist{-kHuge, kHuge}, Twist{0.0, -kHuge}}) {
    drive->command(wild, kValid_s);
    for (int i = 0; i < 40; ++i) {
      const Observation next = sensor->next(Budget{}).observation;
      const auto speed = speed_between(last, next);
      last = next;
      if (!speed) continue;
      // Odometry has its error: half as much again separates a limit that is kept from one that is not.
      ASSERT_LT(speed->v_mps, 1.5 * robot.max_v_mps + 0.05) << "commanded " << text_of(wild);
      ASSERT_LT(speed->w_radps, 1.5 * robot.max_w_radps + 0.1) << "commanded " << text_of(wild);
    }
  }
}

TEST_P(SensorConformance, ACommandThatIsNotFiniteIsRefusedOrIgnored) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;
  for (const Twist& bad : {Twist{kNan, 0.0}, Twist{0.0, kNan}, Twist{kInfinity, 0.0}, Twist{0.0, -kInfinity}}) {
    try {
      drive->command(bad, kValid_s);
    } catch (const std::exception& error) {
      EXPECT_STRNE(error.what(), "");
    }
    for (int i = 0; i < 10; ++i) {
      const SensorStep step = sensor->next(Budget{});
      ASSERT_EQ(step.state, SensorState::observation) << "after the command " << text_of(bad) << ": " << step.reason;
      ASSERT_TRUE(is_finite(step.observation.T_odom_robot)) << "after the command " << text_of(bad);
    }
  }
  drive->command({0.1, 0.0}, kValid_s);
  EXPECT_EQ(sensor->next(Budget{}).state, SensorState::observation) << "a good command after a bad one";
}

TEST_P(SensorConformance, ACommandAllocatesNothing) {
  const auto sensor = make();
  Drive* const drive = sensor->drive();
  if (drive == nullptr) return;
  drive->command({0.1, 0.1}, kValid_s);
  const AllocationCount allocations;
  for (int i = 0; i < 10; ++i) drive->command({0.01 * i, -0.1}, kValid_s);
  EXPECT_EQ(allocations.count(), 0) << "command() is hot";
}

}  // namespace cairn::conformance
