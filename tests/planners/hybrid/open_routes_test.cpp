#include "planners/hybrid/open_routes.hpp"

#include <gmock/gmock.h>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Later than the calls before the ending one take on a slow machine, and then waited for.
constexpr std::chrono::milliseconds kLater{1500};

// Has a budget end during a call: sets the cancel flag, or waits for the deadline.
class BudgetEnd {
 public:
  BudgetEnd(int at_call, std::atomic<bool>* cancel) : at_call_(at_call), cancel_(cancel) {}
  void count(const Budget& budget) const {
    if (++calls < at_call_) return;
    if (cancel_ != nullptr) *cancel_ = true;
    while (!budget.exhausted()) {
    }
  }
  mutable int calls = 0;

 private:
  int at_call_;
  std::atomic<bool>* cancel_;
};

class EndingRoutePlanner : public RoutePlanner, public BudgetEnd {
 public:
  using BudgetEnd::BudgetEnd;
  RouteResult plan(const RouteRequest& request, const WorldView& world, const Budget& budget) const override {
    RouteResult result = search_.plan(request, world, budget);
    count(budget);
    return result;
  }

 private:
  LandmarkSearch search_;
};

class EndingPathPlanner : public PathPlanner, public BudgetEnd {
 public:
  using BudgetEnd::BudgetEnd;
  PlannerTraits traits() const override { return ompl_.traits(); }
  PathResult plan(const PathRequest& request, const WorldView& world, const Budget& budget) const override {
    PathResult result = ompl_.plan(request, world, budget);
    count(budget);
    return result;
  }

 private:
  OmplPlanner ompl_{OmplConfig{}};
};

class OpenRoutes : public Hybrid {
 protected:
  // Two parallel routes by the upper corridor, one round by the lower.
  void add_ways() {
    m = landmark('M');
    n = landmark('N');
    const LandmarkId p = landmark('P');
    const LandmarkId q = landmark('Q');
    upper = {route(m, n, "MUN"), route(m, n, "MN", 1.35)};
    round = {route(m, p, "", 1.2), route(p, q, "PVQ"), route(q, n, "", 1.2)};
    config.detour_ratio = 2.0;
  }
  PlanResult plan_with(std::shared_ptr<const PathPlanner> path_planner,
                       std::shared_ptr<const RoutePlanner> route_planner, const Budget& budget) const {
    return HybridPlanner(config, std::move(path_planner), std::move(route_planner))
        .plan(between(m, n), world.view(), budget);
  }

  LandmarkId m = 0, n = 0;
  std::vector<RouteId> upper, round;
};

TEST_F(OpenRoutes, SeveralBlockedRoutesInARowAreAllClosedAndNamed) {
  add_ways();
  block('U');
  const PlanResult result = plan(between(m, n));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_EQ(result.routes, round);
  EXPECT_EQ(result.blocked_routes, upper);
  EXPECT_THAT(result.reason, HasSubstr("route R1 (M to N) is blocked; route R2 (M to N) is blocked"));
  EXPECT_EQ(searcher->calls, 3);
  expect_clear(result);
}

TEST_F(OpenRoutes, WithEveryWayBlockedTheWayIsDirectOrThereIsNone) {
  add_ways();
  block('U');

  world.graph.remove_route(round[1]);
  const PlanResult result = plan(between(m, n));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.routes, IsEmpty());
  EXPECT_EQ(result.blocked_routes, upper);
  block('V');
  const PlanResult none = plan(request('A', 'B'));
  EXPECT_EQ(none.outcome, PlanOutcome::no_route) << none.reason;
}

TEST_F(OpenRoutes, ABudgetThatEndsWithinTheLoopEndsIt) {
  add_ways();
  block('U');
  config.detour_ratio = 1.0;
  for (const bool by_deadline : {false, true}) {
    for (int call = by_deadline ? 2 : 1; call <= (by_deadline ? 2 : 3); ++call) {
      std::atomic<bool> cancel{false};
      Budget budget;
      budget.cancel = &cancel;
      if (by_deadline) budget.deadline = Budget::Clock::now() + kLater;
      const auto ending = std::make_shared<EndingRoutePlanner>(call, by_deadline ? nullptr : &cancel);
      const PlanResult result = plan_with(router, ending, budget);
      EXPECT_EQ(result.outcome, by_deadline ? PlanOutcome::out_of_budget : PlanOutcome::cancelled) << result.reason;
      EXPECT_EQ(ending->calls, call) << "no search after the end";
    }
    std::atomic<bool> cancel{false};
    Budget budget;
    budget.cancel = &cancel;
    if (by_deadline) budget.deadline = Budget::Clock::now() + kLater;
    const auto ending = std::make_shared<EndingPathPlanner>(1, by_deadline ? nullptr : &cancel);
    searcher->calls = 0;
    const PlanResult result = plan_with(ending, searcher, budget);
    EXPECT_EQ(result.outcome, by_deadline ? PlanOutcome::out_of_budget : PlanOutcome::cancelled) << result.reason;
    EXPECT_EQ(ending->calls, 1);
    EXPECT_EQ(searcher->calls, 1);
  }
}

TEST_F(OpenRoutes, AlternativesThatAreBlockedTodayAreReplacedByOthers) {
  add_ways();
  const RouteId long_way = route(m, n, "", 9.0);
  PlanRequest request = between(m, n);
  request.alternatives = 2;
  const auto routes_of = [](const PlanResult& result) {
    std::vector<std::vector<RouteId>> routes;
    for (const RouteAlternative& way : result.alternatives) routes.push_back(way.routes);
    return routes;
  };
  EXPECT_THAT(routes_of(plan(request)), ElementsAre(std::vector{upper[1]}, round));
  block('V');
  const PlanResult result = plan(request);
  EXPECT_THAT(result.routes, ElementsAre(upper[0]));
  EXPECT_THAT(routes_of(result), ElementsAre(std::vector{upper[1]}, std::vector{long_way}));
  EXPECT_THAT(result.blocked_routes, ElementsAre(round[1]));
  request.alternatives = 5;
  EXPECT_THAT(routes_of(plan(request)), ElementsAre(std::vector{upper[1]}, std::vector{long_way}))
      << "no more are open";
}

}  // namespace
}  // namespace cairn
