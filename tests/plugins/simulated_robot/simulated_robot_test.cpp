#include "plugins/simulated_robot/simulated_robot.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>

#include "tests/plugins/simulated_robot/test_worlds.hpp"
#include "tests/plugins/simulated_robot/witnessed.hpp"

namespace cairn {
namespace {

using testing::circle_at;
using testing::exact_robot;
using ::testing::HasSubstr;
using testing::observe;
using testing::room;
using testing::square_at;
using testing::tilted_wall;
using testing::Witnessed;

constexpr Budget kNoLimit{};

Witnessed drive_for(SimulatedRobot& robot, const Twist& twist, double time_s) {
  robot.command(twist, kAlways_s);
  Witnessed last;
  for (int i = 0; i < std::lround(time_s / 0.04); ++i) last = observe(robot);
  return last;
}

RobotModel pioneer() {
  RobotModel robot = exact_robot();
  robot.sonars.clear();
  const double poses[7][3] = {{100, 100, 90},  {120, 80, 30},   {130, 40, 15},   {130, 0, 0},
                              {130, -40, -15}, {120, -80, -30}, {100, -100, -90}};
  for (const auto& p : poses) {
    SonarModel sonar;
    sonar.T_robot_sonar = {p[0] / 1000, p[1] / 1000, radians(p[2])};
    robot.sonars.push_back(sonar);
  }
  return robot;
}

World furnished_room() {
  World world = room(6.0, 5.0);
  world.objects = {square_at({1.5, 3.5}, 0.5, 15.0), circle_at({4.0, 1.0}, 0.5)};
  return world;
}

TEST(SimulatedRobot, NeedsAWorld) {
  try {
    SimulatedRobot({}, exact_robot(), nullptr, {}, 1);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("simulated_robot needs a world"));
  }
}

TEST(SimulatedRobot, RefusesAFiringOrderThatNamesNoSonar) {
  RobotModel robot = exact_robot();
  robot.firing_order = {0, 1};
  const World world;
  EXPECT_THROW(SimulatedRobot({}, robot, &world, {}, 1), std::invalid_argument);
}

TEST(SimulatedRobot, FiresOneTransducerEachPeriodInItsOrder) {
  RobotModel robot = pioneer();
  robot.firing_order = {3, 0, 6};
  const World world = room(6.0, 5.0);
  SimulatedRobot sensor({}, robot, &world, {3.0, 2.5, 0.0}, 1);
  for (int i = 0; i < 7; ++i) {
    const Witnessed seen = observe(sensor);
    EXPECT_DOUBLE_EQ(seen.stamp_s, 0.04 * (i + 1));
    ASSERT_EQ(seen.ranges.size(), 1U);
    EXPECT_EQ(seen.ranges[0].sensor, robot.firing_order[i % 3]);
    EXPECT_EQ(seen.ranges[0].T_robot_sensor, robot.sonars[seen.ranges[0].sensor].T_robot_sonar);
    EXPECT_DOUBLE_EQ(seen.ranges[0].half_beam_rad, radians(15.0));
  }
}

TEST(SimulatedRobot, FiresAllTransducersAtOnceWhenAskedOrWithoutAPeriod) {
  const World world = room(6.0, 5.0);
  SimulatedRobotConfig all;
  all.fire_all = true;
  SimulatedRobot asked(all, pioneer(), &world, {3.0, 2.5, 0.0}, 1);
  EXPECT_EQ(observe(asked).ranges.size(), 7U);
  RobotModel robot = pioneer();
  robot.firing_period_s = 0.0;
  SimulatedRobotConfig slow;
  slow.tick_s = 0.1;
  SimulatedRobot without_period(slow, robot, &world, {3.0, 2.5, 0.0}, 1);
  EXPECT_EQ(observe(without_period).ranges.size(), 7U);
  EXPECT_DOUBLE_EQ(observe(without_period).stamp_s, 0.2);
}

TEST(SimulatedRobot, ReadsPlusInfinityWithoutAnEchoAndMinusInfinityNearerThanItsMinimum) {
  const World nothing;
  SimulatedRobot alone({}, exact_robot(), &nothing, {}, 1);
  EXPECT_EQ(observe(alone).ranges[0].range_m, std::numeric_limits<double>::infinity());
  RobotModel robot = exact_robot();
  robot.sonars[0].min_m = 0.4;
  const World close = tilted_wall(0.3, 0.0);
  SimulatedRobot near_wall({}, robot, &close, {}, 1);
  EXPECT_EQ(observe(near_wall).ranges[0].range_m, -std::numeric_limits<double>::infinity());
}

TEST(SimulatedRobot, DropsEchoesAndMakesThemUpInTheSharesAsked) {
  RobotModel robot = exact_robot();
  robot.range_error = {0.01, 0.0, 0.2, 0.1};
  const World world = tilted_wall(2.0, 0.0);
  SimulatedRobot sensor({}, robot, &world, {}, 3);
  int dropped = 0, elsewhere = 0;
  double sum = 0.0, squares = 0.0;
  constexpr int kReadings = 20000;
  for (int i = 0; i < kReadings; ++i) {
    const double range_m = observe(sensor).ranges[0].range_m;
    if (std::isinf(range_m)) {
      ++dropped;
    } else if (std::abs(range_m - 2.0) > 0.06) {
      ++elsewhere;
    } else {
      sum += range_m - 2.0;
      squares += (range_m - 2.0) * (range_m - 2.0);
    }
  }
  EXPECT_NEAR(dropped / double(kReadings), 0.2 * 0.9, 0.01);
  EXPECT_NEAR(elsewhere / double(kReadings), 0.1, 0.01);
  const double good = kReadings - dropped - elsewhere;
  EXPECT_NEAR(sum / good, 0.0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / good), 0.01, 0.001);
}

TEST(SimulatedRobot, DrivesArcsWithinItsLimits) {
  const World world;
  SimulatedRobot sensor({}, exact_robot(), &world, {1.0, 2.0, radians(90.0)}, 1);
  const Witnessed seen = drive_for(sensor, {9.0, 0.0}, 10.0);
  EXPECT_NEAR(sensor.twist().v_mps, 0.4, 1e-12);
  // 0.8 s to full speed covers 0.16 m, then 9.2 s at 0.4 m/s.
  EXPECT_NEAR(seen.true_T_map_robot->y_m - 2.0, 0.16 + 9.2 * 0.4, 1e-9);
  EXPECT_NEAR(seen.true_T_map_robot->x_m, 1.0, 1e-9);
  EXPECT_NEAR(seen.T_odom_robot.x_m, 3.84, 1e-9) << "dead reckoning begins at identity";
  EXPECT_NEAR(seen.T_odom_robot.y_m, 0.0, 1e-9);
  EXPECT_NEAR(*seen.compass_rad, radians(90.0), 1e-9);
  EXPECT_NEAR(drive_for(sensor, {0.0, 0.0}, 2.0).true_T_map_robot->y_m - 2.0, 0.16 + 9.2 * 0.4 + 0.16, 1e-9);
}

TEST(SimulatedRobot, HasNoCompassWhereItsFileGivesNone) {
  const World world;
  RobotModel robot = exact_robot();
  robot.has_compass = false;
  SimulatedRobot sensor({}, robot, &world, {1.0, 2.0, 0.0}, 1);
  EXPECT_FALSE(drive_for(sensor, {0.1, 0.0}, 1.0).compass_rad);
}

TEST(SimulatedRobot, ClosesACircleExactly) {
  RobotModel robot = exact_robot();
  robot.max_acceleration_mps2 = 1e6;
  robot.max_turn_acceleration_radps2 = 1e6;
  const World world;
  SimulatedRobot sensor({}, robot, &world, {}, 1);
  sensor.command({0.2, 2.0 * std::numbers::pi / 10.0}, kAlways_s);
  observe(sensor);  // the tick of the jump to full speed counts half
  const Pose2 from = *observe(sensor).true_T_map_robot;
  Pose2 half;
  for (int i = 0; i < 125; ++i) half = *observe(sensor).true_T_map_robot;
  EXPECT_NEAR((half.position() - from.position()).norm(), 2.0 * 0.2 * 10.0 / (2.0 * std::numbers::pi), 1e-9);
  for (int i = 0; i < 125; ++i) half = *observe(sensor).true_T_map_robot;
  EXPECT_NEAR((half.position() - from.position()).norm(), 0.0, 1e-9);
}

TEST(SimulatedRobot, ACarTurnsNoTighterThanItCan) {
  RobotModel robot = exact_robot();
  robot.kinematics = Kinematics::car;
  robot.min_turning_radius_m = 0.5;
  const World world;
  SimulatedRobot sensor({}, robot, &world, {}, 1);
  EXPECT_NEAR(drive_for(sensor, {0.0, 1.0}, 2.0).true_T_map_robot->theta_rad, 0.0, 1e-12) << "not on the spot";
  drive_for(sensor, {0.2, 3.0}, 2.0);
  EXPECT_NEAR(sensor.twist().w_radps, 0.4, 1e-12);
}

TEST(SimulatedRobot, RefusesACommandThatIsNotFinite) {
  const World world;
  SimulatedRobot sensor({}, exact_robot(), &world, {}, 1);
  EXPECT_THROW(sensor.command({std::nan(""), 0.0}, kAlways_s), std::invalid_argument);
}

TEST(SimulatedRobot, StopsAtAWallCountsTheTouchOnceAndDrivesAway) {
  const World world = tilted_wall(1.0, 0.0);
  SimulatedRobot sensor({}, exact_robot(), &world, {}, 1);
  Witnessed seen = drive_for(sensor, {0.4, 0.0}, 5.0);
  EXPECT_TRUE(seen.bumped);
  EXPECT_NEAR(seen.true_T_map_robot->x_m, 1.0 - 0.22, 1e-6);
  EXPECT_LE(seen.true_T_map_robot->x_m, 1.0 - 0.22);
  EXPECT_EQ(sensor.collisions(), 1);
  seen = drive_for(sensor, {0.4, 0.5}, 1.0);
  EXPECT_GT(seen.true_T_map_robot->theta_rad, 0.3) << "it may turn where it stands";
  seen = drive_for(sensor, {-0.2, 0.0}, 1.0);
  EXPECT_FALSE(seen.bumped);
  EXPECT_LT(seen.true_T_map_robot->x_m, 0.7);
  drive_for(sensor, {0.4, 0.0}, 5.0);
  EXPECT_EQ(sensor.collisions(), 2);
}

TEST(SimulatedRobot, NeverJumpsAThinWallHoweverFast) {
  RobotModel robot = exact_robot();
  robot.max_v_mps = 100.0;
  robot.max_acceleration_mps2 = 1e6;
  World world = tilted_wall(3.0, 0.0);
  world.objects = {circle_at({-3.0, 0.0}, 0.02)};
  SimulatedRobot sensor({}, robot, &world, {}, 1);
  EXPECT_NEAR(drive_for(sensor, {100.0, 0.0}, 1.0).true_T_map_robot->x_m, 2.78, 1e-6);
  EXPECT_NEAR(drive_for(sensor, {-100.0, 0.0}, 1.0).true_T_map_robot->x_m, -2.77, 1e-6);
}

TEST(SimulatedRobot, NeverOverlapsAnythingOnAWildDrive) {
  const World world = furnished_room();
  const Scene scene(world);
  for (const bool with_polygon : {false, true}) {
    RobotModel robot = exact_robot();
    if (with_polygon) robot.polygon_m = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
    const Body body(robot, scene);
    SimulatedRobot sensor({}, robot, &world, {3.0, 2.5, 0.0}, 1);
    for (int i = 0; i < 300; ++i) {
      const Pose2 T_map_robot =
          *drive_for(sensor, {0.8 * std::sin(i * 1.7) + 0.2, 2.5 * std::cos(i * 2.3)}, 0.6).true_T_map_robot;
      ASSERT_GE(body.clearance_m(T_map_robot), 0.0) << i << (with_polygon ? " polygon" : " disc");
    }
    EXPECT_GT(sensor.collisions(), 3);
  }
}

TEST(SimulatedRobot, APolygonFootprintPassesWhereItsDiscWouldNot) {
  World world;
  world.walls = {testing::wall({{0, -0.15}, {3, -0.15}}), testing::wall({{0, 0.15}, {3, 0.15}})};
  RobotModel robot = exact_robot();
  robot.radius_m = 0.23;
  robot.polygon_m = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
  SimulatedRobot sensor({}, robot, &world, {0.0, 0.0, 0.0}, 1);
  Witnessed seen = drive_for(sensor, {0.4, 0.0}, 4.0);
  EXPECT_FALSE(seen.bumped);
  EXPECT_GT(seen.true_T_map_robot->x_m, 1.4);
  drive_for(sensor, {0.0, 0.0}, 1.0);
  seen = drive_for(sensor, {0.0, 1.0}, 3.0);
  EXPECT_TRUE(seen.bumped) << "too long to turn in there";
  EXPECT_LT(seen.true_T_map_robot->theta_rad, 0.4);
}

TEST(SimulatedRobot, SaysWhatTheStartOverlaps) {
  World world = furnished_room();
  const auto reason_at = [&](const Point& at_m) {
    SimulatedRobot sensor({}, exact_robot(), &world, {at_m.x(), at_m.y(), 0.0}, 1);
    const SensorStep step = sensor.next(kNoLimit);
    EXPECT_EQ(step.state, SensorState::fault);
    EXPECT_EQ(sensor.next(kNoLimit).state, SensorState::fault);
    return step.reason;
  };
  EXPECT_EQ(reason_at({0.1, 2.0}), "the robot cannot start at (0.10, 2.00) m: it would overlap wall 1");
  EXPECT_EQ(reason_at({1.5, 3.5}), "the robot cannot start at (1.50, 3.50) m: it would overlap object 1 (square)");
  EXPECT_EQ(reason_at({4.2, 1.3}), "the robot cannot start at (4.20, 1.30) m: it would overlap object 2 (a circle)");
  EXPECT_EQ(reason_at({-3.0, 2.0}), "the robot cannot start at (-3.00, 2.00) m: it lies outside the world's bounds_m");
  world.objects.push_back(square_at({3.0, 2.5}, 2.0, 0.0));
  EXPECT_THAT(reason_at({3.0, 2.5}), HasSubstr("object 3 (square)")) << "far from every face, but inside";
}

std::vector<Witnessed> wander(const RobotModel& robot, std::uint64_t seed) {
  const World world = furnished_room();
  SimulatedRobot sensor({}, robot, &world, {3.0, 2.5, 0.0}, seed);
  std::vector<Witnessed> seen;
  for (int i = 0; i < 400; ++i) {
    if (i % 50 == 0) sensor.command({0.3, 0.5 * std::sin(i)}, kAlways_s);
    seen.push_back(observe(sensor));
  }
  return seen;
}

RobotModel erring_robot() {
  RobotModel robot = pioneer();
  robot.odometry_error = {0.03, 0.02, radians(2.0)};
  robot.compass_error = {radians(2.0), radians(5.0), 2.0};
  robot.range_error = RangeError{};
  return robot;
}

bool same_bytes(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(SimulatedRobot, GivesTheSameBytesForTheSameSeedAndOthersForAnother) {
  const auto first = wander(erring_robot(), 7), again = wander(erring_robot(), 7), other = wander(erring_robot(), 8);
  bool differs = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_TRUE(same_bytes(first[i].T_odom_robot.x_m, again[i].T_odom_robot.x_m));
    EXPECT_TRUE(same_bytes(*first[i].compass_rad, *again[i].compass_rad));
    EXPECT_TRUE(same_bytes(first[i].ranges[0].range_m, again[i].ranges[0].range_m));
    EXPECT_EQ(*first[i].true_T_map_robot, *other[i].true_T_map_robot) << "the seed is in the errors only";
    differs |= first[i].T_odom_robot.x_m != other[i].T_odom_robot.x_m;
  }
  EXPECT_TRUE(differs);
}

TEST(SimulatedRobot, OneErrorLeavesTheStreamsOfTheOthersAlone) {
  RobotModel changed = erring_robot();
  changed.odometry_error.distance_ratio = 0.1;
  changed.range_error.dropped_ratio = 0.5;
  const auto before = wander(erring_robot(), 7), after = wander(changed, 7);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(*before[i].compass_rad, *after[i].compass_rad);
    if (std::isfinite(after[i].ranges[0].range_m)) {
      EXPECT_EQ(before[i].ranges[0].range_m, after[i].ranges[0].range_m) << "what is not dropped is as it was";
    }
  }
}

TEST(SimulatedRobot, AnsweredReadingsOfAFurnishedRoomAreMostlyRightAndSometimesLong) {
  const auto seen = wander(pioneer(), 1);
  int finite = 0;
  for (const Observation& o : seen) finite += std::isfinite(o.ranges[0].range_m);
  EXPECT_GT(finite, 200);
}

}  // namespace
}  // namespace cairn
