#include "plugins/pursuit_dwa/dynamic_window.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace cairn::pursuit_dwa {
namespace {

const double kNever = std::numeric_limits<double>::infinity();

// With obstacles as a list.
double free_m(const Twist& twist, const std::vector<Point>& obstacles, double reach_m) {
  return free_distance_m(twist, obstacles, reach_m);
}
WindowStep best(const Twist& now, const Wish& wish, const std::vector<Point>& obstacles, const WindowLimits& limits) {
  return best_in_window(now, wish, obstacles, limits);
}

std::vector<Point> wall(const Point& from, const Point& to) {
  std::vector<Point> points;
  const int count = static_cast<int>((to - from).norm() / 0.05) + 1;
  for (int i = 0; i <= count; ++i) points.push_back(from + (to - from) * (static_cast<double>(i) / count));
  return points;
}

void add(std::vector<Point>& points, const std::vector<Point>& more) {
  points.insert(points.end(), more.begin(), more.end());
}

TEST(FreeDistance, StraightAheadAndBack) {
  EXPECT_NEAR(free_m({0.2, 0.0}, {{1.0, 0.0}}, 0.3), 0.7, 1e-9);
  EXPECT_EQ(free_m({0.2, 0.0}, {{1.0, 0.31}}, 0.3), kNever);
  EXPECT_EQ(free_m({-0.2, 0.0}, {{1.0, 0.0}}, 0.3), kNever);
  EXPECT_NEAR(free_m({-0.2, 0.0}, {{-1.0, 0.0}}, 0.3), 0.7, 1e-9);
}

TEST(FreeDistance, WithinReachOnlyWhatComesNearerIsBlocked) {
  EXPECT_EQ(free_m({0.2, 0.0}, {{0.25, 0.0}}, 0.3), 0.0);
  EXPECT_EQ(free_m({-0.2, 0.0}, {{0.25, 0.0}}, 0.3), kNever);
  EXPECT_EQ(free_m({0.2, 0.0}, {{0.01, 0.29}}, 0.3), kNever);
}

// Against the disc's centre moved in tiny steps.
TEST(FreeDistance, AgreesWithTinyStepsOnRandomArcs) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Twist twist{0.3 * any(random), 1.5 * any(random)};
    if (std::abs(twist.v_mps) < 0.02) continue;
    const Point p(1.5 * any(random), 1.5 * any(random));
    if (p.norm() < 0.31) continue;
    double oracle_m = kNever;
    Pose2 pose;
    for (double way = 0.0; way < 1.5 && oracle_m == kNever; way += 1e-3) {
      if ((pose.position() - p).norm() < 0.3) oracle_m = way;
      const double dt = 1e-3 / std::abs(twist.v_mps);
      pose = pose * Pose2{0, 0, 0.5 * twist.w_radps * dt} * Pose2{twist.v_mps * dt, 0, 0} *
             Pose2{0, 0, 0.5 * twist.w_radps * dt};
    }
    const double way_m = free_m(twist, {p}, 0.3);
    if (oracle_m < 1.5) {
      EXPECT_NEAR(way_m, oracle_m, 0.02) << i;
    } else {
      EXPECT_GE(way_m, 1.48) << i;
    }
  }
}

TEST(DynamicWindow, TakesWhatTheFollowerPrefersInTheOpen) {
  const Wish wish{{0.25, 0.3}, {0.3, 0.1}};
  const WindowStep step = best({0.25, 0.0}, wish, {{2.0, 0.0}, {0.0, 0.5}}, {});
  EXPECT_EQ(step.target, wish.preferred);
  EXPECT_FALSE(step.blocked);
}

TEST(DynamicWindow, SteersRoundAPost) {
  const Wish wish{{0.25, 0.0}, {0.8, 0.0}};
  const WindowStep step = best({0.25, 0.0}, wish, {{0.45, 0.05}}, {});
  EXPECT_FALSE(step.blocked);
  EXPECT_LT(step.target.w_radps, -0.1) << "to the side with more room";
}

TEST(DynamicWindow, StopsBeforeAWall) {
  const Wish wish{{0.25, 0.0}, {0.8, 0.0}};
  const WindowStep step = best({0.1, 0.0}, wish, wall({0.26, -1.5}, {0.26, 1.5}), {});
  EXPECT_TRUE(step.blocked);
  EXPECT_EQ(step.target, Twist{});
}

TEST(DynamicWindow, PassesADoorOfSeventyCentimetres) {
  std::vector<Point> jambs = wall({0.6, 0.35}, {0.6, 1.5});
  add(jambs, wall({0.6, -0.35}, {0.6, -1.5}));
  for (double x_m = 0.0; x_m < 1.2; x_m += 0.05) {
    std::vector<Point> seen;
    for (const Point& p : jambs) seen.push_back(p - Point(x_m, 0.0));
    const WindowStep step = best({0.2, 0.0}, {{0.2, 0.0}, {0.4, 0.0}}, seen, {});
    EXPECT_GT(step.target.v_mps, 0.05) << "at " << x_m;
    EXPECT_LT(std::abs(step.target.w_radps), 0.2) << "at " << x_m;
  }
}

TEST(DynamicWindow, WhatItTakesIsAdmissible) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const WindowLimits limits;
  for (int i = 0; i < 500; ++i) {
    std::vector<Point> obstacles;
    for (int k = 0; k < 12; ++k) {
      const Point p(0.8 + 0.6 * any(random), any(random));
      if (p.norm() > 0.35) obstacles.push_back(p);
    }
    const Twist now{0.125 + 0.125 * any(random), 0.5 * any(random)};
    const WindowStep step = best(now, {{0.25, 0.0}, {0.5, 0.2 * any(random)}}, obstacles, limits);
    if (step.blocked) {
      EXPECT_EQ(step.target, Twist{});
      continue;
    }
    EXPECT_LE(step.target.v_mps, limits.max_v_mps + 1e-12);
    EXPECT_LE(std::abs(step.target.w_radps), limits.max_w_radps + 1e-12);
    const double v = step.target.v_mps;
    EXPECT_GE(free_m(step.target, obstacles, limits.radius_m + 0.03),
              v * v / (2.0 * limits.accelerations.forward_mps2));
  }
}

TEST(DynamicWindow, ACarKeepsItsTurningRadius) {
  WindowLimits limits;
  limits.accelerations.min_turning_radius_m = 0.6;
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  Twist now;
  for (int i = 0; i < 500; ++i) {
    const WindowStep step =
        best(now, {{0.25, 0.1}, {0.5, 0.0}}, {{0.6 + 0.2 * any(random), 0.3 * any(random)}}, limits);
    now = motion::approached(now, step.target, 0.04, limits.accelerations);
    EXPECT_LE(std::abs(now.w_radps) * 0.6, std::abs(now.v_mps) + 1e-9);
  }
}

}  // namespace
}  // namespace cairn::pursuit_dwa
