// Conformance of modules of kind `planner`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyPlanner, PlannerConformance,
//                            testing::Values(module<cairn::Planner>(FOLDER, "my_planner")));
//   }
//
// A planner need not take every kind of place: one that only knows landmarks answers poses with
// unknown_place, and the other way round. One of the two it must take.
#pragma once

#include <thread>

#include "maps/geometry/segments.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/planner_world.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class PlannerConformance : public Conformance<Planner> {
 protected:
  static constexpr double kRadius_m = 0.22;

  static PlanRequest between(const Pose2& from, const Pose2& to) {
    PlanRequest request;
    request.from.pose = from;
    request.to.pose = to;
    request.radius_m = kRadius_m;
    return request;
  }
  static PlanRequest between(LandmarkId from, LandmarkId to) {
    PlanRequest request;
    request.from.landmarks = {from};
    request.to.landmarks = {to};
    request.radius_m = kRadius_m;
    return request;
  }
  // Through the door, as poses and as landmarks, each way.
  [[nodiscard]] std::vector<PlanRequest> easy_requests() const {
    return {between(world_.left, world_.right), between(world_.right, world_.left), between(1, 2), between(2, 1)};
  }
  // Those of them that this planner takes.
  [[nodiscard]] std::vector<PlanRequest> requests_for(const Planner& planner) const {
    std::vector<PlanRequest> taken;
    for (const PlanRequest& request : easy_requests())
      if (planner.plan(request, world_.view(), Budget{}).outcome != PlanOutcome::unknown_place)
        taken.push_back(request);
    return taken;
  }
  static std::string plan(const Planner& planner, const PlanRequest& request, const WorldView& world) {
    return text_of(planner.plan(request, world, Budget{}));
  }
  // What is wrong with a result whatever its outcome, or empty.
  static std::string fault_of(const PlanResult& result) {
    if (result.reason.empty()) return "no sentence for people in `reason`";
    if (result.time_ms.total_ms < 0.0) return "a negative time";
    const bool has_path = result.outcome == PlanOutcome::solved || result.outcome == PlanOutcome::approximate;
    if (has_path == result.path.empty()) return has_path ? "no path" : "a path, though the outcome is a refusal";
    for (const Pose2& pose : result.path)
      if (!is_finite(pose)) return "the path is not finite at " + text_of(pose);
    if (!std::isfinite(result.cost_m) || result.cost_m < 0.0) return "cost_m is " + text_of(result.cost_m);
    if (std::abs(result.length_m - length_of(result.path)) > 1e-6)
      return "length_m is " + text_of(result.length_m) + ", the path's length " + text_of(length_of(result.path));
    if (!(result.clearance_m >= 0.0)) return "clearance_m is " + text_of(result.clearance_m);
    return {};
  }
  // How far an end of a path is from what was asked.
  static double off_by_m(const Pose2& end, const Place& place, const LandmarkGraph& graph) {
    const Pose2 wanted = place.pose ? *place.pose : *graph.find(place.landmarks.front())->access;
    return (end.position() - wanted.position()).norm();
  }
  void expect_never_solved(const PlanRequest& request, const WorldView& world, const std::string& why) const {
    const PlanResult result = make()->plan(request, world, Budget{});
    EXPECT_NE(result.outcome, PlanOutcome::solved) << why << "; " << text_of(result) << world_.drawing(result.path);
    EXPECT_EQ(fault_of(result), "") << why;
  }

  PlannerWorld world_;
};

TEST_P(PlannerConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(PlannerConformance, OutlivesTheLibraryThatMadeIt) {
  const auto planner = GetParam().make_outliving_library();
  EXPECT_FALSE(requests_for(*planner).empty());
}

TEST_P(PlannerConformance, SolvesTheWayThroughADoor) {
  const auto planner = make();
  const std::vector<PlanRequest> requests = requests_for(*planner);
  ASSERT_FALSE(requests.empty()) << "neither a request between poses nor one between landmarks is taken";
  for (const PlanRequest& request : requests) {
    const PlanResult result = planner->plan(request, world_.view(), Budget{});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason << world_.drawing({});
    EXPECT_EQ(fault_of(result), "");
  }
}

TEST_P(PlannerConformance, ASolvedPathStartsAndEndsWhereItWasAsked) {
  const auto planner = make();
  for (const PlanRequest& request : requests_for(*planner)) {
    const PlanResult result = planner->plan(request, world_.view(), Budget{});
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_LT(off_by_m(result.path.front(), request.from, world_.graph), 1e-6) << world_.drawing(result.path);
    EXPECT_LT(off_by_m(result.path.back(), request.to, world_.graph), 1e-6) << world_.drawing(result.path);
  }
}

TEST_P(PlannerConformance, TheDiscTouchesNothingOnASolvedPath) {
  const auto planner = make();
  for (const PlanRequest& request : requests_for(*planner)) {
    const PlanResult result = planner->plan(request, world_.view(), Budget{});
    EXPECT_GE(distance_to_occupied_m(world_.grid, result.path), kRadius_m - 1e-6)
        << "a disc of radius_m must fit all along a solved path" << world_.drawing(result.path);
  }
}

TEST_P(PlannerConformance, AHeadingThatMattersIsKept) {
  const auto planner = make();
  PlanRequest request = between(world_.left, {world_.right.x_m, world_.right.y_m, 2.0});
  request.to.heading_matters = true;
  const PlanResult result = planner->plan(request, world_.view(), Budget{});
  if (result.outcome != PlanOutcome::solved) return;  // it may refuse, but not ignore
  EXPECT_NEAR(wrap_angle(result.path.back().theta_rad - 2.0), 0.0, 1e-6)
      << "heading_matters: the last pose has the heading that was asked for";
}

TEST_P(PlannerConformance, AGoalInsideAWallIsNeverSolved) {
  expect_never_solved(between(world_.left, world_.in_the_wall), world_.view(), "the goal is inside a wall");
  expect_never_solved(between(world_.in_the_wall, world_.left), world_.view(), "the start is inside a wall");
}

TEST_P(PlannerConformance, AGoalThatNothingLeadsToIsNeverSolved) {
  expect_never_solved(between(world_.left, world_.behind_walls), world_.view(), "the room has no door");
  expect_never_solved(between(1, 3), world_.view(), "no way and no route leads to the landmark");
  expect_never_solved(between(world_.left, world_.outside), world_.view(), "the goal is off the map");
}

TEST_P(PlannerConformance, ADoorTooNarrowForTheRobotIsNotSolved) {
  PlanRequest request = between(world_.left, world_.right);
  for (const double radius_m : {0.35, 3.0, 1e4}) {
    request.radius_m = radius_m;
    expect_never_solved(request, world_.view(), "radius_m is " + text_of(radius_m) + ", the door 0.6 m wide");
  }
}

TEST_P(PlannerConformance, ARadiusThatIsNoneIsRefused) {
  const auto planner = make();
  PlanRequest request = between(world_.left, world_.right);
  for (const double radius_m : {kNan, kInfinity, -1.0, kHuge}) {
    request.radius_m = radius_m;
    try {
      const PlanResult result = planner->plan(request, world_.view(), Budget{});
      EXPECT_NE(result.outcome, PlanOutcome::solved) << "radius_m is " << radius_m;
    } catch (const std::exception& error) {
      EXPECT_STRNE(error.what(), "") << "say what was wrong";
    }
  }
  for (const PlanRequest& good : requests_for(*planner))
    EXPECT_EQ(planner->plan(good, world_.view(), Budget{}).outcome, PlanOutcome::solved)
        << "a good call after a refused one";
}

TEST_P(PlannerConformance, PlacesThatAreNoneAreOutcomesNotExceptions) {
  const auto planner = make();
  for (const Pose2& odd : odd_poses()) {
    if (odd.theta_rad != 0.0 && std::isfinite(odd.theta_rad)) continue;  // a full turn more is no fault
    for (const PlanRequest& request : {between(world_.left, odd), between(odd, world_.left)}) {
      PlanResult result;
      ASSERT_NO_THROW(result = planner->plan(request, world_.view(), Budget{})) << "place " << text_of(odd);
      EXPECT_NE(result.outcome, PlanOutcome::solved) << "place " << text_of(odd);
      EXPECT_EQ(fault_of(result), "") << "place " << text_of(odd);
    }
  }
  PlanRequest nowhere = between(1, 2);
  nowhere.to = {};
  for (const PlanRequest& request : {nowhere, between(1, 77), between(77, 1)})
    EXPECT_EQ(planner->plan(request, world_.view(), Budget{}).outcome, PlanOutcome::unknown_place);
}

TEST_P(PlannerConformance, AnEmptyMapIsAnOutcome) {
  const OccupancyGrid grid(0.1);
  const LandmarkGraph graph;
  const WorldView empty{grid, graph, world_.robot, {}, 0.0, nullptr, 0.0};
  expect_never_solved(between(world_.left, world_.right), empty, "the grid is empty");
  expect_never_solved(between(1, 2), empty, "there are no landmarks");
}

TEST_P(PlannerConformance, ARobotThatIsThereAlreadyHasNoWayToGo) {
  const auto planner = make();
  for (const PlanRequest& request : {between(world_.left, world_.left), between(1, 1)}) {
    const PlanResult result = planner->plan(request, world_.view(), Budget{});
    EXPECT_EQ(fault_of(result), "");
    EXPECT_TRUE(result.outcome != PlanOutcome::solved || result.length_m < 0.1) << world_.drawing(result.path);
  }
}

TEST_P(PlannerConformance, AChangedMapIsPlannedAfresh) {
  const auto planner = make();
  const std::vector<PlanRequest> requests = requests_for(*planner);
  PlannerWorld changed;
  for (const PlanRequest& request : requests)
    ASSERT_EQ(planner->plan(request, changed.view(), Budget{}).outcome, PlanOutcome::solved);
  changed.close_door();
  for (const PlanRequest& request : requests) {
    const PlanResult result = planner->plan(request, changed.view(), Budget{});
    EXPECT_NE(result.outcome, PlanOutcome::solved)
        << "the door has been walled up since the last call; what is kept between calls must be compared with the map"
        << changed.drawing(result.path);
  }
}

TEST_P(PlannerConformance, TheSameRequestGivesTheSameAnswer) {
  const auto first = make();
  const auto second = make();
  for (const PlanRequest& request : requests_for(*first)) {
    const std::string answer = plan(*first, request, world_.view());
    EXPECT_EQ(plan(*first, request, world_.view()), answer) << "the same planner, asked again";
    EXPECT_EQ(plan(*second, request, world_.view()), answer) << "another planner";
  }
}

TEST_P(PlannerConformance, ManyThreadsGetTheAnswersOfOne) {
  constexpr int kThreads = 6;
  const auto planner = make();
  std::vector<PlanRequest> requests = requests_for(*planner);
  requests.push_back(between(world_.left, world_.in_the_wall));
  std::vector<std::string> expected;
  for (const PlanRequest& request : requests) expected.push_back(plan(*planner, request, world_.view()));
  std::vector<std::vector<std::string>> answers(kThreads);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < kThreads; ++i)
      threads.emplace_back([&, i] {
        for (std::size_t k = 0; k < requests.size(); ++k)
          answers[i].push_back(plan(*planner, requests[(k + i) % requests.size()], world_.view()));
      });
  }
  for (int i = 0; i < kThreads; ++i)
    for (std::size_t k = 0; k < requests.size(); ++k)
      EXPECT_EQ(answers[i][k], expected[(k + i) % requests.size()]) << "plan() is const and thread-safe";
}

TEST_P(PlannerConformance, AUsedUpBudgetEndsACallPromptlyWithItsOutcome) {
  const auto planner = make();
  const UsedUpBudget used_up;
  const std::pair<Budget, PlanOutcome> cases[] = {{used_up.cancelled(), PlanOutcome::cancelled},
                                                  {UsedUpBudget::past_deadline(), PlanOutcome::out_of_budget}};
  for (const PlanRequest& request : requests_for(*planner)) {
    for (const auto& [budget, outcome] : cases) {
      PlanResult result;
      EXPECT_LT(seconds_of([&, &budget = budget] { result = planner->plan(request, world_.view(), budget); }),
                kPromptly_s);
      EXPECT_EQ(name_of(result.outcome), name_of(outcome)) << "look at the budget before the work begins";
      EXPECT_EQ(fault_of(result), "");
    }
    EXPECT_EQ(planner->plan(request, world_.view(), Budget{}).outcome, PlanOutcome::solved)
        << "a call with a new budget after one that was cut off";
  }
}

}  // namespace cairn::conformance
