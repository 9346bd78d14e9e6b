#include "plugins/behaviours/driving/route_driver.hpp"

#include <gmock/gmock.h>

#include <functional>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::Contains;
using testing::HasSubstr;

// 4 x 2.2 m; two doors between the rooms.
const std::string kTwoDoors = R"(
  ########################################
  #...................#..................#
  #...................#..................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #...................#..................#
  #...................#..................#
  #...................#..................#
  #....R..............#..................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #...................#..................#
  #...................#..................#
  ########################################
)";
const FakeHostSettings kKnown{.sight_m = 1.2, .all_known = true};
const Place kOtherRoom{Pose2{3.3, 0.5, 0.0}, false, {}};

// A behaviour that only drives there.
class Driving : public Behaviour {
 public:
  explicit Driving(const RouteSettings& settings, Place place) : driver(settings, 1), goal(std::move(place)) {}
  Status tick(const WorldView& world, BehaviourContext& context) override { return driver.tick(goal, world, context); }
  void halt() override { driver.restart(); }
  RouteDriver driver;
  Place goal;
};

void close_door(FakeHost& host, bool lower, bool closed = true) {
  for (double y = lower ? 0.35 : 1.35; y < (lower ? 0.9 : 1.9); y += 0.1) host.solidify({2.05, y}, closed);
}

TEST(RouteDriver, DrivesThroughADoor) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  const Status status = host.run(driving, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m);
}

TEST(RouteDriver, TurnsToTheHeadingOfTheGoal) {
  FakeHost host(kTwoDoors, kKnown);
  Place goal{Pose2{1.0, 1.0, radians(120.0)}, true, {}};
  Driving driving({}, goal);
  EXPECT_EQ(host.run(driving, 120.0).state, StepState::success);
  EXPECT_NEAR(degrees(host.T_map_robot.theta_rad), 120.0, 4.0);
}

TEST(RouteDriver, TakesTheOtherDoorWhenOneCloses) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  host.run(driving, 2.0);
  close_door(host, true);
  const Status status = host.run(driving, 200.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m) << host.picture();
}

// Drives, then the map moves; how often the planner is asked until the robot is there. goal: moves along by so much.
std::size_t plans_after(const std::function<void(FakeHost&)>& move, const Point& goal_by_m) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  host.run(driving, 3.0);
  const std::size_t planned = host.planned.size();
  move(host);
  driving.goal.pose->x_m += goal_by_m.x();
  driving.goal.pose->y_m += goal_by_m.y();
  EXPECT_EQ(host.run(driving, 120.0).state, StepState::success) << host.picture();
  EXPECT_LT((host.T_map_robot.position() - driving.goal.pose->position()).norm(), 0.15);
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m);
  return host.planned.size() - planned;
}

TEST(RouteDriver, ARouteMovesWithTheMapAndIsNotPlannedAgain) {
  EXPECT_EQ(plans_after([](FakeHost&) {}, {0.0, 0.0}), 0U);
  EXPECT_EQ(plans_after([](FakeHost& host) { host.move_map({1.5, -2.0}); }, {1.5, -2.0}), 0U);
}

TEST(RouteDriver, ARouteThatIsBlockedOnTheNewMapIsPlannedAgain) {
  const auto move = [](FakeHost& host) {
    host.move_map({1.5, -2.0});
    // Beyond what it looks at while it drives.
    for (double y_m = 0.35; y_m < 0.9; y_m += 0.05)
      for (const double x_m : {2.0, 2.05}) host.grid.set_log_odds(host.grid.cell_at({x_m + 1.5, y_m - 2.0}), 600);
  };
  EXPECT_GT(plans_after(move, {1.5, -2.0}), 0U);
}

// The map bends: its right end goes up by so much, as a parabola.
std::size_t plans_after_bend(double end_m) {
  return plans_after(
      [&](FakeHost& host) {
        const Pose2 robot = host.T_map_robot;
        const auto up_m = [&](double x_m) {
          const double part = std::max(0.0, (x_m - robot.x_m) / (3.3 - robot.x_m));
          return end_m * part * part;
        };
        std::vector<Pose2> before;
        std::vector<Pose2> after;
        for (double x_m = robot.x_m; x_m < 4.0; x_m += 0.1) {
          before.push_back({x_m, robot.y_m, 0.0});
          after.push_back({x_m, robot.y_m + up_m(x_m), 0.0});
        }
        host.move_map({0.0, 0.0});
        host.last_map_move.emplace(before, after);
      },
      {0.0, end_m});
}

TEST(RouteDriver, ARouteIsPlannedAgainWhenItWasBentByMoreThanALittle) {
  EXPECT_EQ(plans_after_bend(0.15), 0U);
  EXPECT_GT(plans_after_bend(1.4), 0U) << "at its ends a parabola is off by a sixth of that";
}

TEST(RouteDriver, ARouteIsPlannedAgainWhenItsGoalHasNotMovedAlong) {
  EXPECT_EQ(plans_after([](FakeHost& host) { host.move_map({0.1, 0.0}); }, {0.0, 0.0}), 0U);
  EXPECT_GT(plans_after([](FakeHost& host) { host.move_map({0.3, 0.0}); }, {0.0, 0.0}), 0U);
}

TEST(RouteDriver, ARouteIsPlannedAgainWhenNobodyKnowsHowTheMapHasMoved) {
  const auto move = [](FakeHost& host) {
    host.move_map({1.5, -2.0});
    host.last_map_move.reset();
  };
  EXPECT_GT(plans_after(move, {1.5, -2.0}), 0U);
}

TEST(RouteDriver, LooksWhetherADoorHasOpenedAgain) {
  FakeHost host(kTwoDoors, kKnown);
  close_door(host, false);
  Driving driving({}, kOtherRoom);
  host.run(driving, 2.0);
  close_door(host, true);
  Status status = host.run(driving, 25.0);
  EXPECT_EQ(status.state, StepState::running) << status.reason;
  close_door(host, true, false);
  status = host.run(driving, 200.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_THAT(host.said, Contains(HasSubstr("looks again at")));
}

TEST(RouteDriver, SaysWhatItHasTriedWhenBothDoorsStayClosed) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  host.run(driving, 2.0);
  close_door(host, true);
  close_door(host, false);
  const Status status = host.run(driving, 1000.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("no_route"));
  EXPECT_THAT(status.reason, HasSubstr("looked"));
}

TEST(RouteDriver, WaitsFirstAndThenClimbsTheLadder) {
  FakeHost host(kTwoDoors, kKnown);
  RouteSettings settings;
  settings.patience_s = 3.0;
  settings.rounds = 2;
  Driving driving(settings, kOtherRoom);
  host.run(driving, 3.0);
  host.collision_monitor = [](const Pose2&, const Twist& wanted) {
    return Twist{std::min(0.0, wanted.v_mps), wanted.w_radps};
  };
  const double held_s = host.time_s;
  const double x_m = host.T_map_robot.x_m;
  host.run(driving, 2.5);
  EXPECT_EQ(host.T_map_robot.x_m, x_m) << "waits";
  const Status status = host.run(driving, 300.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_GT(host.time_s, held_s + 6.0);
  EXPECT_THAT(status.reason, HasSubstr("blocked at ("));
  EXPECT_THAT(status.reason, HasSubstr("waited, backed up, looked and planned again 2 times"));
  EXPECT_LT(host.T_map_robot.x_m, x_m - 0.1) << "has backed up";
  EXPECT_THAT(host.said, Contains(HasSubstr("(1 of 2)")));
  EXPECT_THAT(host.said, Contains(HasSubstr("(2 of 2)")));
}

// Somebody in the middle of the room goes on only when the robot is a metre off.
TEST(RouteDriver, YieldsToSomebodyWhoWaits) {
  const auto drive = [](int rounds) {
    FakeHost host(kTwoDoors, kKnown);
    RouteSettings settings;
    settings.rounds = rounds;
    Driving driving(settings, kOtherRoom);
    bool is_gone = false;
    host.collision_monitor = [&](const Pose2& pose, const Twist& wanted) {
      const double distance_m = (pose.position() - Point(1.6, 0.8)).norm();
      is_gone = is_gone || (host.time_s > 20.0 && distance_m > 1.2);
      const bool is_held = !is_gone && pose.x_m > 1.2 && wanted.v_mps > 0.0 && std::abs(pose.theta_rad) < 1.5;
      return is_held ? Twist{0.0, wanted.w_radps} : wanted;
    };
    const Status status = host.run(driving, 400.0);
    EXPECT_EQ(status.state, is_gone ? StepState::success : StepState::failure) << status.reason << host.picture();
    EXPECT_LT(host.time_s, 390.0);
    return is_gone;
  };
  EXPECT_FALSE(drive(2)) << "backing up is not enough";
  EXPECT_TRUE(drive(6));
}

// Seven sonars to the front; while it is closed they see a leaf at x = 1.5 m that the map does not have.
std::function<Observation(const FakeHost&)> sonars_before_leaf(const bool& is_closed) {
  return [&is_closed](const FakeHost& self) {
    Observation seen;
    for (int i = 0; i < 7; ++i) {
      RangeReading reading;
      reading.sensor = i;
      reading.T_robot_sensor = {0.0, 0.0, radians(15.0 * (i - 3))};
      reading.half_beam_rad = radians(12.0);
      reading.min_m = 0.1;
      reading.max_m = 4.0;
      const Pose2 from = self.T_map_robot * reading.T_robot_sensor;
      const Point along{std::cos(from.theta_rad), std::sin(from.theta_rad)};
      reading.range_m = 0.1;
      while (reading.range_m < 3.0 && !self.is_solid(from.position() + along * reading.range_m) &&
             !(is_closed && from.x_m < 1.5 && from.x_m + along.x() * reading.range_m >= 1.5))
        reading.range_m += 0.01;
      seen.ranges.push_back(reading);
    }
    return seen;
  };
}

// Ticks until it looks whether the path is free (or no longer does), for so long at most.
void run_until_look(FakeHost& host, Driving& driving, bool looks, double at_most_s) {
  const double until_s = host.time_s + at_most_s;
  Status status;
  do {
    status = host.tick(driving);
  } while (host.time_s < until_s && status.state == StepState::running &&
           status.reason.starts_with("looking") != looks);
}

TEST(RouteDriver, LooksAtWhatHoldsItBackUntilItHasGone) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  bool is_closed = true;
  host.observe = sonars_before_leaf(is_closed);
  run_until_look(host, driving, true, 120.0);
  const double looks_s = host.time_s;
  EXPECT_LT(looks_s, 100.0);
  host.run(driving, 10.0);
  EXPECT_LT(std::abs(host.T_map_robot.theta_rad), radians(60.0)) << "faces it";
  is_closed = false;
  run_until_look(host, driving, false, 60.0);
  EXPECT_LT(host.time_s, looks_s + 10.0 + 4.0) << "goes on as soon as echoes come from behind";
  const Status status = host.run(driving, 60.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
}

TEST(RouteDriver, LooksForLongWhereItStaysInTheWay) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  const bool is_closed = true;
  host.observe = sonars_before_leaf(is_closed);
  run_until_look(host, driving, true, 120.0);
  const double looks_s = host.time_s;
  run_until_look(host, driving, false, 60.0);
  EXPECT_NEAR(host.time_s - looks_s, 25.0, 1.0);
}

// A path there would begin with an arc forwards, into whoever holds it.
TEST(RouteDriver, ACarBacksUpInsteadOfYielding) {
  for (const bool is_car : {false, true}) {
    FakeHost host(kTwoDoors, kKnown);
    if (is_car) {
      host.robot.kinematics = Kinematics::car;
      host.robot.min_turning_radius_m = 0.5;
    }
    Driving driving({}, kOtherRoom);
    host.collision_monitor = [](const Pose2& pose, const Twist& wanted) {
      const bool is_held = pose.x_m > 1.2 && wanted.v_mps > 0.0 && std::abs(pose.theta_rad) < 1.5;
      return is_held ? Twist{0.0, wanted.w_radps} : wanted;
    };
    EXPECT_EQ(host.run(driving, 600.0).state, StepState::failure);
    const bool yielded =
        std::ranges::any_of(host.said, [](const std::string& text) { return text.ends_with("yields"); });
    EXPECT_EQ(yielded, !is_car);
  }
}

TEST(RouteDriver, LooksAtABlockedGoalFromBesideIt) {
  FakeHost host(kTwoDoors, {.sight_m = 0.45, .all_known = true});
  const Point goal = kOtherRoom.pose->position();
  // Drawn by somebody who has gone on, or as part of a wall that was seen from afar.
  for (double x = -0.1; x < 0.15; x += 0.05)
    for (double y = -0.1; y < 0.15; y += 0.05) host.grid.set_log_odds(host.grid.cell_at(goal + Point(x, y)), 600);
  host.planner = [&](const PlanRequest& request) {
    PlanResult result;
    const bool is_free = host.grid.state(host.grid.cell_at(goal)) == CellState::free;
    result.outcome = is_free ? PlanOutcome::solved : PlanOutcome::goal_blocked;
    result.reason = "it lies on an occupied cell";
    result.path = {*request.from.pose, {goal.x(), goal.y(), 0.0}};
    return result;
  };
  Driving driving({}, kOtherRoom);
  const Status status = host.run(driving, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_THAT(host.said, Contains(HasSubstr("looks again at (3.30, 0.50)")));
}

TEST(RouteDriver, GoesOnWhenWhatWasInTheWayHasGone) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  host.run(driving, 3.0);
  host.collision_monitor = [](const Pose2&, const Twist&) { return Twist{}; };
  host.run(driving, 3.0);
  host.collision_monitor = nullptr;
  const std::size_t plans = host.planned.size();
  EXPECT_EQ(host.run(driving, 120.0).state, StepState::success);
  EXPECT_EQ(host.planned.size(), plans) << "waiting was enough";
}

TEST(RouteDriver, ClosesAStoredRouteThatIsBlockedForAWhile) {
  FakeHost host(kTwoDoors, kKnown);
  host.planner = [&](const PlanRequest& request) {
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, {3.3, 0.5, 0.0}};
    const double length_m = (result.path[1].position() - result.path[0].position()).norm();
    result.segments = {{PathSegment::Origin::stored, 7, length_m}};
    result.routes = {7};
    return result;
  };
  Driving driving({}, kOtherRoom);
  host.collision_monitor = [](const Pose2&, const Twist& wanted) {
    return Twist{std::min(0.0, wanted.v_mps), wanted.w_radps};
  };
  host.run(driving, 60.0);
  const auto closed = [](const PlanRequest& request) { return request.closed == std::vector<RouteId>{7}; };
  EXPECT_TRUE(std::ranges::any_of(host.planned, closed));
  EXPECT_THAT(host.said, Contains(HasSubstr("closes route R7")));
}

TEST(RouteDriver, ARouteFoundBlockedIsOpenAgainAfterAWhile) {
  FakeHost host(kTwoDoors, kKnown);
  bool first = true;
  host.planner = [&](const PlanRequest& request) {
    PlanResult result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, *request.from.pose * Pose2{0.05, 0.0, 0.0}, {1.5, 0.9, 0.0}};
    if (first) result.blocked_routes = {5};
    first = false;
    return result;
  };
  Driving driving({}, Place{Pose2{1.5, 0.9, 0.0}, false, {}});
  host.run(driving, 1.0);
  host.collision_monitor = [](const Pose2&, const Twist& wanted) { return Twist{0.0, wanted.w_radps}; };
  host.run(driving, 30.0);
  ASSERT_GT(host.planned.size(), 1U);
  EXPECT_EQ(host.planned.at(1).closed, std::vector<RouteId>{5});
  host.run(driving, 120.0);
  EXPECT_THAT(host.planned.back().closed, testing::IsEmpty());
}

TEST(RouteDriver, FindsAWayOutWhereTheMapSaysItStandsInAWall) {
  FakeHost host(kTwoDoors, kKnown);
  // As after a kidnapping: the map has cells about the robot that it holds occupied.
  for (double y = 0.85; y < 1.1; y += 0.05) host.grid.set_log_odds(host.grid.cell_at({0.65, y}), 600);
  host.planner = [&, asked = 0](const PlanRequest& request) mutable {
    PlanResult result;
    if (++asked <= 3) {
      result.outcome = PlanOutcome::start_blocked;
      result.reason = "something is in the way";
      return result;
    }
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, {1.2, 0.5, 0.0}};
    return result;
  };
  Driving driving({}, Place{Pose2{1.2, 0.5, 0.0}, false, {}});
  const Status status = host.run(driving, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
}

// Over a whole drive, with a blockage and turns in place.
TEST(RouteDriver, KeepsWithinTheDynamicWindowFromTickToTick) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  std::vector<Twist> ordered;
  host.collision_monitor = [&](const Pose2&, const Twist& wanted) {
    ordered.push_back(wanted);
    return wanted;
  };
  EXPECT_EQ(host.run(driving, 120.0).state, StepState::success);
  const double max_v = host.robot.max_acceleration_mps2 * 0.04 + 1e-9;
  const double max_w = host.robot.max_turn_acceleration_radps2 * 0.04 + 1e-9;
  for (std::size_t i = 1; i + 1 < ordered.size(); ++i) {
    EXPECT_LE(std::abs(ordered[i].v_mps - ordered[i - 1].v_mps), max_v) << "tick " << i;
    EXPECT_LE(std::abs(ordered[i].w_radps - ordered[i - 1].w_radps), max_w) << "tick " << i;
  }
}

TEST(RouteDriver, BeginsAfreshAfterARestart) {
  FakeHost host(kTwoDoors, kKnown);
  Driving driving({}, kOtherRoom);
  host.run(driving, 2.0);
  const std::size_t plans = host.planned.size();
  driving.halt();
  EXPECT_EQ(host.run(driving, 120.0).state, StepState::success);
  EXPECT_GT(host.planned.size(), plans);
}

}  // namespace
}  // namespace cairn::behaviours
