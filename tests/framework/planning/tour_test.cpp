#include "framework/planning/tour.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace cairn {
namespace {

using testing::ElementsAre;

Place at(std::vector<LandmarkId> landmarks) {
  Place place;
  place.landmarks = std::move(landmarks);
  return place;
}

double x_of(const Place& place) {
  return place.pose ? place.pose->x_m : static_cast<double>(place.landmarks.front());
}

// Landmarks in a row, 1 m apart: the planner here goes from the first of a place straight to the last of the next.
struct Row {
  std::vector<PlanRequest> asked;
  LandmarkId unreachable = 0;
  bool knows_least = false;

  PlanResult operator()(const PlanRequest& request) {
    asked.push_back(request);
    PlanResult leg;
    leg.settled = 5;
    leg.time_ms = {1.0, 2.0, 4.0};
    leg.reason = "no route";
    if (request.explain) leg.explanation = explanation_of(request);
    if (!request.to.landmarks.empty() && request.to.landmarks.back() == unreachable) return leg;
    leg.outcome = PlanOutcome::solved;
    const double from = x_of(request.from);
    const double to = request.to.pose ? x_of(request.to) : static_cast<double>(request.to.landmarks.back());
    leg.cost_m = 10.0 * std::abs(to - from);
    leg.length_m = std::abs(to - from);
    leg.clearance_m = to;
    if (knows_least) leg.length_lower_bound_m = 0.5 * leg.length_m;
    leg.path = {Pose2{from, 0.0, 0.0}, Pose2{to, 0.0, 0.0}};
    leg.routes = {static_cast<RouteId>(asked.size())};
    leg.blocked_routes = {static_cast<RouteId>(100 + asked.size())};
    if (!request.from.landmarks.empty()) leg.landmarks.push_back(request.from.landmarks.front());
    if (!request.to.landmarks.empty() && (leg.landmarks.empty() || leg.landmarks.back() != request.to.landmarks.back()))
      leg.landmarks.push_back(request.to.landmarks.back());
    return leg;
  }

  // The first leg is in cluster 1 and has nothing better, the second one in 1 and 2 would cost 3 less.
  [[nodiscard]] RouteExplanation explanation_of(const PlanRequest& request) const {
    RouteExplanation explanation;
    const bool first = asked.size() == 1;
    explanation.search = "a search";
    explanation.search_level = first ? 0 : 1;
    explanation.settled_of_level = first ? std::vector<std::int64_t>{4} : std::vector<std::int64_t>{3, 2};
    explanation.clusters =
        first ? std::vector<std::vector<ClusterId>>{{1}} : std::vector<std::vector<ClusterId>>{{1, 2}, {9}};
    if (unreachable == 0 || request.to.landmarks.back() != unreachable) explanation.cost = 7.0;
    if (first != (request.closed.size() == 1)) return explanation;
    explanation.cost_with_closed_open = 4.0;
    explanation.closed_on_cheaper_path = {static_cast<RouteId>(50 + asked.size())};
    return explanation;
  }

  PlanResult tour(const PlanRequest& request, const std::vector<Place>& via) {
    return plan_tour([this](const PlanRequest& leg) { return (*this)(leg); }, request, via);
  }
};

PlanRequest from_to(const Place& from, const Place& to) {
  PlanRequest request;
  request.from = from;
  request.to = to;
  return request;
}

TEST(Tour, WithoutStopsItIsTheRequestAsItIs) {
  Row row;
  PlanRequest request = from_to(at({1}), at({4}));
  request.alternatives = 3;
  const PlanResult result = row.tour(request, {});
  ASSERT_EQ(row.asked.size(), 1U);
  EXPECT_EQ(row.asked[0].alternatives, 3);
  EXPECT_EQ(result.reason, "no route");
  EXPECT_THAT(result.landmarks, ElementsAre(1, 4));
}

TEST(Tour, PassesItsStopsInTheirOrderAndAddsUp) {
  Row row;
  const PlanResult result = row.tour(from_to(at({1}), at({4})), {at({6}), at({2})});
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 6, 2, 4));
  EXPECT_THAT(result.routes, ElementsAre(1, 2, 3));
  EXPECT_THAT(result.blocked_routes, ElementsAre(101, 102, 103));
  EXPECT_DOUBLE_EQ(result.cost_m, 110.0);
  EXPECT_DOUBLE_EQ(result.length_m, 11.0);
  EXPECT_DOUBLE_EQ(result.clearance_m, 2.0);
  EXPECT_EQ(result.settled, 15);
  EXPECT_DOUBLE_EQ(result.time_ms.graph_ms, 3.0);
  EXPECT_DOUBLE_EQ(result.time_ms.route_ms, 6.0);
  EXPECT_DOUBLE_EQ(result.time_ms.total_ms, 12.0);
  EXPECT_EQ(result.reason, "leg 1 of 3: no route; leg 2 of 3: no route; leg 3 of 3: no route");
  ASSERT_EQ(result.path.size(), 4U);
  EXPECT_DOUBLE_EQ(result.path[2].x_m, 2.0);
  EXPECT_FALSE(result.explanation);
}

TEST(Tour, TheLeastLengthsAddUpBetweenSinglePlacesOnly) {
  Row row;
  EXPECT_FALSE(row.tour(from_to(at({1}), at({4})), {at({6})}).length_lower_bound_m);
  row.knows_least = true;
  EXPECT_EQ(row.tour(from_to(at({1}), at({4})), {at({6})}).length_lower_bound_m, 3.5);
  EXPECT_FALSE(row.tour(from_to(at({1}), at({4})), {at({6, 2})}).length_lower_bound_m);
  row.unreachable = 4;
  EXPECT_FALSE(row.tour(from_to(at({1}), at({4})), {at({6})}).length_lower_bound_m);
}

TEST(Tour, GoesOnFromTheOneOfSeveralThatWasReached) {
  Row row;
  const PlanResult result = row.tour(from_to(at({1}), at({2})), {at({3, 5})});
  EXPECT_THAT(row.asked.at(1).from.landmarks, ElementsAre(5));
  EXPECT_THAT(result.landmarks, ElementsAre(1, 5, 2));
}

TEST(Tour, GoesOnFromAPoseAsItWasAskedFor) {
  Row row;
  Place stop;
  stop.pose = Pose2{3.5, 0.0, 1.0};
  stop.heading_matters = true;
  const PlanResult result = row.tour(from_to(at({1}), at({4})), {stop});
  EXPECT_EQ(row.asked.at(1).from.pose, stop.pose);
  EXPECT_TRUE(row.asked.at(1).from.heading_matters);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 4));
}

TEST(Tour, EachLegHeedsTheRestOfTheRequestButGivesNoAlternatives) {
  Row row;
  PlanRequest request = from_to(at({1}), at({4}));
  request.alternatives = 3;
  request.avoid = {7};
  request.closed = {8};
  request.cost = CostKind::time;
  static_cast<void>(row.tour(request, {at({2}), at({3})}));
  ASSERT_EQ(row.asked.size(), 3U);
  for (const PlanRequest& leg : row.asked) {
    EXPECT_EQ(leg.alternatives, 0);
    EXPECT_THAT(leg.avoid, ElementsAre(7));
    EXPECT_THAT(leg.closed, ElementsAre(8));
    EXPECT_EQ(leg.cost, CostKind::time);
  }
}

TEST(Tour, EndsAtTheFirstLegWithoutAWayAndSaysWhich) {
  Row row;
  row.unreachable = 3;
  const PlanResult result = row.tour(from_to(at({1}), at({4})), {at({2}), at({3}), at({5})});
  EXPECT_EQ(row.asked.size(), 2U);
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_EQ(result.reason, "leg 2 of 4: no route");
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2));
  EXPECT_EQ(result.settled, 10);
}

TEST(Tour, StoppingWhereItIsAddsNoLandmarkTwice) {
  Row row;
  EXPECT_THAT(row.tour(from_to(at({1}), at({1})), {at({1}), at({1})}).landmarks, ElementsAre(1));
}

TEST(Tour, ExplanationsAddUp) {
  Row row;
  PlanRequest request = from_to(at({1}), at({4}));
  request.explain = true;
  const PlanResult result = row.tour(request, {at({2})});
  ASSERT_TRUE(result.explanation);
  EXPECT_EQ(result.explanation->search, "a search");
  EXPECT_EQ(result.explanation->search_level, 1);
  EXPECT_THAT(result.explanation->settled_of_level, ElementsAre(7, 2));
  EXPECT_THAT(result.explanation->clusters, ElementsAre(ElementsAre(1, 2), ElementsAre(9)));
  EXPECT_EQ(result.explanation->cost, 14.0);
  EXPECT_EQ(result.explanation->cost_with_closed_open, 11.0);  // 7 of the first leg, 4 of the second
  EXPECT_THAT(result.explanation->closed_on_cheaper_path, ElementsAre(52));
}

TEST(Tour, ClosedRoutesOfEarlierLegsAreNotBlamedForALegWithoutAWay) {
  Row row;
  row.unreachable = 4;
  PlanRequest request = from_to(at({1}), at({4}));
  request.explain = true;
  request.closed = {8};  // the planner then has something better on the first leg only
  const PlanResult result = row.tour(request, {at({2})});
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  ASSERT_TRUE(result.explanation);
  EXPECT_FALSE(result.explanation->cost_with_closed_open);
  EXPECT_TRUE(result.explanation->closed_on_cheaper_path.empty());
  EXPECT_THAT(result.explanation->settled_of_level, ElementsAre(7, 2));
}

}  // namespace
}  // namespace cairn
