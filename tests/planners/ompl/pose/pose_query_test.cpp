// Ways for robots with an outline, in rooms full of boxes, looked at from outside: by brute force.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>
#include <thread>

#include "planners/ompl/ompl_planner.hpp"
#include "tests/planners/common/pose_space/pose_worlds.hpp"
#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

using test::Random;
using ::testing::HasSubstr;

constexpr double kTurningRadius_m = 0.5;
const std::vector<Point> kRectangle{{-0.2, -0.15}, {0.4, -0.15}, {0.4, 0.15}, {-0.2, 0.15}};
const std::vector<Point> kAngle{{-0.15, -0.15}, {0.35, -0.15}, {0.35, 0.0}, {0.0, 0.0}, {0.0, 0.3}, {-0.15, 0.3}};

// 6 x 5 m with boxes of half a metre.
test::DrawnWorld room_with_boxes(Random& random) {
  constexpr int kWidth = 60;
  constexpr int kHeight = 50;
  test::DrawnWorld world;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const bool is_wall = x == 0 || y == 0 || x == kWidth - 1 || y == kHeight - 1;
      world.grid.set_log_odds({x, y}, is_wall ? LogOdds{900} : LogOdds{-900});
    }
  for (int box = 0; box < 6; ++box) {
    const Cell low{static_cast<int>(random() % (kWidth - 5)), static_cast<int>(random() % (kHeight - 5))};
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < 5; ++x) world.grid.set_log_odds(low + Cell{x, y}, LogOdds{900});
  }
  return world;
}

OmplConfig config_of(MotionKind kind) {
  OmplConfig config;
  config.kinematics = kind;
  config.footprint = PlannerTraits::Shape::outline;
  config.turning_radius_m = kTurningRadius_m;
  config.improve_iterations = 40;
  config.iterations = 2000;
  return config;
}

Pose2 between(const Pose2& a, const Pose2& b, double share) {
  const Point at = a.position() + share * (b.position() - a.position());
  return {at.x(), at.y(), a.theta_rad + share * wrap_angle(b.theta_rad - a.theta_rad)};
}

// By closely spaced poses; straight between those of the path, which on arcs is off by less than a millimetre.
double min_distance_m(const OccupancyGrid& grid, const Footprint& footprint, const std::vector<Pose2>& path) {
  double min_m = test::outline_distance_m(grid, {}, footprint, path.front(), 0.005);
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double moved_m =
        (path[i].position() - path[i - 1].position()).norm() +
        std::abs(wrap_angle(path[i].theta_rad - path[i - 1].theta_rad)) * footprint.circumscribed_m();
    const int steps = std::max(1, static_cast<int>(std::ceil(moved_m / 0.02)));
    for (int k = 1; k <= steps; ++k)
      min_m = std::min(min_m,
                       test::outline_distance_m(grid, {}, footprint,
                                                between(path[i - 1], path[i], static_cast<double>(k) / steps), 0.005));
  }
  return min_m;
}

// The circle through three points.
double curvature_per_m(const Point& a, const Point& b, const Point& c) {
  const Point in = b - a;
  const Point out = c - b;
  return 2.0 * std::abs(in.x() * out.y() - in.y() * out.x()) / (in.norm() * out.norm() * (c - a).norm());
}

// Each step is a turn on the spot, or goes where the robot looks (or straight back), no tighter than it can.
void expect_drivable(const std::vector<Pose2>& path, MotionKind kind) {
  int direction_before = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point step = path[i].position() - path[i - 1].position();
    const double turn_rad = wrap_angle(path[i].theta_rad - path[i - 1].theta_rad);
    EXPECT_LE(step.norm(), 0.1 + 1e-9);
    EXPECT_LE(std::abs(turn_rad), radians(5.01));
    if (step.norm() < 1e-5) {
      EXPECT_TRUE(kind == MotionKind::differential || std::abs(turn_rad) < 1e-4) << "a turn on the spot at " << i;
      direction_before = 0;
      continue;
    }
    const double ahead_rad = wrap_angle(std::atan2(step.y(), step.x()) - path[i - 1].theta_rad - 0.5 * turn_rad);
    const int direction = std::abs(ahead_rad) < 1.5 ? 1 : -1;
    EXPECT_LT(direction > 0 ? std::abs(ahead_rad) : std::abs(wrap_angle(ahead_rad + std::numbers::pi)), 1e-4) << i;
    if (kind != MotionKind::reeds_shepp) {
      EXPECT_EQ(direction, 1) << "it reverses at " << i;
    }
    if (kind == MotionKind::differential) {
      EXPECT_LT(std::abs(turn_rad), 1e-6) << "it turns while driving at " << i;
      continue;
    }
    EXPECT_GE(step.norm(), 2.0 * kTurningRadius_m * std::sin(0.5 * std::abs(turn_rad)) * (1.0 - 1e-6) - 1e-9) << i;
    if (direction == direction_before && step.norm() > 1e-3 &&
        (path[i - 1].position() - path[i - 2].position()).norm() > 1e-3) {
      EXPECT_LE(curvature_per_m(path[i - 2].position(), path[i - 1].position(), path[i].position()),
                1.001 / kTurningRadius_m)
          << i;
    }
    direction_before = direction;
  }
}

class PoseQueryOf : public ::testing::TestWithParam<MotionKind> {};

TEST_P(PoseQueryOf, EveryWayIsFreeDrivableAndEndsWhereItShall) {
  Random random(31);
  int solved = 0;
  for (int trial = 0; trial < 150; ++trial) {
    test::DrawnWorld world = room_with_boxes(random);
    world.robot.polygon_m = trial % 2 == 0 ? kRectangle : kAngle;
    const Footprint footprint = Footprint::polygon(world.robot.polygon_m);
    PathRequest request;
    request.from.pose = test::random_pose(random, world.grid);
    request.to.pose = test::random_pose(random, world.grid);
    request.to.heading_matters = trial % 3 != 0;
    request.seed = static_cast<std::uint64_t>(trial) + 1;
    const PathResult result = OmplPlanner(config_of(GetParam())).plan(request, world.view(), {});
    if (result.outcome != PlanOutcome::solved) {
      EXPECT_TRUE(result.path.empty() && !result.reason.empty());
      continue;
    }
    ++solved;
    SCOPED_TRACE("trial " + std::to_string(trial) + test::drawing_of(world.grid, result.path));
    // What the planner keeps, less what arcs and the oracle's rim are off by.
    EXPECT_GE(min_distance_m(world.grid, footprint, result.path), 0.002);
    expect_drivable(result.path, GetParam());
    EXPECT_TRUE(are_alike(result.path.front(), *request.from.pose, 1e-9));
    EXPECT_LT((result.path.back().position() - request.to.pose->position()).norm(), 1e-8);
    if (request.to.heading_matters) {
      EXPECT_TRUE(are_alike(result.path.back(), *request.to.pose, 1e-8));
    }
    EXPECT_NEAR(result.length_m, length_of(result.path), 1e-9);
    EXPECT_GT(result.clearance_m, 0.0);
    ASSERT_TRUE(result.length_lower_bound_m);
    EXPECT_LE(*result.length_lower_bound_m, result.length_m + 1e-9);
  }
  EXPECT_GT(solved, GetParam() == MotionKind::dubins ? 15 : 30);
}

TEST_P(PoseQueryOf, AnEndThatTouchesIsNamedWithAPlaceThatFits) {
  Random random(5);
  test::DrawnWorld world = room_with_boxes(random);
  world.robot.polygon_m = kRectangle;
  const Footprint footprint = Footprint::polygon(kRectangle);
  PathRequest request;
  request.from.pose = Pose2{0.3, 2.0, 0.0};  // wide enough for the disc that it holds, not for its tail
  request.to.pose = Pose2{3.0, 0.3, radians(-90.0)};
  for (const bool from_start : {true, false}) {
    if (!from_start) request.from.pose = request.to.pose, request.from.pose->theta_rad = 0.0;
    request.to.heading_matters = true;
    const PathResult result = OmplPlanner(config_of(GetParam())).plan(request, world.view(), {});
    ASSERT_EQ(result.outcome, from_start ? PlanOutcome::start_blocked : PlanOutcome::goal_blocked) << result.reason;
    EXPECT_THAT(result.reason, HasSubstr("outline touches something"));
    const std::size_t at = result.reason.find("nearest free place is (");
    ASSERT_NE(at, std::string::npos) << result.reason;
    Pose2 place = from_start ? *request.from.pose : *request.to.pose;
    ASSERT_EQ(std::sscanf(result.reason.c_str() + at, "nearest free place is (%lf, %lf)", &place.x_m, &place.y_m), 2);
    EXPECT_GT(test::outline_distance_m(world.grid, {}, footprint, place, 0.002), 0.001) << result.reason;
  }
}

// OMPL's headings end short of half a turn, ours with it.
TEST_P(PoseQueryOf, HalfATurnIsAHeadingLikeAnyOther) {
  Random random(1);
  test::DrawnWorld world = room_with_boxes(random);
  for (int y = 1; y < 49; ++y)
    for (int x = 1; x < 59; ++x) world.grid.set_log_odds({x, y}, LogOdds{-900});
  world.robot.polygon_m = kRectangle;
  const OmplPlanner planner(config_of(GetParam()), world.robot);
  constexpr double kHalf = std::numbers::pi;
  const Pose2 right{4.0, 2.5, 0.0};
  const Pose2 left{1.5, 2.5, 0.0};
  for (const auto& [from_rad, to_rad] : {std::pair(kHalf, kHalf), {-kHalf, kHalf}, {0.0, -kHalf}, {0.0, 3.0 * kHalf}}) {
    PathRequest request;
    request.from.pose = Pose2{right.x_m, right.y_m, from_rad};
    request.to.pose = Pose2{left.x_m, left.y_m, to_rad};
    request.to.heading_matters = true;
    const PathResult result = planner.plan(request, world.view(), Budget{});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason << ", " << from_rad << " to " << to_rad;
    EXPECT_NEAR(wrap_angle(result.path.back().theta_rad - to_rad), 0.0, 1e-6);
    EXPECT_LT(result.length_m, 9.0);
  }
}

// All of it, not only under the disc that the outline holds.
TEST_P(PoseQueryOf, UnknownGroundUnderTheRobotItselfDoesNotBlock) {
  Random random(7);
  test::DrawnWorld world = room_with_boxes(random);
  const Pose2 stand{3.0, 2.5, radians(30.0)};
  for (int y = 1; y < 49; ++y)
    for (int x = 1; x < 59; ++x) {
      const Point off = world.grid.centre_of({x, y}) - stand.position();
      world.grid.set_log_odds({x, y}, off.norm() < 0.4 ? LogOdds{0} : LogOdds{-900});
    }
  world.robot.polygon_m = kRectangle;
  const OmplPlanner planner(config_of(GetParam()), world.robot);
  PathRequest request;
  request.from.pose = stand;
  request.to.pose = Pose2{5.0, 2.5, 0.0};
  EXPECT_EQ(planner.plan(request, world.view(), {}).outcome, PlanOutcome::start_blocked) << "nobody says it is there";
  const Observation observation;
  const WorldView live{world.grid, world.graph, world.robot, {stand, {}}, 1.0, &observation, 0.0};
  const PathResult result = planner.plan(request, live, {});
  EXPECT_NE(result.outcome, PlanOutcome::start_blocked) << result.reason;
}

TEST_P(PoseQueryOf, AnOutlineLargerThanAnyPassageIsAnOutcome) {
  Random random(6);
  test::DrawnWorld world = room_with_boxes(random);
  world.robot.polygon_m = {{-9.0, -9.0}, {9.0, -9.0}, {9.0, 9.0}, {-9.0, 9.0}};
  PathRequest request;
  request.from.pose = Pose2{3.0, 2.0, 0.0};
  request.to.pose = Pose2{4.0, 2.0, 0.0};
  EXPECT_EQ(OmplPlanner(config_of(GetParam())).plan(request, world.view(), {}).outcome, PlanOutcome::start_blocked);
}

std::string name_of_kind(const ::testing::TestParamInfo<MotionKind>& instance) {
  if (instance.param == MotionKind::differential) return "differential";
  return instance.param == MotionKind::dubins ? "dubins" : "reeds_shepp";
}
INSTANTIATE_TEST_SUITE_P(Ompl, PoseQueryOf,
                         ::testing::Values(MotionKind::differential, MotionKind::dubins, MotionKind::reeds_shepp),
                         name_of_kind);

}  // namespace
}  // namespace cairn
