#include "plugins/behaviours/docking/dock.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "plugins/common/motion/path.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::HasSubstr;

// 4 x 3 m; a block of 0.4 m about (2.0, 1.6), a wall 0.5 m west of it.
const std::string kRoom = R"(
  ########################################
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #............#.....####................#
  #............#.....####................#
  #............#.....####................#
  #............#.....####................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  #.....R................................#
  #......................................#
  #......................................#
  #......................................#
  #......................................#
  ########################################
)";
const Point kCentre{2.1, 1.6};
constexpr double kHalf_m = 0.2;

FakeHost room(double turned_rad = 0.0) {
  FakeHost host(kRoom, {.all_known = true});
  host.graph.add(landmark_at("square", {kCentre.x(), kCentre.y(), turned_rad}, {2.1, 0.9, 0.0}));
  return host;
}

Dock dock(const std::string& yaml) {
  return Dock(config_of<DockConfig>(yaml), 1);
}

// Between the footprint and the block, along the side's normal.
double gap_m(const FakeHost& host) {
  const Point d = (host.T_map_robot.position() - kCentre).cwiseAbs();
  return std::max(d.x(), d.y()) - kHalf_m - host.robot.radius_m;
}

TEST(OutlineDistance, IsThatOfTheMap) {
  const FakeHost host = room();
  EXPECT_NEAR(outline_distance_m(host.grid, kCentre, 0.0).value(), kHalf_m, 0.03);
  EXPECT_NEAR(outline_distance_m(host.grid, kCentre, std::numbers::pi / 2).value(), kHalf_m, 0.03);
  EXPECT_FALSE(outline_distance_m(host.grid, {3.2, 0.7}, std::numbers::pi / 2).has_value());
}

TEST(Dock, StopsAtTheDistanceOnEachSideAndFacesTheLandmark) {
  for (const auto& [side, outward] :
       {std::pair{"front", Point(1, 0)}, std::pair{"left", Point(0, 1)}, std::pair{"right", Point(0, -1)}}) {
    FakeHost host = room();
    Dock step = dock(std::string("{landmark: L1, distance_m: 0.2, side: ") + side + "}");
    const Status status = host.run(step, 200.0);
    ASSERT_EQ(status.state, StepState::success) << side << ": " << status.reason << host.picture();
    EXPECT_THAT(status.reason, HasSubstr(std::string("docked at the ") + side + " side of L1 (square), 0.2"));
    EXPECT_THAT(status.reason, HasSubstr("by the map"));
    EXPECT_NEAR(gap_m(host), 0.2, 0.03 + 0.03) << side;  // the map knows the outline to half a cell
    const Point from_block = host.T_map_robot.position() - kCentre;
    EXPECT_GT(from_block.normalized().dot(outward), 0.99) << side << host.picture();
    EXPECT_LT(std::abs(motion::heading_error(host.T_map_robot, kCentre)), radians(6.0));
  }
}

TEST(Dock, TakesSidesInTheLandmarksOwnFrameAndFacesAway) {
  FakeHost host = room(std::numbers::pi / 2);  // its front is in the north
  Dock step = dock("{landmark: nearest square, side_deg: -90, facing: away}");
  const Status status = host.run(step, 200.0);
  ASSERT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_THAT(status.reason, HasSubstr("the side at -90 deg of L1 (square)"));
  EXPECT_NEAR(gap_m(host), 0.4, 0.06);
  EXPECT_GT(host.T_map_robot.x_m, kCentre.x() + 0.5) << "its right is in the east" << host.picture();
  EXPECT_NEAR(wrap_angle(host.T_map_robot.theta_rad), 0.0, radians(4.0));
}

// A transducer that looks ahead; the block is where the grid has it, less a shift.
Observation ahead(const FakeHost& host, double nearer_m) {
  RangeReading reading;
  reading.sensor = 0;
  reading.T_robot_sensor = {0.1, 0.0, 0.0};
  reading.max_m = 5.0;
  reading.range_m = std::numeric_limits<double>::infinity();
  for (double r_m = 0.0; r_m < 4.0; r_m += 0.005) {
    if (!host.is_solid(host.T_map_robot * Point(0.1 + r_m, 0.0))) continue;
    reading.range_m = r_m - nearer_m;
    break;
  }
  Observation seen;
  seen.stamp_s = host.time_s;
  seen.ranges = {reading};
  return seen;
}

RobotModel with_sonar_ahead(RobotModel robot) {
  robot.sonars.resize(1);
  robot.sonars[0].T_robot_sonar = {0.1, 0.0, 0.0};
  return robot;
}

TEST(Dock, BelievesTheEchoesMoreThanTheMap) {
  for (const double nearer_m : {0.0, 0.08, -0.08}) {
    FakeHost host = room();
    host.robot = with_sonar_ahead(host.robot);
    host.observe = [nearer_m](const FakeHost& now) { return ahead(now, nearer_m); };
    Dock step = dock("{landmark: L1, side: right}");
    const Status status = host.run(step, 200.0);
    ASSERT_EQ(status.state, StepState::success) << status.reason;
    EXPECT_THAT(status.reason, HasSubstr("by its echoes"));
    EXPECT_NEAR(gap_m(host) - nearer_m, 0.4, 0.03) << nearer_m;
  }
}

TEST(Dock, WaitsForWhatStandsBetweenAndFailsWhenItStays) {
  FakeHost host = room();
  host.robot = with_sonar_ahead(host.robot);
  host.observe = [](const FakeHost& now) {
    return ahead(now, (now.T_map_robot.position() - kCentre).norm() < 1.1 ? 0.4 : 0);
  };
  Dock step = dock("{landmark: L1, side: right, patience_s: 5}");
  const Status status = host.run(step, 200.0);
  EXPECT_EQ(status,
            (Status{StepState::failure, "something stands between the robot and the right side of L1 (square)"}));
}

bool is_near(const FakeHost& host) {
  return (host.T_map_robot.position() - kCentre).norm() < 1.1;
}

// The second one looks as straight ahead, and past it.
TEST(Dock, SilenceOfAnotherTransducerDoesNotClearWhatStandsBetween) {
  for (const bool silent_first : {false, true}) {
    FakeHost host = room();
    host.robot = with_sonar_ahead(host.robot);
    host.observe = [&](const FakeHost& now) {
      Observation seen = ahead(now, is_near(now) ? 0.4 : 0.0);
      RangeReading silent = seen.ranges.front();
      silent.sensor = 1;
      silent.range_m = std::numeric_limits<double>::infinity();
      seen.ranges.insert(silent_first ? seen.ranges.begin() : seen.ranges.end(), silent);
      return seen;
    };
    Dock step = dock("{landmark: L1, side: right, patience_s: 5}");
    EXPECT_THAT(host.run(step, 200.0).reason, HasSubstr("something stands between the robot and the right side"));
  }
}

TEST(Dock, WaitingForWhatStandsBetweenDoesNotCountAsBeingBlocked) {
  FakeHost host = room();
  host.robot = with_sonar_ahead(host.robot);
  double near_since_s = -1.0;
  // Somebody steps before it for three seconds, aside for a moment, and once more.
  host.observe = [&](const FakeHost& now) {
    if (near_since_s < 0.0 && is_near(now)) near_since_s = now.time_s;
    const double near_s = near_since_s < 0.0 ? -1.0 : now.time_s - near_since_s;
    return ahead(now, (near_s >= 0.0 && near_s < 3.0) || (near_s > 3.15 && near_s < 6.5) ? 0.4 : 0.0);
  };
  Dock step = dock("{landmark: L1, side: right, patience_s: 5}");
  const Status status = host.run(step, 200.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason;
}

TEST(Dock, StaysOnItsSideWhenTheLandmarkIsTurnedOnTheMap) {
  FakeHost host = room();
  Dock step = dock("{landmark: L1, side: right}");
  EXPECT_EQ(host.run(step, 4.0).state, StepState::running);
  host.graph.find(1)->T_map_landmark.theta_rad = std::numbers::pi / 2;  // a square looks the same
  const Status status = host.run(step, 200.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_LT(host.T_map_robot.y_m, kCentre.y() - 0.5) << host.picture();
  EXPECT_NEAR(gap_m(host), 0.4, 0.06);
}

TEST(Dock, FailsWhereTheSideIsBlocked) {
  FakeHost host = room();
  Dock step = dock("{landmark: L1, side: back}");
  const Status status = host.run(step, 60.0);
  EXPECT_EQ(status, (Status{StepState::failure,
                            "the back side of L1 (square) is blocked: there is no free path to it on the map"}));
  EXPECT_EQ(host.driven_m, 0.0);
}

TEST(Dock, FailsWhenItIsBlocked) {
  FakeHost host = room();
  host.collision_monitor = [](const Pose2& pose, const Twist& wanted) {
    return (pose.position() - kCentre).norm() < 0.95 ? Twist{0.0, wanted.w_radps} : wanted;
  };
  Dock step = dock("{landmark: L1, side: right, patience_s: 3}");
  const Status status = host.run(step, 120.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("blocked 0.5"));
  EXPECT_THAT(status.reason, HasSubstr("before the right side of L1 (square), not at 0.40 m"));
}

TEST(Dock, ReportsHowLongItsWayStillTakes) {
  FakeHost host = room();
  Dock step = dock("{landmark: L1, side: right}");
  EXPECT_GT(host.first_left_s(step, 20.0).value_or(0.0), 1.0);
}

TEST(Dock, ReportsWhereItsSettingsAreWrong) {
  EXPECT_THAT(error_of([] { dock("{landmark: L1}"); }),
              HasSubstr("dock: needs a side (`side: left` or `side_deg: 90`)"));
  EXPECT_EQ(error_of([] { dock("{landmark: L1, side: left, side_deg: 3}"); }),
            "mission.yaml:1:22: dock: side and side_deg exclude each other");
  EXPECT_THAT(error_of([] { dock("{landmark: L1, side: lft}"); }), HasSubstr("(did you mean \"left\"?)"));
  EXPECT_THAT(error_of([] { dock("{landmark: L1, side: left, distance_m: near}"); }),
              HasSubstr("mission.yaml:1:40: distance_m must be a number"));
  EXPECT_THAT(error_of([] { dock("{landmark: L1, side: left, facing: awy}"); }), HasSubstr("(did you mean \"away\"?)"));
}

}  // namespace
}  // namespace cairn::behaviours
