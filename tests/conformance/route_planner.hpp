// Conformance of modules of kind `route_planner`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyPlanner, RoutePlannerConformance,
//                            testing::Values(module<cairn::RoutePlanner>(FOLDER, "my_planner")));
//   }
#pragma once

#include "tests/conformance/planning_laws.hpp"

namespace cairn::conformance {

class RoutePlannerConformance : public PlanningLaws<RoutePlanner, RouteRequest, RouteResult> {
 protected:
  static RouteRequest between(LandmarkId from, LandmarkId to) {
    RouteRequest request;
    request.from = {{from, 0.0}};
    request.to = {{to, 0.0}};
    request.radius_m = kRadius_m;
    return request;
  }
  [[nodiscard]] std::vector<RouteRequest> easy_requests() const override { return {between(1, 2), between(2, 1)}; }
  [[nodiscard]] std::string fault_of(const RouteResult& result) const override {
    if (result.reason.empty()) return "no sentence for people in `reason`";
    if (result.settled < 0) return "settled is " + std::to_string(result.settled);
    if (!std::isfinite(result.cost_m) || result.cost_m < 0.0) return "cost_m is " + text_of(result.cost_m);
    const bool is_solved = result.outcome == PlanOutcome::solved;
    if (is_solved == result.landmarks.empty()) return is_solved ? "no landmarks" : "landmarks without a solution";
    if (!is_solved && !result.routes.empty()) return "routes without a solution";
    if (is_solved && result.landmarks.size() != result.routes.size() + 1)
      return std::to_string(result.routes.size()) + " routes join " + std::to_string(result.landmarks.size()) +
             " landmarks";
    return {};
  }
  [[nodiscard]] std::string drawing_of(const RouteResult& result) const override { return "\n" + text_of(result); }

  // Routes of these lengths, besides those through the door.
  RouteId add_route(LandmarkId from, LandmarkId to, double cost_m) {
    Route route;
    route.from = from;
    route.to = to;
    route.cost_m = cost_m;
    return world_.graph.add_route(route);
  }
  // Landmark 4 half-way, where the two routes over it are shorter than the one through the door.
  void add_shortcut() {
    Landmark landmark;
    landmark.T_map_landmark = {2.1, 3.1, 0.0};
    landmark.access = landmark.T_map_landmark;
    ASSERT_EQ(world_.graph.add(landmark), 4);
    over_4_ = {add_route(1, 4, 0.5), add_route(4, 2, 0.5)};
  }
  [[nodiscard]] RouteResult plan_here(const RouteRequest& request) const {
    RouteResult result = make()->plan(request, world_.view(), Budget{});
    EXPECT_EQ(fault_of(result), "");
    return result;
  }

  std::vector<RouteId> over_4_;
};

TEST_P(RoutePlannerConformance, IsMadeTwiceAndDestroyedUnused) {
  expect_new_objects();
}

TEST_P(RoutePlannerConformance, OutlivesTheLibraryThatMadeIt) {
  expect_to_outlive_the_library();
}

TEST_P(RoutePlannerConformance, ASolvedRouteLeadsFromLandmarkToLandmark) {
  add_shortcut();
  for (const RouteRequest& request : {between(1, 2), between(2, 1), between(4, 1), between(1, 4)}) {
    const RouteResult result = plan_here(request);
    ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
    EXPECT_EQ(result.landmarks.front(), request.from.front().landmark);
    EXPECT_EQ(result.landmarks.back(), request.to.front().landmark);
    double cost_m = 0.0;
    for (std::size_t i = 0; i < result.routes.size(); ++i) {
      const Route* const route = world_.graph.find_route(result.routes[i]);
      ASSERT_NE(route, nullptr) << "R" << result.routes[i];
      EXPECT_EQ(route->from, result.landmarks[i]);
      EXPECT_EQ(route->to, result.landmarks[i + 1]);
      cost_m += route->cost_m;
    }
    EXPECT_NEAR(result.cost_m, cost_m, 1e-9);
  }
}

TEST_P(RoutePlannerConformance, TheCheapestRouteIsTaken) {
  add_shortcut();
  const RouteResult result = plan_here(between(1, 2));
  EXPECT_EQ(result.routes, over_4_) << text_of(result);
  EXPECT_NEAR(result.cost_m, 1.0, 1e-9);
}

TEST_P(RoutePlannerConformance, AClosedRouteIsNotTaken) {
  add_shortcut();
  RouteRequest request = between(1, 2);
  request.closed = {over_4_.back()};
  EXPECT_EQ(plan_here(request).routes, std::vector<RouteId>{1}) << "closed by the request";
  request.closed = {};
  world_.graph.set_closed(over_4_.front(), true);
  EXPECT_EQ(plan_here(request).routes, std::vector<RouteId>{1}) << "closed on the map";
  request.closed = {1};
  EXPECT_EQ(plan_here(request).outcome, PlanOutcome::no_route);
}

TEST_P(RoutePlannerConformance, AnAvoidedLandmarkIsNotPassedButMayBeAnEnd) {
  add_shortcut();
  RouteRequest request = between(1, 2);
  request.avoid = {4};
  EXPECT_EQ(plan_here(request).routes, std::vector<RouteId>{1});
  request = between(1, 4);
  request.avoid = {1, 4};
  EXPECT_EQ(plan_here(request).routes, std::vector<RouteId>{over_4_.front()});
}

TEST_P(RoutePlannerConformance, WhatItsEndsCostIsCounted) {
  add_shortcut();
  RouteRequest request = between(1, 2);
  request.from = {{1, 3.0}, {4, 0.25}};
  request.to = {{2, 0.5}};
  const RouteResult result = plan_here(request);
  EXPECT_EQ(result.landmarks, (std::vector<LandmarkId>{4, 2})) << text_of(result);
  EXPECT_NEAR(result.cost_m, 0.25 + 0.5 + 0.5, 1e-9);
  request.to = {{2, 9.0}, {4, 1.0}};
  EXPECT_EQ(plan_here(request).landmarks, std::vector<LandmarkId>{4});
}

TEST_P(RoutePlannerConformance, AlternativesAreOtherRoutesAndNoCheaper) {
  add_shortcut();
  RouteRequest request = between(1, 2);
  request.alternatives = 3;
  const RouteResult result = plan_here(request);
  if (result.outcome != PlanOutcome::solved) return;  // it may refuse, with a sentence
  EXPECT_LE(result.alternatives.size(), 3U);
  std::set<std::vector<RouteId>> seen{result.routes};
  for (const RouteAlternative& other : result.alternatives) {
    EXPECT_TRUE(seen.insert(other.routes).second) << "twice the same";
    EXPECT_EQ(other.landmarks.size(), other.routes.size() + 1);
    EXPECT_GE(other.cost_m, result.cost_m - 1e-9);
  }
}

TEST_P(RoutePlannerConformance, ALandmarkThatNoRouteLeadsToIsNeverSolved) {
  expect_never_solved(between(1, 3), world_.view(), "no route leads to the landmark");
  EXPECT_EQ(plan_here(between(3, 1)).outcome, PlanOutcome::no_route);
}

TEST_P(RoutePlannerConformance, EndsThatAreNoneAreOutcomesNotExceptions) {
  RouteRequest nowhere = between(1, 2);
  nowhere.to = {};
  RouteRequest from_nowhere = between(1, 2);
  from_nowhere.from = {};
  for (const RouteRequest& request : {nowhere, from_nowhere, between(1, 77), between(77, 1)})
    EXPECT_EQ(plan_here(request).outcome, PlanOutcome::unknown_place);
}

TEST_P(RoutePlannerConformance, AnEmptyMapIsAnOutcome) {
  const OccupancyGrid grid(0.1);
  const LandmarkGraph graph;
  expect_never_solved(between(1, 2), {grid, graph, world_.robot, {}, 0.0, nullptr, 0.0}, "there are no landmarks");
}

TEST_P(RoutePlannerConformance, ARobotThatIsThereAlreadyNeedsNoRoute) {
  const RouteResult result = plan_here(between(1, 1));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_TRUE(result.routes.empty()) << text_of(result);
}

TEST_P(RoutePlannerConformance, AChangedMapIsPlannedAfresh) {
  expect_changed_worlds_planned_afresh();
}

TEST_P(RoutePlannerConformance, TheSameRequestGivesTheSameAnswer) {
  expect_same_answers();
}

TEST_P(RoutePlannerConformance, ManyThreadsGetTheAnswersOfOne) {
  expect_same_answers_on_many_threads(between(1, 3));
}

TEST_P(RoutePlannerConformance, AUsedUpBudgetEndsACallPromptlyWithItsOutcome) {
  expect_prompt_ends_of_budgets();
}

}  // namespace cairn::conformance
