#include "plugins/behaviours/errands/tour.hpp"

#include <gmock/gmock.h>

#include "plugins/behaviours/errands/return_home.hpp"
#include "tests/plugins/behaviours/fake_host.hpp"
#include "tests/plugins/behaviours/written_config.hpp"

namespace cairn::behaviours {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

// 4 x 2.4 m; the cell in the east is shut.
const std::string kHall = R"(
  ########################################
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #....R.........................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  #..............................#.......#
  ########################################
)";

FakeHost hall() {
  FakeHost host(kHall, {.all_known = true});
  host.graph.add(landmark_at("square", {2.6, 1.4, 0.0}, {2.6, 1.2, 0.0}));
  host.graph.add(landmark_at("circle", {0.5, 1.4, 0.0}, {0.5, 1.2, 0.0}));
  return host;
}

Tour tour(const std::string& yaml) {
  return Tour(config_of<TourConfig>(yaml), 1);
}

double nearest_m(const FakeHost& host, const Point& p) {
  double nearest = 1e9;
  for (const Pose2& pose : host.driven) nearest = std::min(nearest, (pose.position() - p).norm());
  return nearest;
}

TEST(Tour, VisitsAllPlacesInTheGivenOrder) {
  FakeHost host = hall();
  Tour step = tour("{places: [L1, nearest circle, [1.5, 0.5]], tolerance_m: 0.05}");
  const Status status = host.run(step, 200.0);
  EXPECT_EQ(status, (Status{StepState::success, "visited 3 of 3 places: L1 (square), L2 (circle), (1.50, 0.50)"}));
  for (const Point& p : {Point(2.6, 1.2), Point(0.5, 1.2), Point(1.5, 0.5)}) EXPECT_LT(nearest_m(host, p), 0.12);
  EXPECT_LT((host.T_map_robot.position() - Point(1.5, 0.5)).norm(), 0.12);
}

TEST(Tour, TakesTheShortestOrderWhenAsked) {
  FakeHost given = hall();
  FakeHost shortest = hall();
  Tour as_given = tour("[[2.6, 0.5], [0.5, 0.5], [2.0, 0.5]]");
  Tour as_short = tour("{places: [[2.6, 0.5], [0.5, 0.5], [2.0, 0.5]], order: shortest}");
  EXPECT_EQ(given.run(as_given, 200.0).state, StepState::success);
  EXPECT_EQ(shortest.run(as_short, 200.0),
            (Status{StepState::success, "visited 3 of 3 places: (0.50, 0.50), (2.00, 0.50), (2.60, 0.50)"}));
  EXPECT_THAT(shortest.said.front(), HasSubstr("the shortest order is (0.50, 0.50), (2.00, 0.50), (2.60, 0.50)"));
  EXPECT_LT(shortest.driven_m, 0.7 * given.driven_m);
}

TEST(Tour, FailsAtAPlaceThatCannotBeReached) {
  FakeHost host = hall();
  Tour step = tour("[[3.5, 0.5], L1]");
  const Status status = host.run(step, 400.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("cannot get to (3.50, 0.50) (no_route: "));
  EXPECT_THAT(status.reason, HasSubstr("; visited 0 of 2 places"));
}

TEST(Tour, LeavesOutWhatCannotBeReachedWhenAskedTo) {
  FakeHost host = hall();
  Tour step = tour("{places: [[3.5, 0.5], L1, nearest squirrel], skip: true}");
  const Status status = host.run(step, 600.0);
  EXPECT_EQ(status.state, StepState::success);
  EXPECT_THAT(status.reason, HasSubstr("visited 1 of 3 places: L1 (square); left out: (3.50, 0.50) (no_route: "));
  EXPECT_THAT(status.reason, HasSubstr("nearest squirrel (no landmark of category \"squirrel\""));
}

TEST(Tour, OfNothingThatCanBeReachedFails) {
  FakeHost host = hall();
  Tour step = tour("{places: [L7, L8], skip: true, order: shortest}");
  const Status status = host.run(step, 60.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason,
              AllOf(HasSubstr("visited 0 of 2 places; left out: "), HasSubstr("L7 (no landmark \"L7\"")));
}

TEST(Tour, WaitsAtEachPlaceAndRunsOutOfTime) {
  FakeHost host = hall();
  Tour step = tour("{places: [[0.5, 0.5], [0.9, 0.5]], wait_s: 20, at_most_s: 30}");
  const Status status = host.run(step, 200.0);
  EXPECT_EQ(status.state, StepState::failure);
  EXPECT_THAT(status.reason, HasSubstr("time is up: visited"));
  EXPECT_NEAR(host.time_s, 30.0, 0.1);
}

TEST(Tour, ReportsHowLongTheWayToThePlaceStillTakes) {
  FakeHost host = hall();
  Tour step = tour("{places: [[2.6, 0.5]]}");
  EXPECT_GT(host.first_left_s(step, 20.0).value_or(0.0), 1.0);
  Patrol patrol(config_of<PatrolConfig>("{rounds: 1, places: [[0.5, 1.4]]}"), 1);
  EXPECT_GT(host.first_left_s(patrol, 20.0).value_or(0.0), 1.0);
}

TEST(Tour, ReportsWhereItsSettingsAreWrong) {
  EXPECT_EQ(error_of([] { tour("{places: []}"); }),
            "mission.yaml:1:10: places must be a list of 1 to 50 places, found an empty list");
  EXPECT_THAT(error_of([] { tour("{places: [L1, [1, x]]}"); }), HasSubstr("mission.yaml:1:"));
  EXPECT_THAT(error_of([] { tour("{places: [L1, \"\"]}"); }),
              HasSubstr("mission.yaml:1:15: places: \"\" is not a place"));
  EXPECT_THAT(error_of([] { tour("{places: [nearest]}"); }), HasSubstr("\"nearest\" is not a place"));
  EXPECT_THAT(error_of([] { tour("{places: L1}"); }), HasSubstr("mission.yaml:1:10: places must be a list"));
  EXPECT_THAT(error_of([] { tour("{places: [L1], order: shortes}"); }), HasSubstr("(did you mean \"shortest\"?)"));
  EXPECT_THAT(error_of([] { tour("{place: [L1]}"); }), HasSubstr("(did you mean \"places\"?)"));
  EXPECT_THAT(error_of([] { tour("{places: [L1], skip: 3}"); }), HasSubstr("mission.yaml:1:22: skip must be"));
}

TEST(Patrol, GoesItsRoundsAndCountsThem) {
  FakeHost host = hall();
  Patrol step(config_of<PatrolConfig>("{places: [L1, L2], rounds: 2, wait_s: 1}"), 1);
  EXPECT_EQ(host.run(step, 600.0), (Status{StepState::success, "2 rounds, 4 places visited"}));
  std::vector<std::string> rounds;
  for (const std::string& line : host.said)
    if (line.ends_with("begins")) rounds.push_back(line);
  EXPECT_THAT(rounds, ElementsAre("round 1 of 2 begins", "round 2 of 2 begins"));
}

TEST(Patrol, WithoutPlacesVisitsAllLandmarksThatAreKnownWhenARoundBegins) {
  FakeHost host = hall();
  Patrol step(config_of<PatrolConfig>("forever"), 1);
  while (host.said.empty() || !host.said.back().starts_with("round 2 begins")) {
    ASSERT_EQ(host.tick(step).state, StepState::running);
    ASSERT_LT(host.time_s, 300.0);
    if (host.time_s > 5.0 && host.graph.landmarks().size() == 2)
      host.graph.add(landmark_at("triangle", {1.5, 0.3, 0.0}, {1.5, 0.5, 0.0}));
  }
  const auto done =
      std::ranges::find_if(host.said, [](const std::string& s) { return s.starts_with("round 1 is done"); });
  ASSERT_NE(done, host.said.end());
  EXPECT_THAT(*done, HasSubstr("visited 2 of 2 places"));
  while (!host.said.back().starts_with("round 2 is done")) {
    ASSERT_EQ(host.tick(step).state, StepState::running);
    ASSERT_LT(host.time_s, 600.0);
  }
  EXPECT_THAT(host.said.back(), HasSubstr("visited 3 of 3 places"));
}

TEST(Patrol, LeavesOutALandmarkThatItChoseItselfAndThatIsRetiredDuringTheRound) {
  FakeHost host = hall();
  host.graph.add(landmark_at("triangle", {1.5, 0.3, 0.0}, {1.5, 0.5, 0.0}));
  Patrol step(config_of<PatrolConfig>("1"), 1);
  EXPECT_EQ(host.run(step, 1.0).state, StepState::running);
  host.graph.retire(3, "merged into L2");
  EXPECT_EQ(host.run(step, 300.0), (Status{StepState::success, "1 round, 2 places visited, 1 left out"}));
  EXPECT_THAT(host.said.back(), HasSubstr("left out: L3 (no landmark \"L3\""));

  FakeHost asked = hall();
  asked.graph.add(landmark_at("triangle", {1.5, 0.3, 0.0}, {1.5, 0.5, 0.0}));
  Patrol named(config_of<PatrolConfig>("{rounds: 1, places: [L1, L3]}"), 1);
  EXPECT_EQ(asked.run(named, 1.0).state, StepState::running);
  asked.graph.retire(3, "merged into L2");
  EXPECT_EQ(asked.run(named, 300.0).state, StepState::failure) << "that one was asked for";
}

TEST(Patrol, SaysHowManyLandmarksARoundLeavesOut) {
  FakeHost host = hall();
  for (int i = 0; i < 51; ++i) host.graph.add(landmark_at("circle", {1.5, 0.3, 0.0}, {1.5, 0.5, 0.0}));
  Patrol step(config_of<PatrolConfig>("1"), 1);
  EXPECT_EQ(host.tick(step).state, StepState::running);
  EXPECT_THAT(host.said, ElementsAre("a round has 50 places at most: 3 of 53 landmarks are left out of it",
                                     "round 1 of 1 begins"));
}

TEST(Patrol, ARobotAtItsOnlyPlacePausesBetweenRoundsAndReportsFewOfThem) {
  FakeHost host = hall();
  Patrol step(config_of<PatrolConfig>("{places: [L1], rounds: forever, min_round_s: 10}"), 1);
  EXPECT_EQ(host.run(step, 1000.0).state, StepState::running);
  std::vector<std::string> done;
  for (const std::string& line : host.said)
    if (line.find("is done: ") != std::string::npos) done.push_back(line.substr(0, line.find(':')));
  EXPECT_THAT(done, ElementsAre("round 1 is done", "round 2 is done", "round 100 is done"));
  Patrol short_one(config_of<PatrolConfig>("{places: [L1], rounds: 5, min_round_s: 10}"), 1);
  const double begun_s = host.time_s;
  EXPECT_EQ(host.run(short_one, 1000.0).state, StepState::success);
  EXPECT_GE(host.time_s - begun_s, 40.0) << "four pauses";
  EXPECT_LE(host.time_s - begun_s, 60.0);
}

TEST(Patrol, FailsWithoutLandmarksAndReportsWrongRounds) {
  FakeHost host(kHall, {.all_known = true});
  Patrol step(config_of<PatrolConfig>("3"), 1);
  EXPECT_EQ(host.run(step, 10.0),
            (Status{StepState::failure, "there is nothing to patrol: the map holds no landmark"}));
  const auto patrol = [](const char* yaml) { return Patrol(config_of<PatrolConfig>(yaml), 1); };
  EXPECT_EQ(error_of([&] { patrol("{rounds: forevr}"); }),
            "mission.yaml:1:10: rounds must be forever or a number, found \"forevr\" (did you mean \"forever\"?)");
  EXPECT_THAT(error_of([&] { patrol("{rounds: 0}"); }), HasSubstr("mission.yaml:1:10: rounds must be"));
  EXPECT_THAT(error_of([&] { patrol("{places: [L1]}"); }), HasSubstr("rounds"));
}

TEST(ReturnHome, GoesBackToWhereTheMissionBeganAndFacesAsThere) {
  FakeHost host = hall();
  host.T_map_start = {2.6, 0.5, 1.0};
  ReturnHome step(config_of<ReturnHomeConfig>("{}"), 1);
  EXPECT_EQ(host.run(step, 100.0), (Status{StepState::success, "home at (2.60, 0.50)"}));
  EXPECT_LT((host.T_map_robot.position() - Point(2.6, 0.5)).norm(), 0.13);
  EXPECT_NEAR(host.T_map_robot.theta_rad, 1.0, radians(4.0));
}

TEST(ReturnHome, GoesToItsDockByName) {
  FakeHost host = hall();
  host.graph.find(1)->name = "dock";
  ReturnHome step(config_of<ReturnHomeConfig>("dock"), 1);
  EXPECT_EQ(host.run(step, 100.0), (Status{StepState::success, "home at dock"}));
  EXPECT_LT((host.T_map_robot.position() - Point(2.6, 1.2)).norm(), 0.13);
  ReturnHome lost(config_of<ReturnHomeConfig>("dok"), 1);
  EXPECT_THAT(host.run(lost, 10.0).reason, HasSubstr("no landmark \"dok\" (did you mean \"dock\"?)"));
  EXPECT_THAT(error_of([] { ReturnHome(config_of<ReturnHomeConfig>("{to: \"\"}"), 1); }),
              HasSubstr("mission.yaml:1:6: to: \"\" is not a landmark; one is"));
}

}  // namespace
}  // namespace cairn::behaviours
