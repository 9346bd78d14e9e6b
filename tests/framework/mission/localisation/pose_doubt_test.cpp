#include "framework/mission/localisation/pose_doubt.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace cairn {
namespace {

constexpr double kWidth_m = 6.0;
constexpr double kDepth_m = 4.0;
constexpr double kHalfBeam_rad = 0.2;

// A room with its lower left corner in the origin.
OccupancyGrid room() {
  OccupancyGrid grid(0.05);
  for (int y = -1; y <= 80; ++y)
    for (int x = -1; x <= 120; ++x) {
      const bool is_wall = x < 0 || y < 0 || x == 120 || y == 80;
      grid.set_log_odds({x, y}, log_odds_of(is_wall ? 0.95 : 0.05));
    }
  return grid;
}

RobotModel robot(bool has_compass) {
  RobotModel robot;
  robot.has_compass = has_compass;
  return robot;
}

// What a beam gets from the walls of the room: the nearest point in it.
double range_in_room(const Pose2& T_map_sensor) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (int i = -10; i <= 10; ++i) {
    const double bearing_rad = T_map_sensor.theta_rad + kHalfBeam_rad * i / 10.0;
    const double cos = std::cos(bearing_rad);
    const double sin = std::sin(bearing_rad);
    const double x_m = cos > 0 ? (kWidth_m - T_map_sensor.x_m) / cos : -T_map_sensor.x_m / std::min(cos, -1e-9);
    const double y_m = sin > 0 ? (kDepth_m - T_map_sensor.y_m) / sin : -T_map_sensor.y_m / std::min(sin, -1e-9);
    nearest_m = std::min({nearest_m, x_m, y_m});
  }
  return nearest_m;
}

RangeReading reading(double bearing_rad, double range_m) {
  RangeReading reading;
  reading.T_robot_sensor = {0.0, 0.0, bearing_rad};
  reading.half_beam_rad = kHalfBeam_rad;
  reading.min_m = 0.2;
  reading.max_m = 5.0;
  reading.range_m = range_m;
  return reading;
}

// Of a ring of eight sonars there, in the room.
Observation seen_from(const Pose2& T_room_robot) {
  Observation seen;
  for (int i = 0; i < 8; ++i) {
    const double bearing_rad = radians(45.0 * i);
    seen.ranges.push_back(reading(bearing_rad, range_in_room(T_room_robot * Pose2{0.0, 0.0, bearing_rad})));
  }
  return seen;
}

// Drives 3 m along the room, seeing it from that far beside where it believes to be; how far until there is a doubt.
std::optional<double> doubted_after_m(PoseDoubt& doubt, const Pose2& T_believed_true) {
  const OccupancyGrid map = room();
  for (double x_m = 1.0; x_m <= 4.0; x_m += 0.05) {
    const Pose2 believed{x_m, 1.5, 0.0};
    Observation seen = seen_from(believed * T_believed_true);
    seen.T_odom_robot = believed;
    if (doubt.update(seen, believed, map)) return x_m - 1.0;
  }
  return std::nullopt;
}

TEST(MapAnswer, OfAnEcho) {
  const OccupancyGrid map = room();
  const Pose2 at{2.0, 2.0, 0.0};
  EXPECT_EQ(answer_of(map, at, reading(radians(90.0), 2.0)), MapAnswer::agrees) << "the wall";
  EXPECT_EQ(answer_of(map, at, reading(radians(90.0), 1.9)), MapAnswer::agrees) << "a little off";
  EXPECT_EQ(answer_of(map, at, reading(radians(90.0), 1.2)), MapAnswer::contradicts) << "in the open";
  EXPECT_EQ(answer_of(map, at, reading(radians(90.0), 3.0)), MapAnswer::contradicts) << "from behind the wall";
  EXPECT_EQ(answer_of(map, at, reading(radians(90.0), std::numeric_limits<double>::infinity())), MapAnswer::unknown);
  EXPECT_EQ(answer_of(map, {20.0, 2.0, 0.0}, reading(0.0, 1.0)), MapAnswer::unknown) << "nothing is known there";
}

TEST(PoseDoubt, NoneWhereTheReadingsFit) {
  PoseDoubt doubt(robot(false));
  EXPECT_FALSE(doubted_after_m(doubt, {0.05, -0.05, 0.02}));
  EXPECT_TRUE(doubt.is_quiet());
  EXPECT_LT(doubt.contradicted_ratio(), 0.05);
}

TEST(PoseDoubt, ComesWithinTwoMetresWhereTheyDoNot) {
  PoseDoubt doubt(robot(false));
  const auto after_m = doubted_after_m(doubt, {0.5, 1.2, 1.0});
  ASSERT_TRUE(after_m);
  EXPECT_LE(*after_m, 2.0);
  EXPECT_FALSE(doubt.is_quiet());
  doubt.reset();
  EXPECT_TRUE(doubt.is_quiet()) << "it needs new evidence";
}

TEST(PoseDoubt, NeedsMoreAfterDoubtsThatWereWrong) {
  PoseDoubt doubt(robot(false));
  const Pose2 off{0.5, 1.2, 1.0};
  const auto at_first_m = doubted_after_m(doubt, off);
  ASSERT_TRUE(at_first_m);
  const double ratio = doubt.contradicted_ratio();
  for (int i = 0; i < 10; ++i) doubt.was_wrong();
  doubt.reset();
  const auto later_m = doubted_after_m(doubt, off);
  ASSERT_TRUE(later_m) << "a robot that was carried is doubted all the same";
  EXPECT_GE(*later_m, *at_first_m);
  EXPECT_GE(doubt.contradicted_ratio(), 0.35);
  EXPECT_GE(ratio, 0.15);
}

TEST(PoseDoubt, OnePersonInTheRoomIsNone) {
  const OccupancyGrid map = room();
  PoseDoubt doubt(robot(false));
  for (double x_m = 1.0; x_m <= 4.0; x_m += 0.05) {
    const Pose2 at{x_m, 2.0, 0.0};
    Observation seen = seen_from(at);
    seen.T_odom_robot = at;
    // Walks beside the robot for a third of its way, before one sonar.
    if (x_m > 2.0 && x_m < 3.0) seen.ranges[2].range_m = 1.0;
    EXPECT_FALSE(doubt.update(seen, at, map)) << "at " << x_m;
  }
}

TEST(PoseDoubt, WhereTheEstimateJumps) {
  const OccupancyGrid map = room();
  PoseDoubt doubt(robot(false));
  const Observation seen = seen_from({2.0, 2.0, 0.0});
  EXPECT_FALSE(doubt.update(seen, {2.0, 2.0, 0.0}, map));
  EXPECT_FALSE(doubt.update(seen, {2.2, 2.0, 0.0}, map)) << "corrections are no jumps";
  EXPECT_EQ(doubt.update(seen, {2.2, 2.0, 0.5}, map), DoubtCause::jump);
  EXPECT_EQ(doubt.update(seen, {2.2, 2.0, 0.5}, map), DoubtCause::jump) << "until it is reset";
}

TEST(PoseDoubt, WaitsUntilTheCompassAgrees) {
  const OccupancyGrid map = room();
  PoseDoubt doubt(robot(true));
  Observation seen = seen_from({2.0, 2.0, 0.0});
  seen.compass_rad = 1.5;
  EXPECT_FALSE(doubt.update(seen, {2.0, 2.0, 0.0}, map));
  EXPECT_FALSE(doubt.update(seen, {2.0, 2.5, 0.0}, map)) << "a map of its own that begins now would bend";
  EXPECT_EQ(doubt.update(seen, {2.0, 2.5, 1.5}, map), DoubtCause::jump);
}

}  // namespace
}  // namespace cairn
