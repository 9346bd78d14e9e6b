#include "framework/planning/trajectory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace cairn {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kRounding = 1e-6;

RobotModel robot() {
  RobotModel robot;
  robot.max_v_mps = 0.4;
  robot.max_w_radps = 1.5;
  robot.max_acceleration_mps2 = 0.5;
  robot.max_turn_acceleration_radps2 = 3.0;
  return robot;
}

// Corner points with headings along the next piece.
std::vector<Pose2> corners(const std::vector<Point>& points) {
  std::vector<Pose2> path;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point step = i + 1 < points.size() ? Point(points[i + 1] - points[i]) : Point(points[i] - points[i - 1]);
    path.push_back({points[i].x(), points[i].y(), std::atan2(step.y(), step.x())});
  }
  return path;
}

// Curves of stated length and curvature, driven backwards where the length is negative.
struct Curve {
  double length_m = 0.0;
  double curvature = 0.0;
};
std::vector<Pose2> sampled(const std::vector<Curve>& curves, double step_m) {
  std::vector<Pose2> path{{}};
  for (const Curve& curve : curves) {
    const int steps = std::max(1, static_cast<int>(std::abs(curve.length_m) / step_m));
    const double s_m = curve.length_m / steps;
    for (int i = 0; i < steps; ++i) {
      const Pose2 at = path.back();
      const double half_rad = 0.5 * s_m * curve.curvature;
      const double chord_m = half_rad == 0.0 ? s_m : s_m * std::sin(half_rad) / half_rad;
      path.push_back({at.x_m + chord_m * std::cos(at.theta_rad + half_rad),
                      at.y_m + chord_m * std::sin(at.theta_rad + half_rad), wrap_angle(at.theta_rad + 2.0 * half_rad)});
    }
  }
  return path;
}

// Limits, strictly growing times, and that the speeds say how the poses move.
void expect_drivable(const std::vector<TrajectoryPoint>& points, const RobotModel& robot, double heading_rad = 1e-6) {
  ASSERT_FALSE(points.empty());
  for (const TrajectoryPoint* end : {&points.front(), &points.back()}) {
    EXPECT_NEAR(end->v_mps, 0.0, 1e-12);
    EXPECT_NEAR(end->w_radps, 0.0, 1e-12);
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    const TrajectoryPoint& a = points[i - 1];
    const TrajectoryPoint& b = points[i];
    const double dt = b.time_s - a.time_s;
    ASSERT_GT(dt, 0.0) << i;
    EXPECT_LE(std::abs(b.v_mps), robot.max_v_mps + kRounding);
    EXPECT_LE(std::abs(b.w_radps), robot.max_w_radps + kRounding);
    EXPECT_LE(std::abs(b.v_mps - a.v_mps) / dt, robot.max_acceleration_mps2 + kRounding) << i;
    EXPECT_LE(std::abs(b.w_radps - a.w_radps) / dt, robot.max_turn_acceleration_radps2 + kRounding) << i;
    const Point step = b.pose.position() - a.pose.position();
    const double way_m = 0.5 * std::abs(a.v_mps + b.v_mps) * dt;
    const double half_rad = 0.5 * std::abs(wrap_angle(b.pose.theta_rad - a.pose.theta_rad));
    EXPECT_LE(step.norm(), way_m + 1e-9) << i;
    EXPECT_GE(step.norm(), way_m * (half_rad < 1e-9 ? 1.0 : std::sin(half_rad) / half_rad) - 1e-9) << i;
    EXPECT_NEAR(wrap_angle(b.pose.theta_rad - a.pose.theta_rad), 0.5 * (a.w_radps + b.w_radps) * dt, heading_rad) << i;
  }
}

TEST(Trajectory, AStraightWayIsATrapezoid) {
  const std::vector<TrajectoryPoint> points = trajectory_of(corners({{0, 0}, {2, 0}}), robot());
  expect_drivable(points, robot());
  ASSERT_EQ(points.size(), 4U);
  EXPECT_NEAR(points[1].time_s, 0.8, 1e-12);
  EXPECT_NEAR(points[1].pose.x_m, 0.16, 1e-12);
  EXPECT_NEAR(points[2].v_mps, 0.4, 1e-12);
  EXPECT_NEAR(points[3].time_s, 2.0 / 0.4 + 0.8, 1e-12);
}

TEST(Trajectory, AShortWayNeverReachesFullSpeed) {
  const std::vector<TrajectoryPoint> points = trajectory_of(corners({{0, 0}, {0.08, 0}}), robot());
  expect_drivable(points, robot());
  ASSERT_EQ(points.size(), 3U);
  EXPECT_NEAR(points[1].v_mps, 0.2, 1e-12);
  EXPECT_NEAR(points[2].time_s, 0.8, 1e-12);
}

TEST(Trajectory, ACornerIsTurnedOnTheSpot) {
  const std::vector<TrajectoryPoint> points = trajectory_of(corners({{0, 0}, {2, 0}, {2, 2}}), robot());
  expect_drivable(points, robot());
  const double turn_s = std::numbers::pi / 2.0 / 1.5 + 1.5 / 3.0;
  EXPECT_NEAR(points.back().time_s, 2.0 * 5.8 + turn_s, 1e-9);
  for (const TrajectoryPoint& point : points)
    EXPECT_TRUE(point.w_radps == 0.0 || point.pose.position() == Point(2, 0)) << point.time_s;
}

TEST(Trajectory, AnArcIsDrivenOnItsCircleHoweverFewItsPoses) {
  RobotModel car = robot();
  car.kinematics = Kinematics::car;
  car.min_turning_radius_m = 0.5;
  for (const double step_m : {0.04, 0.3}) {
    const std::vector<TrajectoryPoint> points = trajectory_of(sampled({{1.5, 2.0}}, step_m), car);
    expect_drivable(points, car);
    for (const TrajectoryPoint& point : points) {
      EXPECT_NEAR((point.pose.position() - Point(0.0, 0.5)).norm(), 0.5, 1e-9) << point.time_s;
      EXPECT_NEAR(point.w_radps * car.min_turning_radius_m, point.v_mps, 1e-9) << point.time_s;
      EXPECT_NEAR(point.pose.x_m, 0.5 * std::sin(point.pose.theta_rad), 1e-9) << point.time_s;
    }
  }
}

TEST(Trajectory, TheFirstAndLastHeadingAreTurnedTo) {
  std::vector<Pose2> path = corners({{0, 0}, {1, 0}});
  path.back().theta_rad = radians(90.0);
  const std::vector<TrajectoryPoint> points = trajectory_of(path, robot());
  expect_drivable(points, robot());
  EXPECT_EQ(points.front().pose, path.front());
  EXPECT_NEAR(points.back().pose.theta_rad, radians(90.0), 1e-12);
}

TEST(Trajectory, AnArcIsDrivenThroughAsFastAsItsCurvatureAllows) {
  const std::vector<Pose2> path = sampled({{6.0, 5.0}}, 0.02);
  const std::vector<TrajectoryPoint> points = trajectory_of(path, robot());
  expect_drivable(points, robot(), 1e-3);
  const double fastest = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
                           return a.v_mps < b.v_mps;
                         })->v_mps;
  EXPECT_NEAR(fastest, 1.5 / 5.0, 1e-3) << "max_w / curvature";
  EXPECT_NEAR(points.back().time_s, 6.0 / 0.3 + 0.3 / 0.5, 0.01) << "without a stop";
}

TEST(Trajectory, BackwardsIsBackwardsAndACuspStops) {
  const std::vector<TrajectoryPoint> points =
      trajectory_of(sampled({{1.0, 1.0}, {-1.0, -1.0}, {0.5, 0.0}}, 0.05), robot());
  expect_drivable(points, robot(), 0.02);
  int stops = 0;
  bool backwards = false;
  for (const TrajectoryPoint& point : points) {
    stops += point.v_mps == 0.0;
    backwards = backwards || point.v_mps < -0.3;
  }
  EXPECT_EQ(stops, 4) << "two ends and two cusps";
  EXPECT_TRUE(backwards);
}

TEST(Trajectory, KeepsTheLimitsOnRandomPaths) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    RobotModel model = robot();
    model.max_v_mps = 0.1 + 2.0 * unit(random);
    model.max_w_radps = 0.2 + 3.0 * unit(random);
    model.max_acceleration_mps2 = 0.1 + 2.0 * unit(random);
    model.max_turn_acceleration_radps2 = 0.2 + 5.0 * unit(random);
    std::vector<Pose2> path;
    if (seed % 2 == 0) {
      std::vector<Point> points;
      for (int i = 0; i < 12; ++i)
        points.emplace_back(5.0 * unit(random), 5.0 * unit(random) * (i % 3 == 0 ? 0.001 : 1));
      path = corners(points);
    } else {
      std::vector<Curve> curves;
      for (int i = 0; i < 8; ++i)
        curves.push_back({(random() % 4 == 0 ? -1.0 : 1.0) * (0.2 + 2.0 * unit(random)), 4.0 * unit(random) - 2.0});
      path = sampled(curves, 0.01 + 0.05 * unit(random));
    }
    const std::vector<TrajectoryPoint> points = trajectory_of(path, model);
    // Where the curvature jumps, w cannot: the heading is off by a part of one step's turn.
    expect_drivable(points, model, seed % 2 == 0 ? 0.02 : 0.15);
    EXPECT_NEAR(wrap_angle(points.back().pose.theta_rad - path.back().theta_rad), 0.0, 1e-9);
    EXPECT_LT((points.back().pose.position() - path.back().position()).norm(), 1e-8);
  }
}

TEST(Trajectory, ACarDrivesThroughEverything) {
  RobotModel car = robot();
  car.kinematics = Kinematics::car;
  const std::vector<TrajectoryPoint> points = trajectory_of(corners({{0, 0}, {2, 0}, {3, 0.8}, {5, 0.8}}), car);
  const auto turns_on_the_spot = [](const TrajectoryPoint& p) { return p.v_mps == 0.0 && p.w_radps != 0.0; };
  EXPECT_TRUE(std::none_of(points.begin(), points.end(), turns_on_the_spot));
  EXPECT_EQ(std::count_if(points.begin(), points.end(), [](const auto& p) { return p.v_mps == 0.0; }), 2);
}

TEST(Trajectory, OfNothingIsNothingAndOfAPlaceIsThere) {
  EXPECT_TRUE(trajectory_of({}, robot()).empty());
  EXPECT_EQ(trajectory_of({{1.0, 2.0, 0.5}}, robot()).size(), 1U);
  EXPECT_EQ(trajectory_of({{1.0, 2.0, 0.5}, {1.0, 2.0, 0.5}}, robot()).size(), 1U);
}

TEST(Trajectory, BadLimitsAndPosesAreRefused) {
  RobotModel lame = robot();
  lame.max_w_radps = 0.0;
  EXPECT_THAT([&] { (void)trajectory_of({{}}, lame); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("max_w_radps must be above 0")));
  EXPECT_THAT(
      [&] {
        (void)trajectory_of({{}, {std::nan(""), 0.0, 0.0}}, robot());
      },
      ThrowsMessage<std::invalid_argument>(HasSubstr("pose 1 is not finite")));
}

}  // namespace
}  // namespace cairn
