// Conformance of modules of kind `controller`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(Mine, ControllerConformance,
//                            testing::Values(module<cairn::Controller>(FOLDER, "my_controller")));
//   }
//
// A disc that obeys its commands drives along paths of a few metres, with obstacles as points.
#pragma once

#include <algorithm>
#include <numbers>
#include <vector>

#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class ControllerConformance : public Conformance<Controller> {
 protected:
  static constexpr double kTick_s = 0.05;
  static constexpr double kSpeed_mps = 0.25;
  static constexpr double kTolerance_m = 0.1;

  // A robot on its way along a path.
  struct Drive {
    std::vector<Point> path{{0.0, 0.0}, {1.5, 0.0}, {1.5, 1.0}};
    std::vector<Point> obstacles_map{};
    bool avoids_obstacles = true;
    RobotModel robot = eight_sonar_robot();
    Pose2 T_map_robot{};
    PathProgress progress{};
    bool is_new_path = true;
    Twist velocity{};
    ControlResult last{};
    std::string record{};  // equal texts are equal drives
    double nearest_m = 1e9;
  };

  static ControlResult tick(Controller& controller, Drive& drive) {
    const OccupancyGrid grid(0.05);
    const LandmarkGraph graph;
    std::vector<Point> obstacles;
    for (const Point& p : drive.obstacles_map) obstacles.push_back(inverse(drive.T_map_robot) * p);
    ControlRequest request;
    request.path = drive.path;
    request.is_new_path = drive.is_new_path;
    request.progress = drive.progress;
    request.speed_mps = kSpeed_mps;
    request.tolerance_m = kTolerance_m;
    request.avoids_obstacles = drive.avoids_obstacles;
    request.obstacles = obstacles;
    request.velocity = drive.velocity;
    request.period_s = kTick_s;
    drive.last = controller.control(request, {grid, graph, drive.robot, {drive.T_map_robot, {}}, 0.0});
    drive.record += text_of(drive.last.twist) + " " + std::string(name_of(drive.last.state)) + "\n";
    drive.is_new_path = false;
    drive.progress = drive.last.progress;
    drive.velocity = drive.last.twist;
    const Twist& twist = drive.last.twist;
    if (is_finite(twist))
      drive.T_map_robot = drive.T_map_robot * Pose2{twist.v_mps * kTick_s, 0.0, twist.w_radps * kTick_s};
    for (const Point& p : drive.obstacles_map)
      drive.nearest_m = std::min(drive.nearest_m, (p - drive.T_map_robot.position()).norm());
    return drive.last;
  }

  // Until it has arrived, or for so long.
  static ControlResult run(Controller& controller, Drive& drive, double at_most_s = 60.0) {
    for (double s = 0.0; s < at_most_s; s += kTick_s)
      if (tick(controller, drive).state == ControlState::arrived) break;
    return drive.last;
  }

  static bool is_finite(const Twist& twist) { return std::isfinite(twist.v_mps) && std::isfinite(twist.w_radps); }
  static void expect_within(const Twist& twist, const RobotModel& robot) {
    ASSERT_TRUE(is_finite(twist)) << text_of(twist);
    EXPECT_LE(std::abs(twist.v_mps), std::min(kSpeed_mps, robot.max_v_mps) + 1e-9);
    EXPECT_LE(std::abs(twist.w_radps), robot.max_w_radps + 1e-9);
  }
  // A wall across the path.
  static std::vector<Point> wall_at(double x_m) {
    std::vector<Point> points;
    for (double y_m = -2.0; y_m <= 2.0; y_m += 0.05) points.emplace_back(x_m, y_m);
    return points;
  }
};

TEST_P(ControllerConformance, ArrivesAtTheEndOfThePathWithinTheTolerance) {
  const auto controller = make();
  Drive drive;
  ASSERT_EQ(run(*controller, drive).state, ControlState::arrived) << "at " << text_of(drive.T_map_robot);
  EXPECT_LE((drive.T_map_robot.position() - drive.path.back()).norm(), kTolerance_m + kSpeed_mps * kTick_s);
}

TEST_P(ControllerConformance, StaysNearThePathInTheOpen) {
  const auto controller = make();
  Drive drive;
  while (tick(*controller, drive).state != ControlState::arrived && drive.record.size() < 100000) {
    const Point p = drive.T_map_robot.position();
    const double off_m = std::min(std::abs(p.y()), std::abs(p.x() - 1.5));
    ASSERT_LT(off_m, 0.4) << "at " << text_of(drive.T_map_robot);
  }
}

TEST_P(ControllerConformance, VelocitiesAreFiniteAndWithinTheLimits) {
  const auto controller = make();
  for (const double max_w_radps : {radians(100.0), radians(20.0)}) {
    Drive drive;
    drive.robot.max_w_radps = max_w_radps;
    drive.T_map_robot = {0.0, 0.0, 2.5};
    for (int i = 0; i < 400; ++i) {
      const ControlResult result = tick(*controller, drive);
      expect_within(result.twist, drive.robot);
      expect_within(result.unhindered, drive.robot);
    }
  }
}

TEST_P(ControllerConformance, ASpeedLimitIsKept) {
  const auto controller = make();
  Drive drive;
  const OccupancyGrid grid(0.05);
  const LandmarkGraph graph;
  for (int i = 0; i < 100; ++i) {
    ControlRequest request;
    request.path = drive.path;
    request.is_new_path = i == 0;
    request.progress = drive.progress;
    request.speed_limit_mps = 0.05;
    request.period_s = kTick_s;
    request.velocity = drive.velocity;
    drive.last = controller->control(request, {grid, graph, drive.robot, {drive.T_map_robot, {}}, 0.0});
    drive.progress = drive.last.progress;
    drive.velocity = drive.last.twist;
    ASSERT_LE(std::abs(drive.last.twist.v_mps), 0.05 + 1e-9);
    drive.T_map_robot =
        drive.T_map_robot * Pose2{drive.last.twist.v_mps * kTick_s, 0, drive.last.twist.w_radps * kTick_s};
  }
  EXPECT_GT(drive.T_map_robot.x_m, 0.05) << "it drives all the same";
}

TEST_P(ControllerConformance, NeverDrivesIntoWhatIsRightAhead) {
  const auto controller = make();
  for (const double x_m : {0.5, 0.8, 1.2}) {
    Drive drive;
    drive.path = {{0.0, 0.0}, {3.0, 0.0}};
    drive.obstacles_map = wall_at(x_m);
    EXPECT_NE(run(*controller, drive, 30.0).state, ControlState::arrived);
    EXPECT_GE(drive.nearest_m, drive.robot.radius_m) << "a wall at " << x_m << " m";
    EXPECT_LT(std::abs(drive.last.twist.v_mps), 0.02) << "it stands before it";
  }
}

TEST_P(ControllerConformance, DrivesOnWhenTheBlockageHasGone) {
  const auto controller = make();
  Drive drive;
  drive.path = {{0.0, 0.0}, {1.5, 0.0}};
  drive.obstacles_map = wall_at(0.7);
  (void)run(*controller, drive, 10.0);
  drive.obstacles_map.clear();
  EXPECT_EQ(run(*controller, drive, 40.0).state, ControlState::arrived);
}

TEST_P(ControllerConformance, FollowsExactlyWhereObstaclesDoNotCount) {
  const auto controller = make();
  Drive drive;
  drive.path = {{0.0, 0.0}, {1.0, 0.0}};
  drive.obstacles_map = wall_at(0.5);
  drive.avoids_obstacles = false;
  EXPECT_EQ(run(*controller, drive, 30.0).state, ControlState::arrived);
}

TEST_P(ControllerConformance, AnEmptyPathHasArrived) {
  const auto controller = make();
  Drive drive;
  drive.path.clear();
  const ControlResult result = tick(*controller, drive);
  EXPECT_EQ(result.state, ControlState::arrived);
  EXPECT_EQ(result.twist, Twist{});
}

TEST_P(ControllerConformance, ProgressNeverFallsAndWhatIsLeftBecomesLess) {
  const auto controller = make();
  Drive drive;
  double along_m = 0.0;
  double left_m = 1e9;
  for (int i = 0; i < 800 && drive.last.state != ControlState::arrived; ++i) {
    const ControlResult result = tick(*controller, drive);
    ASSERT_GE(result.progress.along_m, along_m);
    ASSERT_LE(result.left_m, left_m + 0.05);
    along_m = result.progress.along_m;
    left_m = result.left_m;
  }
  EXPECT_GT(along_m, 0.5);
}

TEST_P(ControllerConformance, ForgetsTheOldPathWhenANewOneBegins) {
  const auto fresh = make();
  Drive expected;
  (void)run(*fresh, expected);
  const auto used = make();
  Drive other;
  other.path = {{0.0, 0.0}, {0.0, -2.0}, {3.0, -2.0}};
  (void)run(*used, other, 8.0);
  Drive drive;
  (void)run(*used, drive);
  EXPECT_EQ(drive.record, expected.record) << "is_new_path: what was kept of earlier requests must be forgotten";
}

TEST_P(ControllerConformance, TheSameRequestsGiveTheSameVelocities) {
  const auto first = make();
  const auto second = make();
  Drive drive;
  Drive other;
  drive.obstacles_map = other.obstacles_map = {{0.8, 0.1}, {1.2, -0.3}};
  (void)run(*first, drive, 20.0);
  (void)run(*second, other, 20.0);
  EXPECT_EQ(drive.record, other.record);
}

TEST_P(ControllerConformance, ACarNeverTurnsTighterThanItCan) {
  const auto controller = make();
  Drive drive;
  drive.path = {{0.0, 0.0}, {4.0, 0.5}};
  drive.robot.kinematics = Kinematics::car;
  drive.robot.min_turning_radius_m = 0.6;
  drive.T_map_robot = {0.0, 0.0, 1.0};
  for (int i = 0; i < 400; ++i) {
    const ControlResult result = tick(*controller, drive);
    ASSERT_LE(std::abs(result.twist.w_radps) * 0.6, std::abs(result.twist.v_mps) + 1e-6);
  }
}

TEST_P(ControllerConformance, OddNumbersGiveFiniteVelocities) {
  const auto controller = make();
  for (const double odd : {kNan, kInfinity, -kInfinity, kHuge}) {
    for (const int which : {0, 1, 2, 3}) {
      Drive drive;
      if (which == 0) drive.path.back() = {odd, 0.0};
      if (which == 1) drive.T_map_robot.x_m = odd;
      if (which == 2) drive.obstacles_map = {{odd, odd}};
      if (which == 3) drive.velocity = {odd, odd};
      ControlResult result;
      ASSERT_NO_THROW(result = tick(*controller, drive)) << text_of(odd);
      EXPECT_TRUE(is_finite(result.twist)) << text_of(odd) << " at " << which;
      EXPECT_TRUE(is_finite(result.unhindered)) << text_of(odd) << " at " << which;
    }
  }
}

TEST_P(ControllerConformance, OutlivesTheLibraryThatMadeIt) {
  const auto controller = GetParam().make_outliving_library();
  Drive drive;
  EXPECT_EQ(run(*controller, drive).state, ControlState::arrived);
}

}  // namespace cairn::conformance
