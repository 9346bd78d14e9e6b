#include "plugins/simulated_robot/surroundings/traffic.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "plugins/simulated_robot/simulated_robot.hpp"
#include "tests/plugins/simulated_robot/test_worlds.hpp"
#include "tests/plugins/simulated_robot/witnessed.hpp"

namespace cairn {
namespace {

using testing::exact_robot;
using testing::room;
using testing::Witnessed;

constexpr Budget kNoLimit{};
constexpr double kTick_s = 0.04;

WorldDoor door_at_x(double x_m, std::vector<TimeSpan> closed_s) {
  WorldDoor door;
  door.from_m = {x_m, 2.0};
  door.to_m = {x_m, 3.0};
  door.closed_s = std::move(closed_s);
  return door;
}

WorldMover person(std::vector<Point> path_m, bool waits = true) {
  WorldMover mover;
  mover.name = "person";
  mover.contour = Contour::circle(0.4);
  mover.path_m = std::move(path_m);
  mover.waits = waits;
  return mover;
}

World with(std::vector<WorldDoor> doors, std::vector<WorldMover> movers) {
  World world = room(6.0, 5.0);
  world.doors = std::move(doors);
  world.movers = std::move(movers);
  return world;
}

// Where the moving thing is at that time, beside a robot that stands at the pose.
std::optional<Point> place_at(const World& world, double time_s, const Pose2& T_map_robot, std::size_t index = 0) {
  Traffic traffic(world, exact_robot(), T_map_robot);
  for (int i = 1; i <= std::lround(time_s / kTick_s); ++i) traffic.advance(i * kTick_s, kTick_s, T_map_robot);
  return traffic.places()[index];
}

const Pose2 kAside{0.5, 4.5, 0.0};

TEST(Traffic, ADoorIsThereInItsTimesOnly) {
  const World world = with({door_at_x(3.0, {{1.0, 2.0}, {4.0, 5.0}})}, {});
  EXPECT_FALSE(place_at(world, 0.8, kAside));
  EXPECT_TRUE(place_at(world, 1.2, kAside));
  EXPECT_FALSE(place_at(world, 2.2, kAside));
  EXPECT_TRUE(place_at(world, 4.2, kAside));
}

TEST(Traffic, ADoorClosesAgainAndAgain) {
  WorldDoor door = door_at_x(3.0, {});
  door.every_s = 3.0;
  door.closed_for_s = 1.0;
  door.first_s = 2.0;
  const World world = with({door}, {});
  for (const double time_s : {2.4, 5.4, 8.4}) EXPECT_TRUE(place_at(world, time_s, kAside)) << time_s;
  for (const double time_s : {0.4, 3.4, 6.4}) EXPECT_FALSE(place_at(world, time_s, kAside)) << time_s;
}

TEST(Traffic, ADoorNeverClosesOnTheRobotButWhenItIsGone) {
  const World world = with({door_at_x(3.0, {{1.0, 100.0}})}, {});
  Traffic traffic(world, exact_robot(), {3.1, 2.5, 0.0});
  traffic.advance(2.0, kTick_s, {3.1, 2.5, 0.0});
  EXPECT_FALSE(traffic.places()[0]);
  traffic.advance(2.04, kTick_s, {3.0 + 0.22 + 0.02, 2.5, 0.0});
  EXPECT_TRUE(traffic.places()[0]);
}

TEST(Traffic, MoversKeepToTheirCourse) {
  WorldMover mover = person({{1, 1}, {2, 1}, {2, 2}});
  mover.speed_mps = 1.0;
  mover.pause_s = 0.4;
  mover.start_s = 1.0;
  const auto at = [&](Course course, double time_s) {
    mover.course = course;
    return *place_at(with({}, {mover}), time_s, kAside);
  };
  const auto near = [](const Point& p, double x_m, double y_m) { return (p - Point(x_m, y_m)).norm() < 1e-6; };
  EXPECT_TRUE(near(at(Course::once, 1.0), 1, 1)) << "before it starts";
  EXPECT_TRUE(near(at(Course::once, 1.6), 1.6, 1));
  EXPECT_TRUE(near(at(Course::once, 2.2), 2, 1)) << "the pause";
  EXPECT_TRUE(near(at(Course::once, 3.0), 2, 1.6));
  EXPECT_TRUE(near(at(Course::once, 9.0), 2, 2)) << "it stays";
  EXPECT_TRUE(near(at(Course::there_and_back, 4.0), 2, 1.8)) << "on its way back";
  EXPECT_TRUE(near(at(Course::there_and_back, 6.8), 1.2, 1)) << "and there again";
  const double diagonal_m = 0.4 * std::sqrt(0.5);
  EXPECT_TRUE(near(at(Course::round, 4.2), 2 - diagonal_m, 2 - diagonal_m)) << "straight to the first point";
}

TEST(Traffic, OneThatWaitsStopsShortOfTheRobotAndGoesOnWhenThatIsGone) {
  const World world = with({}, {person({{1, 2.5}, {5, 2.5}})});
  const Pose2 T_map_robot{3.0, 2.5, 0.0};
  Traffic traffic(world, exact_robot(), T_map_robot);
  for (int i = 1; i <= 250; ++i) traffic.advance(i * kTick_s, kTick_s, T_map_robot);
  EXPECT_NEAR(traffic.places()[0]->x(), 3.0 - 0.22 - 0.2 - 0.3, 1e-4);
  EXPECT_FALSE(traffic.touches_robot());
  for (int i = 251; i <= 300; ++i) traffic.advance(i * kTick_s, kTick_s, kAside);
  EXPECT_NEAR(traffic.places()[0]->x(), 3.0 - 0.72 + 50 * kTick_s * 0.5, 1e-3);
}

TEST(Traffic, OneThatDoesNotWaitEndsAtTouchingTheRobot) {
  WorldMover cart = person({{1, 2.5}, {5, 2.5}}, false);
  cart.contour = Contour::polygon({{0, 0}, {0.6, 0}, {0.6, 0.4}, {0, 0.4}});
  const Pose2 T_map_robot{3.0, 2.5, 0.0};
  Traffic traffic(with({}, {cart}), exact_robot(), T_map_robot);
  for (int i = 1; i <= 250; ++i) traffic.advance(i * kTick_s, kTick_s, T_map_robot);
  EXPECT_LE(traffic.places()[0]->x(), 3.0 - 0.22 - 0.3);
  EXPECT_NEAR(traffic.places()[0]->x(), 3.0 - 0.22 - 0.3, 1e-5);
  EXPECT_TRUE(traffic.touches_robot());
}

// Clearance to everything at its place, from the geometry alone.
double clearance_m(const World& world, const Traffic& traffic, const RobotModel& robot, const Pose2& T_map_robot) {
  Scene scene(world);
  traffic.show(traffic.places(), scene);
  return Body(robot, scene).clearance_m(T_map_robot);
}

TEST(Traffic, NeverOverlapsARobotThatDrivesWildly) {
  for (const bool with_polygon : {false, true}) {
    RobotModel robot = exact_robot();
    if (with_polygon) robot.polygon_m = {{-0.3, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.3, 0.1}};
    WorldMover cart = person({{1, 1}, {5, 4}, {5, 1}, {1, 4}}, false);
    cart.contour = Contour::polygon({{0, 0}, {0.6, 0}, {0.6, 0.4}, {0, 0.4}});
    WorldDoor door = door_at_x(3.0, {});
    door.every_s = 2.0;
    door.closed_for_s = 1.0;
    const World world = with({door}, {person({{1, 2.5}, {5, 2.5}}), person({{5, 2}, {1, 3}}, false), cart});
    Traffic traffic(world, robot, {3.0, 3.6, 0.0});
    Pose2 T_map_robot{3.0, 3.6, 0.0};
    int touches = 0;
    for (int i = 1; i <= 3000; ++i) {
      traffic.advance(i * kTick_s, kTick_s, T_map_robot);
      touches += traffic.touches_robot() ? 1 : 0;
      ASSERT_GE(clearance_m(world, traffic, robot, T_map_robot), -1e-9) << i;
      Scene scene(world);
      traffic.show(traffic.places(), scene);
      (void)Body(robot, scene).drive(T_map_robot, 0.03 * std::sin(i * 0.013), 0.1 * std::cos(i * 0.0071));
      ASSERT_GE(clearance_m(world, traffic, robot, T_map_robot), -1e-9) << i;
    }
    EXPECT_GT(touches, 0) << "they never met";
  }
}

Witnessed drive_for(SimulatedRobot& robot, const Twist& twist, double time_s) {
  robot.command(twist, kAlways_s);
  Witnessed last;
  for (int i = 0; i < std::lround(time_s / kTick_s); ++i) last = testing::observe(robot);
  return last;
}

TEST(Traffic, SonarsHearMoversAndDoorsAtTheirPlaces) {
  const World world = with({door_at_x(2.5, {{1.0, 2.0}})}, {person({{4, 2.5}, {5, 2.5}})});
  SimulatedRobot robot({}, exact_robot(), &world, {1.0, 2.5, 0.0}, 1);
  EXPECT_NEAR(drive_for(robot, {}, 0.4).ranges[0].range_m, 4.0 + 0.4 * 0.5 - 0.2 - 1.0, 1e-6);
  EXPECT_NEAR(drive_for(robot, {}, 0.8).ranges[0].range_m, 1.5, 1e-6) << "the leaf";
  EXPECT_NEAR(drive_for(robot, {}, 1.0).ranges[0].range_m, 5.0 - 0.2 * 0.5 - 0.2 - 1.0, 1e-6) << "the person again";
}

TEST(Traffic, TheRobotBumpsIntoAClosedDoorAndPassesAnOpenOne) {
  const World world = with({door_at_x(2.0, {{0.0, 10.0}})}, {});
  SimulatedRobot robot({}, exact_robot(), &world, {1.0, 2.5, 0.0}, 1);
  EXPECT_TRUE(drive_for(robot, {0.4, 0.0}, 9.0).bumped);
  const Witnessed seen = drive_for(robot, {0.4, 0.0}, 5.0);
  EXPECT_FALSE(seen.bumped);
  EXPECT_GT(seen.true_T_map_robot->x_m, 2.3);
}

TEST(Traffic, SaysWhichMoverTheStartOverlaps) {
  const World world = with({}, {person({{1, 2.5}, {5, 2.5}})});
  SimulatedRobot robot({}, exact_robot(), &world, {1.1, 2.5, 0.0}, 1);
  EXPECT_EQ(robot.next(kNoLimit).reason, "the robot cannot start at (1.10, 2.50) m: it would overlap mover 1 (person)");
}

TEST(Traffic, IsTheSameToTheLastBitInEveryRun) {
  const World world =
      with({door_at_x(2.0, {{1.0, 3.0}})}, {person({{1, 2.5}, {5, 2.5}}), person({{5, 2}, {1, 3}}, false)});
  const auto run = [&] {
    SimulatedRobot robot({}, exact_robot(), &world, {3.0, 3.5, 0.0}, 1);
    std::vector<double> seen;
    for (int i = 0; i < 500; ++i) {
      const Witnessed o = drive_for(robot, {0.2 * std::sin(i * 0.1), 0.5 * std::cos(i * 0.05)}, kTick_s);
      seen.insert(seen.end(), {o.true_T_map_robot->x_m, o.true_T_map_robot->y_m, o.ranges[0].range_m});
    }
    return seen;
  };
  EXPECT_EQ(run(), run());
}

// What a resumed mission asks for: the world has gone on while the robot stood at its start.
TEST(Traffic, OfALaterBeginningIsWhereStandingSoLongLeavesIt) {
  const World world =
      with({door_at_x(4.0, {{1.0, 30.0}})}, {person({{1, 2.5}, {5, 2.5}}), person({{5, 2}, {1, 3}}, false)});
  const Pose2 start{3.0, 3.5, -1.5};
  constexpr int kStood = 512;
  SimulatedRobot stood({}, exact_robot(), &world, start, 1);
  for (int i = 0; i < kStood; ++i) (void)stood.next(kNoLimit);
  SimulatedRobot later({}, exact_robot(), &world, start, 1, kStood * kTick_s);
  SimulatedRobot afresh({}, exact_robot(), &world, start, 1);
  bool differs_from_afresh = false;
  for (int i = 0; i < 300; ++i) {
    const Observation a = stood.next(kNoLimit).observation;
    const Observation b = later.next(kNoLimit).observation;
    ASSERT_EQ(a.ranges[0].sensor, b.ranges[0].sensor);
    ASSERT_EQ(a.ranges[0].range_m, b.ranges[0].range_m) << "tick " << i;
    EXPECT_EQ(a.stamp_s, b.stamp_s);
    const Observation c = afresh.next(kNoLimit).observation;
    differs_from_afresh = differs_from_afresh || c.ranges[0].range_m != b.ranges[0].range_m;
  }
  EXPECT_TRUE(differs_from_afresh) << "the world moves before the robot's eyes";
}

}  // namespace
}  // namespace cairn
