#include "plugins/behaviours/errands/go_to.hpp"

#include <gmock/gmock.h>

#include "plugins/common/motion/path.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

// 3 x 2 m with a bar from the top.
const std::string kRoom = R"(
  ##############################
  #.............##.............#
  #.............##.............#
  #.............##.............#
  #.............##.............#
  #.............##.............#
  #.............##.............#
  #.............##.............#
  #....R........##.............#
  #.............##.............#
  #.............##.............#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  #............................#
  ##############################
)";
const FakeHostSettings kKnown{.all_known = true};

FakeHost host_with_landmarks() {
  FakeHost host(kRoom, kKnown);
  host.graph.add(landmark_at("circle", {0.5, 0.5, 0}, {0.5, 0.5, 0}));
  host.graph.add(landmark_at("square", {2.5, 1.2, 0}, {2.2, 0.8, 0}, "desk"));
  return host;
}

GoToConfig config_for(const std::string& landmark) {
  GoToConfig config;
  config.landmark.kind = ConfigValue::Kind::scalar;
  config.landmark.scalar = landmark;
  return config;
}

// Drives on after the map has moved by 1 m; where it ends, less that.
Point end_when_map_moves(GoTo& go_to, bool is_order = false) {
  FakeHost host(kRoom, kKnown);
  host.values["there"] = Place{Pose2{2.4, 0.4, 0.0}, false, {}};
  if (is_order) go_to.move_with_map(host.view(nullptr));
  EXPECT_EQ(host.run(go_to, 2.0).state, StepState::running);
  host.move_map({1.0, 0.0});
  (void)host.run(go_to, 120.0);
  return host.T_map_robot.position() - Point(1.0, 0.0);
}

GoToConfig config_at(const Point& at_m) {
  GoToConfig config;
  config.at_m = at_m;
  return config;
}

TEST(GoTo, APlaceThatWasGivenMovesWithTheMap) {
  GoToConfig by_input;
  by_input.input = "there";
  GoTo given(by_input, 1);
  EXPECT_LT((end_when_map_moves(given) - Point(2.4, 0.4)).norm(), 0.15);
  GoTo ordered(config_at({2.4, 0.4}), 1);
  EXPECT_LT((end_when_map_moves(ordered, true) - Point(2.4, 0.4)).norm(), 0.15);
  GoTo written(config_at({2.4, 0.4}), 1);
  EXPECT_LT((end_when_map_moves(written) - Point(1.4, 0.4)).norm(), 0.15) << "a mission's file means what it says";
}

TEST(GoTo, APlaceIsLookedUpAnewWhenAnExchangeOfTheMapWasMissed) {
  FakeHost host(kRoom, kKnown);
  host.values["there"] = Place{Pose2{2.4, 0.4, 0.0}, false, {}};
  GoToConfig by_input;
  by_input.input = "there";
  GoTo given(by_input, 1);
  EXPECT_EQ(host.run(given, 2.0).state, StepState::running);
  host.move_map({1.0, 0.0});
  host.move_map({-0.5, 0.0});
  host.values["there"] = Place{Pose2{2.9, 0.4, 0.0}, false, {}};  // as the mission keeps it
  EXPECT_EQ(host.run(given, 120.0).state, StepState::success) << host.picture();
  EXPECT_LT((host.T_map_robot.position() - Point(2.9, 0.4)).norm(), 0.15);
}

TEST(GoTo, ReachesAPlaceWithinTheTolerance) {
  FakeHost host(kRoom, kKnown);
  GoTo go(config_at({2.4, 1.4}), 1);
  const Status status = host.run(go, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_LT((host.T_map_robot.position() - Point{2.4, 1.4}).norm(), 0.1 + 1e-9);
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m);
}

TEST(GoTo, TurnsToTheWantedAngle) {
  FakeHost host(kRoom, kKnown);
  GoToConfig config = config_at({1.0, 0.5});
  config.angle_rad = radians(135.0);
  GoTo go(config, 1);
  EXPECT_EQ(host.run(go, 120.0).state, StepState::success);
  EXPECT_NEAR(degrees(host.T_map_robot.theta_rad), 135.0, 4.0);
  EXPECT_TRUE(host.planned.at(0).to.heading_matters);
}

TEST(GoTo, FacesTheLandmarkInTheEnd) {
  FakeHost host = host_with_landmarks();
  GoTo go(config_for("desk"), 1);
  const Status status = host.run(go, 120.0);
  EXPECT_EQ(status, (Status{StepState::success, "at desk (square)"}));
  EXPECT_LT(std::abs(motion::heading_error(host.T_map_robot, {2.5, 1.2})), radians(4.0));
}

TEST(GoTo, AsksForAllLandmarksOfTheNearestCategory) {
  FakeHost host = host_with_landmarks();
  host.graph.add(landmark_at("square", {0.5, 1.5, 0}, {0.5, 1.2, 0}));
  GoTo go(config_for("nearest square"), 5);
  EXPECT_EQ(host.tick(go).state, StepState::running);
  ASSERT_EQ(host.planned.size(), 1U);
  EXPECT_EQ(host.planned[0].to.landmarks, (std::vector<LandmarkId>{2, 3}));
  EXPECT_EQ(host.planned[0].seed, 5U);
  EXPECT_GE(host.planned[0].radius_m, host.robot.radius_m);
}

// As planners do: a place that names an unknown landmark is refused as a whole.
TEST(GoTo, LooksItsGoalUpAgainWhenOneOfItsLandmarksIsRetired) {
  FakeHost host = host_with_landmarks();
  host.graph.add(landmark_at("square", {0.5, 1.5, 0}, {0.5, 1.2, 0}));
  GoTo go(config_for("nearest square"), 5);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(host.tick(go).state, StepState::running);
  host.graph.retire(3, "merged into L2");
  host.planned.clear();
  const Status status = host.run(go, 60.0);
  EXPECT_EQ(status, (Status{StepState::success, "at desk (square)"}));
  ASSERT_FALSE(host.planned.empty());
  for (const PlanRequest& request : host.planned) EXPECT_EQ(request.to.landmarks, (std::vector<LandmarkId>{2}));
}

TEST(GoTo, NamesTheLandmarksThereAreWhenItDoesNotKnowOne) {
  FakeHost host = host_with_landmarks();
  GoTo go(config_for("desc"), 1);
  const Status status = host.tick(go);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("no landmark \"desc\""));
  EXPECT_THAT(status.reason, HasSubstr("did you mean \"desk\"?"));
  EXPECT_THAT(status.reason, HasSubstr("the map holds L1 (circle), desk (square)"));
}

TEST(GoTo, NamesTheNearestCategoryWhenItDoesNotKnowOne) {
  FakeHost host = host_with_landmarks();
  GoTo go(config_for("nearest squre"), 1);
  const Status status = host.tick(go);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("did you mean \"square\"?"));
  EXPECT_TRUE(host.planned.empty());
}

TEST(GoTo, SaysThatAnEmptyMapHoldsNoLandmark) {
  FakeHost host(kRoom, kKnown);
  GoTo go(config_for("L3"), 1);
  EXPECT_EQ(host.tick(go).reason, "no landmark \"L3\"; the map holds no landmark");
}

TEST(GoTo, GivesUpWithThePlannersOutcomeAndSentence) {
  FakeHost host(kRoom, kKnown);
  host.planner = [](const PlanRequest&) {
    PlanResult result;
    result.outcome = PlanOutcome::goal_blocked;
    result.reason = "the goal lies in a wall";
    return result;
  };
  GoTo go(config_at({1.5, 1.5}), 1);
  const Status status = host.run(go, 600.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, StartsWith("goal_blocked: the goal lies in a wall"));
  EXPECT_THAT(status.reason, HasSubstr("on the way to (1.50, 1.50)"));
}

TEST(GoTo, DoesNotTakeAnApproximatePlanForAPlan) {
  FakeHost host(kRoom, kKnown);
  host.planner = [&](const PlanRequest&) {
    PlanResult result;
    result.outcome = PlanOutcome::approximate;
    result.reason = "ends 0.4 m short";
    result.path = {host.T_map_robot, {0.9, 1.1, 0}};
    return result;
  };
  GoTo go(config_at({1.5, 1.6}), 1);  // in the bar: elsewhere it would find a path on the local map
  EXPECT_EQ(host.run(go, 600.0).state, StepState::failure);
}

TEST(GoTo, PlansAgainWhenSomethingTurnsUpOnThePath) {
  FakeHost host(kRoom, {.sight_m = 1.0, .all_known = true});
  GoTo go(config_at({2.4, 1.4}), 1);
  host.run(go, 1.0);
  for (double x = 1.2; x < 1.5; x += 0.1) host.solidify({x, 0.75});
  const Status status = host.run(go, 120.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_GT(host.planned.size(), 1U);
  EXPECT_GE(host.nearest_solid_m, host.robot.radius_m) << host.picture();
}

TEST(GoTo, FailsWhenTheWayHasBeenClosed) {
  FakeHost host(kRoom, {.sight_m = 1.0, .all_known = true});
  GoTo go(config_at({2.4, 1.4}), 1);
  host.run(go, 1.0);
  for (double y = 0.05; y < 0.95; y += 0.1) host.solidify({1.45, y});
  const Status status = host.run(go, 600.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, StartsWith("no_route: "));
}

TEST(GoTo, GivesUpAfterBeingBlockedAgainAndAgain) {
  FakeHost host(kRoom, kKnown);
  host.collision_monitor = [](const Pose2&, const Twist& wanted) { return Twist{0.0, wanted.w_radps}; };
  GoTo go(config_at({2.4, 1.4}), 1);
  const Status status = host.run(go, 600.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, StartsWith("blocked at ("));
  EXPECT_THAT(status.reason, HasSubstr("on the way to (2.40, 1.40)"));
}

TEST(GoTo, FailsWhenItsTimeIsUp) {
  FakeHost host(kRoom, kKnown);
  GoToConfig config = config_at({2.4, 1.4});
  config.at_most_s = 2.0;
  GoTo go(config, 1);
  EXPECT_EQ(host.run(go, 60.0), (Status{StepState::failure, "time is up on the way to (2.40, 1.40)"}));
}

TEST(GoTo, MovesAwayFromAWallWhenThePlannerFindsTheStartBlocked) {
  FakeHost host(kRoom, kKnown);
  host.T_map_robot = {0.33, 1.5, radians(180.0)};
  GoTo go(config_at({0.8, 0.6}), 1);
  host.planner = [&](const PlanRequest& request) {
    PlanResult result;
    result.outcome = request.from.pose->x_m < 0.36 ? PlanOutcome::start_blocked : PlanOutcome::solved;
    result.path = {*request.from.pose, {0.8, 0.6, 0}};
    return result;
  };
  EXPECT_EQ(host.run(go, 60.0).state, StepState::success) << host.picture();
}

TEST(GoTo, NeedsExactlyOneGoal) {
  EXPECT_THROW(GoTo({}, 1), ConfigError);
  GoToConfig both = config_for("L1");
  both.at_m = Point{1.0, 1.0};
  EXPECT_THROW(GoTo(both, 1), ConfigError);
  for (const char* nothing : {"\"\"", "nearest", "\"nearest \""})
    EXPECT_THAT(
        error_of([&] { GoTo(config_of<GoToConfig>(std::string("landmark: ") + nothing), 1); }),
        AllOf(StartsWith("mission.yaml:1:11: landmark: "), HasSubstr(" is not a landmark; one is an id (L3), a")))
        << nothing;
}

TEST(GoTo, GoesToThePlaceThatAnEarlierStepGives) {
  FakeHost host(kRoom, kKnown);
  GoToConfig config;
  config.input = "found";
  GoTo there(config, 1);
  EXPECT_THAT(host.run(there, 1.0).reason, HasSubstr("no step has given the place \"found\" yet"));
  there.halt();
  host.values["found"] = Place{Pose2{1.5, 0.5, 0.0}, false, {}};
  const Status status = host.run(there, 60.0);
  EXPECT_EQ(status.state, StepState::success) << status.reason << host.picture();
  EXPECT_EQ(status.reason, "at the place \"found\"");
}

TEST(GoTo, BeginsAfreshAfterAHalt) {
  FakeHost host(kRoom, kKnown);
  GoTo go(config_at({2.4, 1.4}), 1);
  host.run(go, 2.0);
  go.halt();
  EXPECT_EQ(host.run(go, 120.0).state, StepState::success);
  EXPECT_GE(host.planned.size(), 2U);
}

TEST(GoTo, AnswersToAPairAsToAPlaceOfTheMap) {
  FakeHost host(kRoom, kKnown);
  GoTo there(config_of<GoToConfig>("[1.5, 0.5]"), 1);
  EXPECT_EQ(host.run(there, 60.0).reason, "at (1.50, 0.50)");
  there.halt();
  EXPECT_EQ(host.run(there, 60.0).state, StepState::success) << "again after a halt";
}

TEST(GoTo, ReadsAPlaceThatIsWrittenAsText) {
  for (const char* place : {"'1.0,0.5'", "1.0, 0.5", "'[1, 0.5]'", "{landmark: '1,0.5'}"}) {
    FakeHost host(kRoom, kKnown);
    GoTo go(config_of<GoToConfig>(place), 1);
    const Status status = host.run(go, 60.0);
    EXPECT_EQ(status.state, StepState::success) << status.reason;
    EXPECT_LT((host.T_map_robot.position() - Point{1.0, 0.5}).norm(), 0.1 + 1e-9) << place;
  }
}

TEST(GoTo, SaysHowAPlaceIsWritten) {
  EXPECT_EQ(error_of([] { GoTo(config_of<GoToConfig>("[1, 2, 3]"), 1); }),
            "mission.yaml:1:1: goto must be a point [x, y], found a list of 3");
  EXPECT_EQ(error_of([] { GoTo(config_of<GoToConfig>("'1,2,90'"), 1); }),
            "mission.yaml:1:1: goto must be a point [x, y], found a list of 3");
  EXPECT_EQ(error_of([] { GoTo(config_of<GoToConfig>("{landmark: [1, 2], at_m: [1, 2]}"), 1); }),
            "mission.yaml:1:12: goto: landmark and at_m exclude each other");
}

}  // namespace
}  // namespace cairn::behaviours
