#include "planners/common/disc_space/driving_time.hpp"

#include <gtest/gtest.h>

#include "tests/planners/drawn_world.hpp"

namespace cairn {
namespace {

const char* const kHall =
    "##########\n"
    "#A......B#\n"
    "#........#\n"
    "#........#\n"
    "#C......D#\n"
    "#........#\n"
    "##########\n";
constexpr double kRadius_m = 0.2;

WorldView known(const test::DrawnWorld& world) {
  WorldView view = world.view();
  view.speed_law = SpeedLaw{};
  return view;
}

TEST(DrivingTime, ClearancesBesideAStraightWallAreExactBetweenCellsToo) {
  const auto world = test::drawn_world(kHall, 0.05, 6);
  const DiscSpace space(world.grid, GroundRules{});
  const double wall_y_m = 0.3;  // the lower wall's face
  for (double off_m = 0.05; off_m < 0.7; off_m += 0.017)
    EXPECT_NEAR(edge_clearance_m(space.field(), {1.5, wall_y_m + off_m}, kRadius_m), off_m - kRadius_m, 1e-6) << off_m;
}

TEST(DrivingTime, BesideAWallAMetreTakesWhatTheLawAllowsThere) {
  const auto world = test::drawn_world(kHall, 0.05, 6);
  const DiscSpace space(world.grid, GroundRules{});
  const DrivingRules rules = *driving_rules_of(known(world), kRadius_m, 0.0);
  for (const double clearance_m : {0.02, 0.1, 0.2, 0.3}) {
    const double y_m = 0.3 + kRadius_m + clearance_m;
    EXPECT_NEAR(driving_time_s(space.field(), {1.0, y_m}, {2.0, y_m}, rules), rules.pace.s_per_m(clearance_m), 1e-5);
  }
}

TEST(DrivingTime, IsNeverLessThanTheLengthAtTopSpeed) {
  const auto world = test::drawn_world(kHall, 0.05, 6);
  const DiscSpace space(world.grid, GroundRules{});
  for (const double speed_mps : {0.0, 0.1, 0.25}) {
    const DrivingRules rules = *driving_rules_of(known(world), kRadius_m, speed_mps);
    for (const char from : {'A', 'C'})
      for (const char to : {'B', 'D'}) {
        const double length_m = (world.places.at(to) - world.places.at(from)).norm();
        EXPECT_GE(driving_time_s(space.field(), {world.places.at(from), world.places.at(to)}, rules),
                  length_m * rules.pace.min_s_per_m() * (1.0 - 1e-12));
      }
  }
}

TEST(DrivingTime, APointAndARobotThatNobodyKnowsHaveNone) {
  const auto world = test::drawn_world(kHall, 0.05, 6);
  EXPECT_FALSE(driving_rules_of(world.view(), kRadius_m, 0.0));
  EXPECT_FALSE(driving_rules_of(known(world), 0.0, 0.0));
  EXPECT_TRUE(driving_rules_of(known(world), kRadius_m, 0.0));
}

// Behaviours ask for more room than the robot takes.
TEST(DrivingTime, ClearancesAreThoseOfTheRobotNotOfTheDiscThatIsPlannedFor) {
  auto world = test::drawn_world(kHall, 0.05, 6);
  world.robot.radius_m = 0.22;
  EXPECT_EQ(driving_rules_of(known(world), 0.34, 0.0)->radius_m, 0.22);
  EXPECT_EQ(driving_rules_of(known(world), 0.18, 0.0)->radius_m, 0.18);
}

}  // namespace
}  // namespace cairn
