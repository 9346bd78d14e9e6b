#include "framework/contracts/adapters/lone_planners.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// Answer as they were asked to, and keep what they were asked.
struct FixedPathPlanner : PathPlanner {
  [[nodiscard]] PlannerTraits traits() const override { return {}; }
  [[nodiscard]] PathResult plan(const PathRequest& request, const WorldView&, const Budget&) const override {
    asked = request;
    ++calls;
    return answer;
  }
  void prepare(const WorldView&, double radius_m) const override { prepared_m = radius_m; }
  PathResult answer;
  mutable PathRequest asked;
  mutable int calls = 0;
  mutable double prepared_m = 0.0;
};

struct FixedRoutePlanner : RoutePlanner {
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView&, const Budget&) const override {
    asked = request;
    ++calls;
    return answer;
  }
  RouteResult answer;
  mutable RouteRequest asked;
  mutable int calls = 0;
};

class LonePlanners : public ::testing::Test {
 protected:
  // Three landmarks two metres apart; a trajectory leads to the second, none to the third.
  LonePlanners() {
    for (const double x_m : {0.0, 2.0, 4.0}) {
      Landmark landmark;
      landmark.T_map_landmark = {x_m, 0.0, 0.0};
      graph.add(landmark);
    }
    graph.find(3)->access = Pose2{3.5, 0.0, 0.0};
    add_route(1, 2, {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}});
    add_route(2, 3, {});
    request.from.landmarks = {1, 2};
    request.to.landmarks = {3};
    request.radius_m = 0.3;
    request.seed = 9;
    request.cost = CostKind::time;
    request.avoid = {2};
    request.closed = {1};
    request.alternatives = 4;
    request.explain = true;
  }
  void add_route(LandmarkId from, LandmarkId to, std::vector<Pose2> trajectory) {
    Route route;
    route.from = from;
    route.to = to;
    route.trajectory = std::move(trajectory);
    graph.add_route(route);
  }
  [[nodiscard]] WorldView world() const { return {grid, graph, robot, {}}; }
  [[nodiscard]] PlanResult plan_routes() const { return LoneRoutePlanner(routes).plan(request, world(), {}); }
  [[nodiscard]] PlanResult plan_paths() const {
    PlanRequest asked = request;
    asked.alternatives = 0;  // what is of the graph alone
    asked.avoid.clear();
    return LonePathPlanner(paths).plan(asked, world(), {});
  }

  OccupancyGrid grid{0.1};
  LandmarkGraph graph;
  RobotModel robot;
  PlanRequest request;
  std::shared_ptr<FixedPathPlanner> paths = std::make_shared<FixedPathPlanner>();
  std::shared_ptr<FixedRoutePlanner> routes = std::make_shared<FixedRoutePlanner>();
};

TEST_F(LonePlanners, AskAPathPlannerForTheSameEndsRadiusSeedAndCost) {
  (void)plan_paths();
  EXPECT_EQ(paths->asked.from.landmarks, request.from.landmarks);
  EXPECT_EQ(paths->asked.to.landmarks, request.to.landmarks);
  EXPECT_EQ(paths->asked.radius_m, 0.3);
  EXPECT_EQ(paths->asked.seed, 9U);
  EXPECT_EQ(paths->asked.cost, CostKind::time);
  LonePathPlanner(paths).prepare(world(), 0.4);
  EXPECT_EQ(paths->prepared_m, 0.4);
}

TEST_F(LonePlanners, PassAPathOnAsAPlan) {
  paths->answer = {PlanOutcome::solved, "found", 3.0, 2.0, 0.1, 1, 3, {{0, 0, 0}, {2, 0, 0}}, 1.9, 7.5};
  PlanResult result = plan_paths();
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.reason, "found");
  EXPECT_EQ(result.cost_m, 3.0);
  EXPECT_EQ(result.length_m, 2.0);
  EXPECT_EQ(result.clearance_m, 0.1);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 3));
  EXPECT_EQ(result.path, paths->answer.path);
  EXPECT_EQ(result.length_lower_bound_m, 1.9);
  EXPECT_EQ(result.driving_time_s, 7.5);
  ASSERT_EQ(result.segments.size(), 1U);
  EXPECT_EQ(result.segments.front().length_m, 2.0);
  EXPECT_GE(result.time_ms.route_ms, 0.0);
  EXPECT_EQ(result.time_ms.total_ms, result.time_ms.route_ms);
  paths->answer.to_landmark = 1;
  EXPECT_THAT(plan_paths().landmarks, ElementsAre(1)) << "it is there already";
  paths->answer.from_landmark = paths->answer.to_landmark = 0;
  EXPECT_THAT(plan_paths().landmarks, IsEmpty());
}

TEST_F(LonePlanners, AskARoutePlannerForAllThatConcernsTheGraph) {
  (void)plan_routes();
  ASSERT_EQ(routes->asked.from.size(), 2U);
  EXPECT_EQ(routes->asked.from[1].landmark, 2);
  EXPECT_EQ(routes->asked.from[1].cost, 0.0);
  EXPECT_EQ(routes->asked.to.front().landmark, 3);
  EXPECT_EQ(routes->asked.radius_m, 0.3);
  EXPECT_EQ(routes->asked.cost, CostKind::time);
  EXPECT_EQ(routes->asked.avoid, request.avoid);
  EXPECT_EQ(routes->asked.closed, request.closed);
  EXPECT_EQ(routes->asked.alternatives, 4);
  EXPECT_TRUE(routes->asked.explain);
}

TEST_F(LonePlanners, JoinStoredTrajectoriesAndFillGapsWithApproachPoses) {
  routes->answer = {PlanOutcome::solved, "found", 4.0, {1, 2, 3}, {1, 2}, 7, {{5.0, {1, 3}, {8}}}, RouteExplanation{}};
  const PlanResult result = plan_routes();
  EXPECT_THAT(result.path, ElementsAre(Pose2{0, 0, 0}, Pose2{1, 1, 0}, Pose2{2, 0, 0}, Pose2{3.5, 0, 0}));
  EXPECT_DOUBLE_EQ(result.length_m, 2.0 * std::sqrt(2.0) + 1.5);
  EXPECT_EQ(result.outcome, PlanOutcome::solved);
  EXPECT_EQ(result.cost_m, 4.0);
  EXPECT_THAT(result.landmarks, ElementsAre(1, 2, 3));
  EXPECT_THAT(result.routes, ElementsAre(1, 2));
  EXPECT_EQ(result.settled, 7);
  EXPECT_EQ(result.alternatives.size(), 1U);
  EXPECT_TRUE(result.explanation);
  routes->answer = {PlanOutcome::solved, "there", 0.0, {3}};
  EXPECT_THAT(plan_routes().path, ElementsAre(Pose2{3.5, 0, 0}));
  routes->answer = {PlanOutcome::no_route, "none"};
  EXPECT_THAT(plan_routes().path, IsEmpty());
  EXPECT_EQ(plan_routes().reason, "none");
}

TEST_F(LonePlanners, DoNotAskAPathPlannerForWhatIsOfTheGraph) {
  const auto refusal = [&](int alternatives, std::vector<LandmarkId> avoid) {
    request.alternatives = alternatives;
    request.avoid = std::move(avoid);
    const PlanResult result = LonePathPlanner(paths).plan(request, world(), {});
    EXPECT_EQ(result.outcome, PlanOutcome::unsupported);
    return result.reason;
  };
  EXPECT_THAT(refusal(2, {}), HasSubstr("alternatives are routes of the landmark graph"));
  EXPECT_THAT(refusal(0, {1}), HasSubstr("avoided are landmarks of the landmark graph"));
  EXPECT_EQ(paths->calls, 0);
}

TEST_F(LonePlanners, DoNotAskARoutePlannerForPoses) {
  request.to.pose = Pose2{};
  EXPECT_EQ(plan_routes().outcome, PlanOutcome::unsupported);
  EXPECT_THAT(plan_routes().reason, HasSubstr("the goal is a pose"));
  request.from.pose = Pose2{};
  EXPECT_THAT(plan_routes().reason, HasSubstr("the start is a pose"));
  EXPECT_THAT(plan_routes().reason, HasSubstr("needs landmarks"));
  EXPECT_EQ(routes->calls, 0);
}

}  // namespace
}  // namespace cairn
