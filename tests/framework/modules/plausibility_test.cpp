#include "framework/modules/plausibility.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/framework/modules/test_clock.hpp"

namespace cairn {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Observation at(double stamp_s, double x_m) {
  Observation observation;
  observation.stamp_s = stamp_s;
  observation.T_odom_robot = {x_m, 0.0, 0.0};
  return observation;
}

// Of the second of two observations; the robot drives 0.5 m/s at most.
std::string second_after(const Observation& first, const Observation& second) {
  RobotModel robot;
  robot.max_v_mps = 0.5;
  ObservationCheck check(robot);
  EXPECT_EQ(check.fault_of(first), "");
  return check.fault_of(second);
}

TEST(ObservationCheck, NumbersThatAreNoneAreAFaultOfTheFirstToo) {
  ObservationCheck check{RobotModel{}};
  EXPECT_EQ(check.fault_of(at(kNan, 0.0)), "returned a stamp or an odometry that is not finite");
  EXPECT_EQ(check.fault_of(at(0.0, kNan)), "returned a stamp or an odometry that is not finite");
  EXPECT_EQ(check.fault_of(at(1.7e9, -3e4)), "") << "clocks and odometry begin anywhere";
}

TEST(ObservationCheck, WhatARobotCanDoIsNoFault) {
  EXPECT_EQ(second_after(at(10.0, 0.0), at(10.04, 0.02)), "");
  EXPECT_EQ(second_after(at(10.0, 0.0), at(10.0, 0.0)), "") << "two readings of one moment";
  EXPECT_EQ(second_after(at(10.0, 0.0), at(3610.0, 900.0)), "") << "an hour's gap in a log";
  EXPECT_EQ(second_after(at(10.0, 8.0), at(10.1, 0.0)), "") << "odometry that begins again";
}

TEST(ObservationCheck, AnOdometryThatLeapsIsAFault) {
  EXPECT_EQ(second_after(at(10.0, 0.0), at(10.5, 50.0)), "returned an odometry that leaps by 50 m within 0.5 s");
  EXPECT_NE(second_after(at(10.0, -1e300), at(10.5, 1e300)), "");
}

TEST(ObservationCheck, AClockThatLeapsIsAFault) {
  EXPECT_EQ(second_after(at(10.0, 0.0), at(9.5, 0.0)), "") << "jitter";
  EXPECT_EQ(second_after(at(10.0, 0.0), at(5.0, 0.0)), "returned a stamp of 5 s after one of 10 s");
  EXPECT_NE(second_after(at(10.0, 0.0), at(1e9, 0.0)), "");
}

// Of a robot that is driven at 0.5 m/s and 1 rad/s at most.
ObservationCheck live_check(std::shared_ptr<const WallClock> clock) {
  RobotModel robot;
  robot.max_v_mps = 0.5;
  robot.max_w_radps = 1.0;
  ObservationCheck check(robot, std::move(clock));
  check.expect_live();
  return check;
}

// Of the second of two observations; here_s passes meanwhile.
std::string second_live(const Observation& first, const Observation& second, double here_s = 0.04) {
  const auto clock = std::make_shared<TestClock>();
  ObservationCheck check = live_check(clock);
  EXPECT_EQ(check.fault_of(first), "");
  clock->advance(std::chrono::nanoseconds(std::llround(1e9 * here_s)));
  return check.fault_of(second);
}

TEST(LiveObservationCheck, WhatARobotCanDoIsNoFault) {
  EXPECT_EQ(second_live(at(10.0, 0.0), at(10.04, 0.5)), "") << "bumped, or slipped";
  EXPECT_EQ(second_live(at(10.0, 0.0), at(10.0, 0.0)), "") << "two readings of one moment";
  EXPECT_EQ(second_live(at(10.0, 0.0), at(14.0, 3.0)), "") << "four seconds without a reading";
}

TEST(LiveObservationCheck, AnOdometryThatLeapsIsAFault) {
  EXPECT_EQ(second_live(at(10.0, 0.0), at(10.04, 9.0)), "returned an odometry that leaps by 9 m within 0.04 s");
  EXPECT_NE(second_live(at(10.0, 0.0), at(10.0, 0.51)), "");
}

// At how many steps of 0.04 s the fault is found; 100: at none.
int step_of_fault(double x_m_a_step, double turn_rad_a_step) {
  const auto clock = std::make_shared<TestClock>();
  ObservationCheck check = live_check(clock);
  for (int step = 0; step < 100; ++step) {
    Observation observation = at(10.0 + 0.04 * step, x_m_a_step * step);
    observation.T_odom_robot.theta_rad = wrap_angle(turn_rad_a_step * step);
    if (!check.fault_of(observation).empty()) return step;
    clock->advance(std::chrono::milliseconds(40));
  }
  return 100;
}

TEST(LiveObservationCheck, AnOdometryThatGoesOnBeingTooFastIsAFaultToo) {
  EXPECT_EQ(step_of_fault(0.45, 0.0), 2) << "11 m/s";
  EXPECT_EQ(step_of_fault(0.0, 0.9), 2);
  EXPECT_LT(step_of_fault(0.15, 0.0), 25) << "3.75 m/s";
  EXPECT_EQ(step_of_fault(0.06, 0.12), 100) << "three times what the robot can do";
}

TEST(ObservationCheck, ACompassThatIsNoNumberIsAFault) {
  Observation observation = at(10.0, 0.0);
  observation.compass_rad = kNan;
  EXPECT_EQ(ObservationCheck(RobotModel{}).fault_of(observation), "returned a compass heading that is not finite");
}

TEST(LiveObservationCheck, AnOdometryThatTurnsTooFastIsAFault) {
  Observation turned = at(10.04, 0.0);
  turned.T_odom_robot.theta_rad = 3.0;
  EXPECT_EQ(second_live(at(10.0, 0.0), turned), "returned an odometry that turns by 172 degrees within 0.04 s");
  turned.T_odom_robot.theta_rad = 6.28;
  EXPECT_EQ(second_live(at(10.0, 0.0), turned), "") << "the same heading";
  turned.T_odom_robot.theta_rad = 3.0;
  turned.stamp_s = 11.0;
  EXPECT_EQ(second_live(at(10.0, 0.0), turned), "");
}

TEST(LiveObservationCheck, AClockThatLeapsIsAFault) {
  EXPECT_EQ(second_live(at(10.0, 0.0), at(9.1, 0.0)), "returned a stamp of 9.1 s after one of 10 s");
  EXPECT_EQ(second_live(at(10.0, 0.0), at(3610.0, 0.0)), "returned a stamp of 3610 s after one of 10 s");
  EXPECT_EQ(second_live(at(10.0, 0.0), at(3610.0, 0.0), 3600.0), "") << "the process was stopped for an hour";
}

TEST(Plausibility, APoseFarFromEveryMapIsAFault) {
  PoseEstimate pose;
  EXPECT_EQ(fault_of(pose), "");
  pose.T_map_robot.y_m = -2e5;
  EXPECT_EQ(fault_of(pose), "returned a pose 200000 m from the map's origin, 100000 m are allowed");
  pose.T_map_robot.y_m = 7e3;
  EXPECT_EQ(fault_of(pose, 6.5e3), "returned a pose 7000 m from the map's origin, 6500 m are allowed")
      << "where no grid has cells";
  pose = {};
  pose.covariance(2, 2) = kNan;
  EXPECT_EQ(fault_of(pose), "returned a pose that is not finite");
}

TEST(Plausibility, ADetectionOutsideOfTheMapIsAFault) {
  OccupancyGrid grid(0.1);
  grid.set_log_odds({0, 0}, LogOdds{-500});
  grid.set_log_odds({50, 40}, LogOdds{500});
  Matching matching;
  EXPECT_EQ(fault_of(matching, grid), "") << "nothing was found";
  matching.detection = Detection{"square", {5.5, 4.5, 0.0}, 0.9, {}};
  EXPECT_EQ(fault_of(matching, grid), "") << "at the rim";
  matching.detection->T_map_landmark.x_m = 3000.0;
  EXPECT_EQ(fault_of(matching, grid), "returned a detection at (3000, 4.5), which is outside of the map");
  matching.detection->T_map_landmark.x_m = kNan;
  EXPECT_EQ(fault_of(matching, grid), "returned a detection that is not finite");
  matching.detection = Detection{"square", {5.5, 4.5, 0.0}, 0.9, {{"square", 0.0, 0.9}, {"square", kNan, 0.8}}};
  EXPECT_EQ(fault_of(matching, grid), "returned a detection that is not finite") << "of any template";
  matching.detection.reset();
  matching.templates = {{"square", 0.0, kNan}};
  EXPECT_EQ(fault_of(matching, grid), "returned a detection that is not finite");
}

TEST(Plausibility, AMarkerFartherThanAnyCameraSeesIsAFault) {
  MarkerSighting sighting;
  sighting.pose.covariance.setIdentity();
  sighting.pose.T_robot_marker = {20.0, 0.0, 0.0};
  EXPECT_EQ(fault_of(sighting), "");
  sighting.mirrored = sighting.pose;
  sighting.mirrored->T_robot_marker.x_m = 5000.0;
  EXPECT_EQ(fault_of(sighting), "returned a marker 5000 m away");
}

TEST(Plausibility, APathThatIsNoneIsAFault) {
  PlanResult plan;
  plan.path = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  plan.cost_m = plan.length_m = 1.0;
  EXPECT_EQ(fault_of(plan), "");
  plan.outcome = PlanOutcome::solved;
  EXPECT_EQ(fault_of(plan), "");
  plan.path.back().theta_rad = kNan;
  EXPECT_EQ(fault_of(plan), "returned a path that is not finite, or leads farther than 1e+09 m");
  plan.path.back() = {1e300, 0.0, 0.0};
  EXPECT_NE(fault_of(plan), "");
  plan.path.pop_back();
  plan.cost_m = -1.0;
  EXPECT_EQ(fault_of(plan), "returned a path of less than no length or cost");
  plan.path.clear();
  plan.cost_m = std::numeric_limits<double>::infinity();
  EXPECT_NE(fault_of(plan), "");
  plan.outcome = PlanOutcome::no_route;
  EXPECT_EQ(fault_of(plan), "") << "there is none";
}

TEST(Plausibility, ATrueRobotIsSomewhere) {
  EXPECT_EQ(fault_of(GroundTruth{}), "");
  EXPECT_EQ(fault_of(GroundTruth{{0.0, kNan, 0.0}}), "returned a true place that is not finite");
}

TEST(Plausibility, ALoopThatCannotBeIsAFault) {
  LoopProposal good;
  good.T_submap_node = {3.0, -2.0, 1.0};
  EXPECT_EQ(fault_of(good, 1), "");
  EXPECT_EQ(fault_of(good, 0), "proposed a loop with submap 1 of 0");
  LoopProposal bad = good;
  bad.T_submap_node.theta_rad = kNan;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop that is not finite");
  bad = good;
  bad.score = kNan;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop that is not finite");
  bad.score = 1.5;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop with a score of 1.5, which is not within 0 to 1");
  bad.score = -0.1;
  EXPECT_NE(fault_of(bad, 1), "");
  bad = good;
  bad.T_submap_node.x_m = 1e9;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop over 1e+09 m");
  bad = good;
  bad.information(0, 0) = -1.0;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop whose information is none");
  bad = good;
  bad.information(0, 1) = 0.5;
  EXPECT_EQ(fault_of(bad, 1), "proposed a loop whose information is none");
}

}  // namespace
}  // namespace cairn
