#include "plugins/scan_to_map/scan_to_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cairn::scan_to_map {
namespace {

KnownMap nothing_known() {
  static const OccupancyGrid grid(0.05);
  static const LandmarkGraph landmarks;
  return {grid, landmarks};
}

constexpr double kWidth_m = 3.0;  // a room from (0, 0), with a box in its north-east corner
constexpr double kHeight_m = 2.0;
constexpr double kBox_m = 0.5;

// How far a ray goes in the room.
double range_in_room(const Point& from_m, double bearing_rad) {
  double nearest_m = std::numeric_limits<double>::infinity();
  const Point way(std::cos(bearing_rad), std::sin(bearing_rad));
  const auto wall = [&](int axis, double at_m, double low_m, double high_m) {
    const double range_m = (at_m - from_m[axis]) / way[axis];
    const double beside_m = from_m[1 - axis] + range_m * way[1 - axis];
    if (range_m > 0.0 && beside_m >= low_m && beside_m <= high_m) nearest_m = std::min(nearest_m, range_m);
  };
  wall(0, 0.0, 0.0, kHeight_m);
  wall(0, kWidth_m, 0.0, kHeight_m);
  wall(1, 0.0, 0.0, kWidth_m);
  wall(1, kHeight_m, 0.0, kWidth_m);
  wall(0, kWidth_m - kBox_m, kHeight_m - kBox_m, kHeight_m);
  wall(1, kHeight_m - kBox_m, kWidth_m - kBox_m, kWidth_m);
  return nearest_m;
}

Observation scan(const Pose2& T_map_robot, const Pose2& T_odom_robot, double range_offset_m = 0.0) {
  Observation seen;
  seen.T_odom_robot = T_odom_robot;
  for (int degree = -120; degree < 120; ++degree) {
    RangeReading reading;
    reading.T_robot_sensor = {0.05, 0.0, radians(degree)};
    reading.min_m = 0.02;
    reading.max_m = 10.0;
    const Pose2 T_map_sensor = T_map_robot * reading.T_robot_sensor;
    reading.range_m = range_in_room(T_map_sensor.position(), T_map_sensor.theta_rad) + range_offset_m;
    seen.ranges.push_back(reading);
  }
  return seen;
}

const Pose2 kStart{0.6, 0.6, 0.2};

// Drives in a circle through the room; the odometry turns 10 % too far and goes 5 % too far. How far off it is
// at the end.
double error_after_a_round(ScanToMap& localizer, double range_offset_m = 0.0) {
  Pose2 T_map_robot = kStart;
  Pose2 T_odom_robot;
  double worst_m = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Pose2 estimate =
        localizer.update(scan(T_map_robot, T_odom_robot, range_offset_m), nothing_known()).T_map_robot;
    worst_m = std::max(worst_m, (estimate.position() - T_map_robot.position()).norm());
    T_map_robot = T_map_robot * Pose2{0.03, 0.0, radians(3.6)};
    T_odom_robot = T_odom_robot * Pose2{0.03 * 1.05, 0.0, radians(3.6) * 1.1};
  }
  return worst_m;
}

Config blind() {
  Config config;
  config.min_pairs = 100000;
  return config;
}

TEST(ScanToMap, ScansTakeBackWhatOdometryDrifts) {
  ScanToMap by_odometry(blind(), RobotModel{}, kStart);
  EXPECT_GT(error_after_a_round(by_odometry), 0.1) << "otherwise this test shows nothing";
  ScanToMap by_scans({}, RobotModel{}, kStart);
  EXPECT_LT(error_after_a_round(by_scans), 0.02);
}

TEST(ScanToMap, ItsOwnRangeOffsetIsAddedToTheEchoes) {
  Config config;
  config.range_offset_m = -0.1;
  ScanToMap corrected(config, RobotModel{}, kStart);
  EXPECT_LT(error_after_a_round(corrected, 0.1), 0.02);
}

TEST(ScanToMap, BeginsWhereTheMissionSaysWhateverTheOdometrysOrigin) {
  ScanToMap at({}, RobotModel{}, kStart);
  EXPECT_EQ(at.update(scan(kStart, {100.0, -50.0, 2.0}), nothing_known()).T_map_robot, kStart);
}

TEST(ScanToMap, WideBeamsAndLostEchoesLeaveOdometryAlone) {
  ScanToMap at({}, RobotModel{}, kStart);
  Pose2 T_odom_robot;
  PoseEstimate estimate;
  for (int i = 0; i < 10; ++i) {
    Observation seen = scan(kStart, T_odom_robot);  // the scans stand still, the odometry does not
    for (std::size_t k = 0; k < seen.ranges.size(); ++k) {
      seen.ranges[k].half_beam_rad = k % 2 == 0 ? radians(15.0) : 0.0;
      if (k % 2 == 1) seen.ranges[k].range_m = k % 4 == 1 ? std::nan("") : std::numeric_limits<double>::infinity();
    }
    estimate = at.update(seen, nothing_known());
    T_odom_robot = T_odom_robot * Pose2{0.1, 0.0, 0.0};
  }
  EXPECT_NEAR((inverse(kStart) * estimate.T_map_robot).x_m, 0.9, 1e-9);
}

TEST(ScanToMap, AScanOfAnotherPlaceNeitherMovesThePoseNorJoinsTheMap) {
  Config config;
  config.pair_m = 5.0;
  config.min_distance_ratio = 0.001;
  config.min_heading_rad_per_m = radians(0.1);
  ScanToMap at(config, RobotModel{}, kStart);
  for (int i = 0; i < 5; ++i) (void)at.update(scan(kStart, {}), nothing_known());
  const Pose2 elsewhere{0.75, 0.7, 0.35};
  const Pose2 after = at.update(scan(elsewhere, {}), nothing_known()).T_map_robot;
  EXPECT_LT((after.position() - kStart.position()).norm(), 1e-3) << "the robot has not moved, its wheels say";
  EXPECT_LT((at.update(scan(kStart, {}), nothing_known()).T_map_robot.position() - kStart.position()).norm(), 1e-3);
}

TEST(ScanToMap, AgreementWithTheMapIsNoCertaintyOfThePlace) {
  ScanToMap at({}, RobotModel{}, kStart);
  const PoseEstimate first = at.update(scan(kStart, {}), nothing_known());
  EXPECT_GE(first.covariance(0, 0), 0.01 * 0.01);
  (void)error_after_a_round(at);
  const PoseEstimate last = at.update(scan(kStart, {}), nothing_known());
  EXPECT_GT(last.covariance(0, 0), first.covariance(0, 0));
}

}  // namespace
}  // namespace cairn::scan_to_map
