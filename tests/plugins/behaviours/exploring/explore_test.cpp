#include "plugins/behaviours/exploring/explore.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/plugins/behaviours/fake_host.hpp"

namespace cairn::behaviours {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// 4 x 3 m, an object of 0.5 m in the middle.
const std::string kRoomWithObject = R"(
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
  #.....................###..............#
  #....................#####.............#
  #....................#####.............#
  #....................#####.............#
  #.....................###..............#
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
const Point kObjectCentre{2.35, 1.65};

// Two rooms joined by a doorway of 0.9 m.
const std::string kTwoRooms = R"(
  ##################################################
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  #................................................#
  #................................................#
  #................................................#
  #................................................#
  #................................................#
  #......R.........................................#
  #................................................#
  #................................................#
  #................................................#
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  #.......................#........................#
  ##################################################
)";

const std::string kClosedCell = R"(
  ##########
  #........#
  #........#
  #........#
  #........#
  #...R....#
  #........#
  #........#
  #........#
  ##########
)";

// Directions from a point in which the robot has been within a distance, in degrees of 360.
double coverage_deg(const std::vector<Pose2>& driven, const Point& centre, double within_m) {
  std::set<int> sectors;
  for (const Pose2& pose : driven) {
    const Point from_centre = pose.position() - centre;
    if (from_centre.norm() > within_m) continue;
    sectors.insert(static_cast<int>(std::floor(degrees(std::atan2(from_centre.y(), from_centre.x())) / 5.0)));
  }
  return 5.0 * static_cast<double>(sectors.size());
}

// Free squares of the drawing that the grid does not know as free.
int missed_cells(const FakeHost& host) {
  int missed = 0;
  const CellBox box = host.grid.bounds();
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      missed += !host.is_solid(host.grid.centre_of({x, y})) && host.grid.state({x, y}) != CellState::free;
  return missed;
}

TEST(Explore, KnowsTheWholeRoomInTheEndAndTouchesNothing) {
  FakeHost host(kRoomWithObject);
  Explore explore({});
  const Status status = host.run(explore, 900.0);
  EXPECT_EQ(status.state, StepState::success) << host.picture();
  EXPECT_EQ(missed_cells(host), 0) << host.picture();
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m + 0.05) << host.picture();
}

TEST(Explore, CirclesAnObjectThatStandsFree) {
  FakeHost host(kRoomWithObject);
  Explore explore({});
  EXPECT_EQ(host.run(explore, 900.0).state, StepState::success);
  EXPECT_GE(coverage_deg(host.driven, kObjectCentre, 0.25 + 0.9), 330.0) << host.picture();
  // A second orbit would be more than 4 m longer.
  EXPECT_LT(host.driven_m, 18.5) << host.picture();
}

// What it has looked at is elsewhere on the map, and still looked at.
TEST(Explore, LooksAtNothingAgainWhenTheMapHasMoved) {
  const auto driven_m = [](bool moves, bool is_known) {
    FakeHost host(kRoomWithObject);
    Explore explore({});
    EXPECT_EQ(host.run(explore, 75.0).state, StepState::running);
    if (moves) host.move_map({1.5, -1.0});
    if (!is_known) host.last_map_move.reset();
    EXPECT_EQ(host.run(explore, 900.0).state, StepState::success) << host.picture();
    EXPECT_EQ(missed_cells(host), 0) << host.picture();
    return host.driven_m;
  };
  const double still_m = driven_m(false, true);
  EXPECT_LT(driven_m(true, true), still_m + 2.0);
  EXPECT_GT(driven_m(true, false), still_m + 3.0) << "nobody knows where it has looked";
}

TEST(Explore, DrivesNoLapsWhenItNeedNotLookCloser) {
  FakeHost host(kRoomWithObject);
  ExploreConfig config;
  config.look_closer_m = 0.0;
  config.until_known_ratio = 1.0;
  Explore explore(config);
  EXPECT_EQ(host.run(explore, 900.0).state, StepState::success);
  EXPECT_LT(host.driven_m, 6.0) << host.picture();
  EXPECT_LE(missed_cells(host), 20) << host.picture();
}

TEST(Explore, GoesThroughTheDoorwayToTheNextRoom) {
  FakeHost host(kTwoRooms);
  Explore explore({});
  EXPECT_EQ(host.run(explore, 900.0).state, StepState::success) << host.picture();
  EXPECT_EQ(missed_cells(host), 0) << host.picture();
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m) << host.picture();
}

TEST(Explore, PassesEveryWallThatItCanSeeWithinTheLookingDistance) {
  FakeHost host(kTwoRooms);
  Explore explore({});
  EXPECT_EQ(host.run(explore, 900.0).state, StepState::success);
  for (const Point& wall : {Point{0.1, 1.0}, Point{1.2, 0.1}, Point{4.9, 1.0}, Point{3.7, 2.0}, Point{4.9, 1.9}}) {
    double nearest_m = 1e9;
    for (const Pose2& pose : host.driven) nearest_m = std::min(nearest_m, (pose.position() - wall).norm());
    EXPECT_LE(nearest_m, 1.0) << "wall at " << wall.transpose() << host.picture();
  }
}

TEST(Explore, EndsInAClosedCell) {
  FakeHost host(kClosedCell);
  Explore explore({});
  const Status status = host.run(explore, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason;
  EXPECT_LT(host.time_s, 60.0);
}

TEST(Explore, StopsWhenItsTimeIsUpAndSaysSo) {
  FakeHost host(kRoomWithObject);
  ExploreConfig config;
  config.at_most_s = 20.0;
  Explore explore(config);
  const Status status = host.run(explore, 900.0);
  EXPECT_EQ(status.state, StepState::success);
  EXPECT_THAT(status.reason, StartsWith("time is up"));
  EXPECT_NEAR(host.time_s, 20.0, 0.1);
}

TEST(Explore, BeginsNearAWall) {
  FakeHost host(kRoomWithObject);
  host.T_map_robot = {0.34, 0.36, radians(-90.0)};  // 2 to 4 cm between the robot's edge and two walls
  Explore explore({});
  EXPECT_EQ(host.run(explore, 900.0).state, StepState::success) << host.picture();
  EXPECT_EQ(missed_cells(host), 0) << host.picture();
}

TEST(Explore, FailsWhenItCannotMove) {
  FakeHost host("#####\n#...#\n#.R.#\n#...#\n#####", {.character_m = 0.15});
  Explore explore({});
  const Status status = host.run(explore, 120.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("cannot move"));
}

TEST(Explore, FailsWhenTheStopLayerNeverLetsItGo) {
  FakeHost host(kRoomWithObject);
  host.collision_monitor = [](const Pose2&, const Twist& wanted) { return Twist{0.0, wanted.w_radps}; };
  Explore explore({});
  const Status status = host.run(explore, 600.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("blocked wherever it turns"));
}

TEST(Explore, IsNotTrappedByAPlaceWhereItIsBlocked) {
  // Something that the sonars see and the map does not hold stands in the right third of the room.
  FakeHost host(kRoomWithObject);
  host.collision_monitor = [](const Pose2& pose, const Twist& wanted) {
    const Point ahead = pose * Point{std::copysign(0.3, wanted.v_mps), 0.0};
    const bool held = wanted.v_mps != 0.0 && (ahead - Point{3.2, 2.3}).norm() < 0.35;
    return Twist{held ? 0.0 : wanted.v_mps, wanted.w_radps};
  };
  Explore explore({});
  const Status status = host.run(explore, 900.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_LT(host.time_s, 600.0);
  EXPECT_GE(coverage_deg(host.driven, kObjectCentre, 0.25 + 0.9), 250.0) << host.picture();
}

TEST(Explore, DrivesTheSameWayEveryTime) {
  std::vector<Pose2> first;
  for (int i = 0; i < 2; ++i) {
    FakeHost host(kRoomWithObject);
    Explore explore({});
    host.run(explore, 900.0);
    if (i == 0) first = host.driven;
    EXPECT_EQ(host.driven, first);
  }
}

TEST(Explore, BeginsAfreshAfterAHalt) {
  FakeHost host(kRoomWithObject);
  ExploreConfig config;
  config.at_most_s = 10.0;
  Explore explore(config);
  host.run(explore, 8.0);
  explore.halt();
  EXPECT_EQ(host.run(explore, 8.0).state, StepState::running);
  EXPECT_EQ(host.run(explore, 8.0).state, StepState::success);
}

// They differ from those of backing up elsewhere.
TEST(Explore, ListsTheDefaultsThatApply) {
  const Schema schema = schema_of<ExploreConfig>();
  const std::vector<FieldSpec>* fields = &schema.fields;
  for (const char* key : {"exploring", "blocked", "back_up"})
    fields = &std::ranges::find(*fields, key, &FieldSpec::key)->fields;
  const auto listed = [&](const char* key) { return std::ranges::find(*fields, key, &FieldSpec::key)->default_text; };
  const auto loaded = load_config<ExploreConfig>(parse_config_text("", "mission.yaml"), "explore");
  const BackUpSettings& back_up = loaded.exploring.blocked.back_up;
  EXPECT_EQ(listed("distance_m"), config_detail::number_text(back_up.distance_m));
  EXPECT_EQ(listed("at_most_s"), config_detail::number_text(back_up.at_most_s));
  EXPECT_EQ(listed("distance_m"), "0.15");
}

}  // namespace
}  // namespace cairn::behaviours
