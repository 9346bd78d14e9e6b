// What does not make sense is an outcome or an error that says so, never a crash or a hang.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/planners/ompl/kind_cases.hpp"
#include "tests/planners/ompl/ompl_worlds.hpp"

namespace cairn {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;

std::string error_of(const std::string& config, const RobotModel& robot = {}) {
  try {
    (void)OmplPlanner(load_config<OmplConfig>(parse_config_text(config, "mission.yaml"), "plugin ompl"), robot);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "no error";
}

class BadInput : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static OmplPlanner planner() {
    return OmplPlanner(load_config<OmplConfig>(
        parse_config_text("{kinematics: " + GetParam() + ", turning_radius_m: 0.2}", "test"), "plugin ompl"));
  }
  static PathResult plan(const test::DrawnWorld& world, const PathRequest& request, const Budget& budget = {}) {
    PathResult result = planner().plan(request, world.view(), budget);
    EXPECT_FALSE(result.reason.empty());
    EXPECT_EQ(result.path.empty(), result.outcome != PlanOutcome::solved);
    return result;
  }
};

TEST_P(BadInput, PlacesThatAreNoneAreReported) {
  const auto world = test::drawn_world(test::kOffice);
  for (const double odd : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    for (const bool at_start : {true, false}) {
      PathRequest request = world.request('A', 'B', 0.1);
      (at_start ? request.from : request.to).pose->y_m = odd;
      EXPECT_EQ(plan(world, request).outcome, PlanOutcome::unknown_place);
    }
  for (const double far_m : {-3.0, 40.0, 1e12, 1e300}) {
    PathRequest request = world.request('A', 'B', 0.1);
    request.from.pose->x_m = far_m;
    EXPECT_EQ(plan(world, request).outcome, PlanOutcome::start_blocked) << far_m;
    request = world.request('A', 'B', 0.1);
    request.to.pose->x_m = far_m;
    EXPECT_EQ(plan(world, request).outcome, PlanOutcome::goal_blocked) << far_m;
  }
}

TEST_P(BadInput, ADiscLargerThanAnyPassageOrThanTheMap) {
  const auto world = test::drawn_world(test::kOffice);
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.23)).outcome, PlanOutcome::no_route);
  for (const double radius_m : {0.5, 30.0, 1e12})
    EXPECT_EQ(plan(world, world.request('A', 'B', radius_m)).outcome, PlanOutcome::start_blocked) << radius_m;
  for (const double radius_m : {-0.1, std::numeric_limits<double>::infinity()})
    EXPECT_THROW((void)planner().plan(world.request('A', 'B', radius_m), world.view(), {}), std::invalid_argument);
}

TEST_P(BadInput, ABudgetOfNothing) {
  const auto world = test::drawn_world(test::kOffice);
  Budget none;
  none.iterations = 0;
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.1), none).outcome, PlanOutcome::out_of_budget);
  none.iterations = -5;
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.1), none).outcome, PlanOutcome::out_of_budget);
  Budget past;
  past.deadline = Budget::Clock::now() - std::chrono::seconds(1);
  EXPECT_EQ(plan(world, world.request('A', 'B', 0.1), past).outcome, PlanOutcome::out_of_budget);
}

TEST_P(BadInput, MapsOnWhichNothingIsFree) {
  const auto full = test::drawn_world("####\n####\n####\n");
  const auto unseen = test::drawn_world("????\n????\n????\n");
  const test::DrawnWorld empty;
  PathRequest request;
  request.from.pose = Pose2{0.15, 0.15, 0.0};
  request.to.pose = Pose2{0.25, 0.15, 0.0};
  request.radius_m = 0.01;
  for (const test::DrawnWorld* const world : {&full, &unseen, &empty})
    EXPECT_EQ(plan(*world, request).outcome, PlanOutcome::start_blocked);
}

INSTANTIATE_TEST_SUITE_P(Ompl, BadInput, ::testing::Values("disc", "differential", "dubins", "reeds_shepp"),
                         [](const auto& instance) { return instance.param; });

TEST(BadSettings, NamesThatAreNoneComeWithTheNearest) {
  EXPECT_THAT(error_of("algorithm: RRTconect"), AllOf(HasSubstr("mission.yaml:1:12"), HasSubstr("\"RRTConnect\"")));
  EXPECT_THAT(error_of("kinematics: dubin"), AllOf(HasSubstr("mission.yaml:1:13"), HasSubstr("\"dubins\"")));
  EXPECT_THAT(error_of("kinematic: dubins"), AllOf(HasSubstr("mission.yaml:1:1"), HasSubstr("\"kinematics\"")));
  EXPECT_THAT(error_of("algorithm: RRTstar\nparameters: {goal_bais: 0.1}"),
              AllOf(HasSubstr("mission.yaml:2:14"), HasSubstr("\"goal_bias\"")));
}

TEST(BadSettings, ParametersOfTheDefaultAlgorithmAreCheckedBeforeAnythingIsImproved) {
  EXPECT_THAT(error_of("parameters: {goal_bais: 0.1}"),
              AllOf(HasSubstr("mission.yaml:1:14"), HasSubstr("\"goal_bias\"")));
  EXPECT_THAT(error_of("{improve_iterations: 0, parameters: {goal_bias: often}}"),
              HasSubstr("does not take \"often\""));
  EXPECT_EQ(error_of("parameters: {goal_bias: 0.1}"), "no error");
}

TEST(BadSettings, WhatDoesNotGoTogetherIsReported) {
  EXPECT_THAT(error_of("kinematics: dubins"), HasSubstr("needs turning_radius_m"));
  EXPECT_THAT(error_of("{kinematics: reeds_shepp, turning_radius_m: 0}"), HasSubstr("needs turning_radius_m"));
  RobotModel car;
  car.min_turning_radius_m = 0.7;
  EXPECT_EQ(error_of("kinematics: dubins", car), "no error");
  EXPECT_THAT(error_of("{kinematics: dubins, turning_radius_m: 0.5}", car),
              HasSubstr("turning_radius_m 0.5 is tighter than the robot's own min_turning_radius_m 0.7"));
  EXPECT_EQ(error_of("{kinematics: dubins, turning_radius_m: 0.7}", car), "no error");
  EXPECT_EQ(error_of("{kinematics: differential, turning_radius_m: 0.5}", car), "no error") << "it is not asked for";
  RobotModel outlined;
  outlined.polygon_m = {{-0.2, -0.1}, {0.2, -0.1}, {0.2, 0.1}, {-0.2, 0.1}};
  EXPECT_THAT(error_of("footprint: robot", outlined), HasSubstr("the robot's outline is not a disc"));
  EXPECT_THAT(error_of("{kinematics: dubins, turning_radius_m: 1, algorithm: PRM}"),
              AllOf(HasSubstr("does not do for such kinematics"), HasSubstr("BITstar")));
  EXPECT_THAT(error_of("{length_weight: 0, time_weight: 0}"), HasSubstr("must not both be 0"));
}

TEST(BadSettings, AnOutlineThatCrossesItselfIsRefusedBeforeAnyoneAsks) {
  RobotModel crossed;
  crossed.polygon_m = {{-0.2, -0.1}, {0.2, 0.1}, {0.2, -0.1}, {-0.2, 0.1}};
  EXPECT_THAT(error_of("{kinematics: differential, footprint: robot}", crossed), HasSubstr("outline"));
  EXPECT_EQ(error_of("kinematics: differential", crossed), "no error") << "a disc is asked for";
}

}  // namespace
}  // namespace cairn
