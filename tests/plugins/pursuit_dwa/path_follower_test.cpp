#include "plugins/pursuit_dwa/path_follower.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cairn::pursuit_dwa {
namespace {

struct Driven {
  Pose2 end;
  double seconds = 0.0;
  double worst_off_m = 0.0;
  double fastest_mps = 0.0;
  bool arrived = false;
};

Driven drive(Pose2 pose, const std::vector<Point>& path, const FollowLimits& limits, double at_most_s = 120.0) {
  Driven run;
  PathProgress state;
  while (run.seconds < at_most_s) {
    const FollowStep step = follow(pose, path, state, limits);
    state = step.state;
    if (step.arrived) {
      run.arrived = true;
      break;
    }
    run.worst_off_m = std::max(run.worst_off_m, step.off_path_m);
    run.fastest_mps = std::max(run.fastest_mps, std::abs(step.wanted.v_mps));
    pose = pose * Pose2{step.wanted.v_mps * 0.04, 0.0, step.wanted.w_radps * 0.04};
    run.seconds += 0.04;
  }
  run.end = pose;
  return run;
}

std::vector<Point> circle(double radius_m, int points) {
  std::vector<Point> path;
  for (int i = 0; i <= points; ++i) {
    const double a = 2.0 * std::numbers::pi * i / points;
    path.push_back({radius_m * std::cos(a), radius_m * std::sin(a)});
  }
  return path;
}

TEST(PathFollower, DrivesAStraightLineToItsEnd) {
  const Driven run = drive({0, 0, 0}, {{0, 0}, {2, 0}}, {});
  EXPECT_TRUE(run.arrived);
  EXPECT_NEAR(run.end.x_m, 2.0, 0.07);
  EXPECT_NEAR(run.seconds, 10.0, 2.0);
}

TEST(PathFollower, TurnsInPlaceWhenThePathLeadsBack) {
  const std::vector<Point> path{{0, 0}, {1, 0.1}};
  const FollowStep step = follow({0, 0, std::numbers::pi}, path, {}, {});
  EXPECT_EQ(step.wanted.v_mps, 0.0);
  EXPECT_NE(step.wanted.w_radps, 0.0);
  EXPECT_TRUE(step.state.turning);
  EXPECT_TRUE(drive({0, 0, std::numbers::pi}, path, {}).arrived);
}

TEST(PathFollower, StaysNearAPathWithCorners) {
  const Driven run = drive({0, 0, 0}, {{0, 0}, {1, 0}, {1, 1}, {2, 1}}, {});
  EXPECT_TRUE(run.arrived);
  EXPECT_LT(run.worst_off_m, 0.12);
}

TEST(PathFollower, DrivesAWholeLapThoughItsStartIsItsEnd) {
  const Driven run = drive({0.8, 0, std::numbers::pi / 2}, circle(0.8, 24), {});
  EXPECT_TRUE(run.arrived);
  EXPECT_GT(run.seconds, 2.0 * std::numbers::pi * 0.8 / 0.2 * 0.9);
  EXPECT_LT(run.worst_off_m, 0.06);
}

TEST(PathFollower, KeepsToItsSpeedAndTurnRate) {
  FollowLimits limits;
  limits.speed_mps = 0.15;
  limits.max_w_radps = 0.4;
  Pose2 pose{0, 0, 1.0};
  PathProgress state;
  for (int i = 0; i < 2000; ++i) {
    const FollowStep step = follow(pose, circle(0.3, 12), state, limits);
    state = step.state;
    EXPECT_LE(std::abs(step.wanted.v_mps), 0.15);
    EXPECT_LE(std::abs(step.wanted.w_radps), 0.4 + 1e-12);
    pose = pose * Pose2{step.wanted.v_mps * 0.04, 0.0, step.wanted.w_radps * 0.04};
  }
}

TEST(PathFollower, SlowsDownTowardsTheEnd) {
  const std::vector<Point> path{{0, 0}, {2, 0}};
  EXPECT_DOUBLE_EQ(follow({0, 0, 0}, path, {}, {}).wanted.v_mps, 0.2);
  EXPECT_LT(follow({1.92, 0, 0}, path, {1.92, false}, {}).wanted.v_mps, 0.19);
}

TEST(PathFollower, ACarNeverTurnsInPlaceOrTighterThanItCan) {
  FollowLimits limits;
  limits.min_turning_radius_m = 0.5;
  const std::vector<Point> path{{0, 0}, {4, 0}};
  Pose2 pose{0, 0, 2.5};
  PathProgress state;
  for (int i = 0; i < 3000; ++i) {
    const FollowStep step = follow(pose, path, state, limits);
    state = step.state;
    if (step.arrived) break;
    EXPECT_GT(step.wanted.v_mps, 0.0);
    EXPECT_LE(std::abs(step.wanted.w_radps), step.wanted.v_mps / 0.5 + 1e-9);
    pose = pose * Pose2{step.wanted.v_mps * 0.04, 0.0, step.wanted.w_radps * 0.04};
  }
  EXPECT_NEAR(pose.x_m, 4.0, 0.1);
}

TEST(PathFollower, AnEmptyPathHasArrived) {
  EXPECT_TRUE(follow({}, {}, {}, {}).arrived);
}

}  // namespace
}  // namespace cairn::pursuit_dwa
