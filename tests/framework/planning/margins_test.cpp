#include "framework/planning/margins.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

namespace cairn {
namespace {

using testing::ElementsAre;

// Finds a path for discs up to a radius, and keeps 0.01 m beside the disc.
class Gap {
 public:
  explicit Gap(double max_radius_m, PlanOutcome otherwise = PlanOutcome::no_route)
      : max_radius_m_(max_radius_m), otherwise_(otherwise) {}

  PlanResult plan(double radius_m, std::span<const double> margins_m = kMargins_m) {
    PlanRequest request;
    request.radius_m = radius_m;
    return plan_with_margins(
        [&](const PlanRequest& asked) {
          radii_m.push_back(asked.radius_m);
          PlanResult result;
          result.outcome = asked.radius_m <= max_radius_m_ ? PlanOutcome::solved : otherwise_;
          result.reason = result.outcome == PlanOutcome::solved ? "" : "no path leads there";
          result.clearance_m = result.outcome == PlanOutcome::solved ? 0.01 : 0.0;
          result.time_ms.total_ms = 2.0;
          return result;
        },
        request, margins_m);
  }

  std::vector<double> radii_m;

 private:
  double max_radius_m_;
  PlanOutcome otherwise_;
};

TEST(Margins, WhereThereIsRoomThePathKeepsTheLargest) {
  Gap gap(1.0);
  const PlanResult result = gap.plan(0.2);
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_DOUBLE_EQ(result.margin_m, 0.12);
  EXPECT_DOUBLE_EQ(result.clearance_m, 0.13) << "from the robot's edge, not from that of the larger disc";
  EXPECT_EQ(result.reason, "");
  EXPECT_EQ(gap.radii_m.size(), 1U);
}

TEST(Margins, AreRelaxedWhereTheyLeaveNoPathAndTheReasonSaysSo) {
  Gap gap(0.27);
  const PlanResult result = gap.plan(0.2);
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_DOUBLE_EQ(result.margin_m, 0.06);
  EXPECT_EQ(result.reason, "with a margin of 0.12 m beside the robot there is no path, so it keeps 0.06 m");
  EXPECT_DOUBLE_EQ(result.time_ms.total_ms, 4.0) << "of both attempts";
  Gap narrow(0.21);
  EXPECT_EQ(narrow.plan(0.2).reason, "with a margin of 0.12 m beside the robot there is no path, so it keeps none");
  EXPECT_THAT(narrow.radii_m, ElementsAre(0.32, 0.26, 0.2));
}

// A planner that answers with what a margin leads to.
PlanCall answering(std::map<double, PlanResult> by_margin, double radius_m) {
  return [by_margin = std::move(by_margin), radius_m](const PlanRequest& asked) {
    PlanResult result = by_margin.at(std::round(100.0 * (asked.radius_m - radius_m)) / 100.0);
    result.outcome = PlanOutcome::solved;
    result.path = {{0.0, 0.0, 0.0}, {3.0, 0.0, 0.0}};
    return result;
  };
}

PlanResult of_length(double length_m, std::vector<RouteId> blocked = {}) {
  PlanResult result;
  result.length_m = length_m;
  result.blocked_routes = std::move(blocked);
  return result;
}

TEST(Margins, AMuchLongerPathIsNotTakenForTheirSake) {
  PlanRequest request;
  request.radius_m = 0.2;
  const PlanResult detour = plan_with_margins(
      answering({{0.12, of_length(30.0)}, {0.06, of_length(5.5)}, {0.0, of_length(5.0)}}, 0.2), request, kMargins_m);
  EXPECT_DOUBLE_EQ(detour.margin_m, 0.06);
  EXPECT_EQ(detour.reason, "with a margin of 0.12 m beside the robot the path is 30.00 m long, so it keeps 0.06 m");
  const PlanResult round = plan_with_margins(
      answering({{0.12, of_length(5.5)}, {0.06, of_length(5.2)}, {0.0, of_length(5.0)}}, 0.2), request, kMargins_m);
  EXPECT_DOUBLE_EQ(round.margin_m, 0.12) << "without it the path is hardly shorter";
  EXPECT_EQ(round.reason, "");
}

TEST(Margins, ARouteThatOnlyTheyBlockIsNotReportedAsBlocked) {
  PlanRequest request;
  request.radius_m = 0.2;
  const PlanResult narrow = plan_with_margins(
      answering({{0.12, of_length(3.2, {7, 8})}, {0.06, of_length(3.1, {8})}, {0.0, of_length(3.0, {8})}}, 0.2),
      request, kMargins_m);
  EXPECT_DOUBLE_EQ(narrow.margin_m, 0.06);
  EXPECT_THAT(narrow.blocked_routes, ElementsAre(8)) << "it is blocked without a margin too";
  EXPECT_THAT(narrow.reason, testing::HasSubstr("route R7 is too narrow"));
}

TEST(Margins, WithoutAPathForTheRobotItselfTheAnswerIsThatOfTheLastOne) {
  Gap gap(0.1);
  const PlanResult result = gap.plan(0.2);
  EXPECT_EQ(result.outcome, PlanOutcome::no_route);
  EXPECT_EQ(result.reason, "no path leads there");
  EXPECT_DOUBLE_EQ(result.margin_m, 0.0);
}

TEST(Margins, WhatAnotherMarginCannotChangeIsAskedOnce) {
  for (const PlanOutcome outcome :
       {PlanOutcome::unknown_place, PlanOutcome::unsupported, PlanOutcome::cancelled, PlanOutcome::out_of_budget}) {
    Gap gap(0.1, outcome);
    EXPECT_EQ(gap.plan(0.2).outcome, outcome);
    EXPECT_EQ(gap.radii_m.size(), 1U);
  }
}

TEST(Margins, AMarginThatIsAskedForIsNotRelaxed) {
  Gap gap(0.25);
  EXPECT_EQ(gap.plan(0.2, std::array{0.1}).outcome, PlanOutcome::no_route);
  EXPECT_THAT(gap.radii_m, ElementsAre(testing::DoubleEq(0.3)));
}

TEST(Margins, AreForDiscsOnAGrid) {
  OccupancyGrid grid(0.1);
  RobotModel robot;
  EXPECT_THAT(usual_margins_m(robot, grid), ElementsAre(0.0)) << "there is no grid";
  grid.set_log_odds({0, 0}, -1000);
  EXPECT_THAT(usual_margins_m(robot, grid), ElementsAre(0.12, 0.06, 0.0));
  robot.polygon_m = {{0, 0}, {0.3, 0}, {0, 0.3}};
  EXPECT_THAT(usual_margins_m(robot, grid), ElementsAre(0.0));
}

}  // namespace
}  // namespace cairn
