#include "framework/host/stop_layer.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cairn {
namespace {

Observation echo_ahead(double range_m, double stamp_s = 1.0, double angle_rad = 0.0) {
  Observation observation;
  observation.stamp_s = stamp_s;
  RangeReading reading;
  reading.T_robot_sensor = {0.1, 0.0, angle_rad};
  reading.half_beam_rad = radians(15.0);
  reading.min_m = 0.1;
  reading.max_m = 5.0;
  reading.range_m = range_m;
  observation.ranges = {reading};
  return observation;
}

TEST(StopLayer, LetsTheRobotGoWhenNothingIsNear) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(3.0));
  EXPECT_EQ(layer.limit({0.3, 0.1}), (Twist{0.3, 0.1}));
}

TEST(StopLayer, StopsBeforeAnEchoThatIsAsNearAsTheMargin) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(robot.radius_m + 0.05 - 0.1));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(StopLayer, AlwaysLeavesRoomToBrake) {
  const RobotModel robot;
  for (double range = 0.2; range < 2.0; range += 0.05) {
    StopLayer layer({}, robot);
    layer.see(echo_ahead(range));
    const double v = layer.limit({robot.max_v_mps, 0.0}).v_mps;
    const double way = std::max(0.0, range + 0.1 - robot.radius_m - 0.05);
    EXPECT_LE(v * v / (2.0 * robot.max_acceleration_mps2), way + 1e-9) << "range " << range;
  }
}

TEST(StopLayer, TurningInPlaceAndBackingAwayStayAllowed) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(0.12));
  EXPECT_EQ(layer.limit({0.0, 1.0}), (Twist{0.0, 1.0}));
  EXPECT_EQ(layer.limit({-0.2, 0.0}), (Twist{-0.2, 0.0}));
}

TEST(StopLayer, AnEchoBesideTheRobotDoesNotHoldItBack) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(0.5, 1.0, radians(90.0)));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(StopLayer, TooNearToMeasureCountsAsTheNearestRange) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(-std::numeric_limits<double>::infinity()));
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.0);
}

TEST(StopLayer, AnOldEchoNoLongerCounts) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(0.15, 1.0));
  Observation later = echo_ahead(std::numeric_limits<double>::infinity(), 2.5);
  later.ranges.front().sensor = 1;
  layer.see(later);
  EXPECT_EQ(layer.limit({0.3, 0.0}).v_mps, 0.3);
}

TEST(StopLayer, WithoutReadingsThereIsNoDriving) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(3.0, 1.0));
  Observation silent;
  silent.stamp_s = 2.5;
  layer.see(silent);
  EXPECT_EQ(layer.limit({0.3, 0.2}), Twist{});
}

TEST(StopLayer, KeepsToTheRobotsLimitsAndRefusesWhatIsNoNumber) {
  const RobotModel robot;
  StopLayer layer({}, robot);
  layer.see(echo_ahead(4.0));
  EXPECT_EQ(layer.limit({9.0, -9.0}), (Twist{robot.max_v_mps, -robot.max_w_radps}));
  EXPECT_EQ(layer.limit({std::numeric_limits<double>::quiet_NaN(), 0.0}), Twist{});
}

}  // namespace
}  // namespace cairn
