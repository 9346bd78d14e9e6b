#include "planners/hybrid/stored_route.hpp"

#include <gmock/gmock.h>

#include <random>

#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using test::Hybrid;
using test::kRadius_m;

class StoredRoutes : public Hybrid {
 protected:
  // Examines the grid along the route only.
  std::optional<PlanResult> beside(const PlanRequest& request) const {
    const PlannerTraits traits = router->traits();
    const std::shared_ptr<const RoutePlanner> search = searcher;
    const HybridTools tools{config, traits, usual_, avoiding_, *router, search};
    const LegRules legs{request.radius_m, request.radius_m + kMinRadius_m, config.detour_ratio, request.seed};
    const AnswerRules answers{{}, request.radius_m, request.radius_m, config.shortcut};
    return stored_route(tools, legs, answers, request, world.view(), {});
  }
  // Every letter a landmark, routes between some of them straight on, a few with a cost or no trajectory.
  void add_any_routes(std::mt19937_64& random) {
    const std::string places = "AMUNBCPVQD";
    for (const char place : places) ids_[place] = landmark(place);
    for (int i = 0; i < 14; ++i) {
      const char from = places[random() % places.size()];
      const char to = places[random() % places.size()];
      if (from == to) continue;
      const double cost_m = random() % 3 == 0 ? 3.0 : -1.0;
      route(ids_[from], ids_[to], random() % 4 == 0 ? "" : std::string{from, to}, cost_m);
    }
  }

  std::map<char, LandmarkId> ids_;

 private:
  HybridGround usual_;
  HybridGround avoiding_;
};

void expect_same(const PlanResult& found, const PlanResult& whole) {
  EXPECT_EQ(found.outcome, whole.outcome);
  EXPECT_EQ(found.reason, whole.reason);
  EXPECT_EQ(found.path, whole.path);
  EXPECT_EQ(found.routes, whole.routes);
  EXPECT_EQ(found.landmarks, whole.landmarks);
  EXPECT_EQ(found.blocked_routes, whole.blocked_routes);
  EXPECT_EQ(found.cost_m, whole.cost_m);
  EXPECT_EQ(found.length_m, whole.length_m);
  EXPECT_NEAR(found.clearance_m, whole.clearance_m, 1e-9);
  EXPECT_EQ(found.segments.size(), whole.segments.size());
}

TEST_F(StoredRoutes, AreWhatAFullLookFinds) {
  std::mt19937_64 random(8);
  int found = 0;
  int left = 0;
  for (int trial = 0; trial < 200; ++trial) {
    world.graph = {};
    add_any_routes(random);
    const OccupancyGrid before = world.grid;
    if (trial % 3 == 0) block(trial % 2 == 0 ? 'U' : 'V');
    for (const auto& [from, from_id] : ids_) {
      PlanRequest request = between(from_id, ids_["ABQ"[random() % 3]]);
      request.to.landmarks.push_back(ids_["ND"[random() % 2]]);
      const auto way = beside(request);
      way ? ++found : ++left;
      if (way) expect_same(*way, plan(request));
    }
    world.grid = before;
  }
  EXPECT_GT(found, 60);
  EXPECT_GT(left, 60);
}

TEST_F(StoredRoutes, GoRoundWhatIsInEveryDirectWay) {
  const LandmarkId u = landmark('U');
  const LandmarkId v = landmark('V');
  const Point beyond_the_wall(0.61, 0.0);
  world.places['u'] = world.places['U'] + beyond_the_wall;
  world.places['v'] = world.places['V'] + beyond_the_wall;
  const RouteId round = route(u, v, "UuvV");
  const PlanResult whole = plan(between(u, v));
  ASSERT_EQ(whole.routes, std::vector{round}) << whole.reason;
  ASSERT_THAT(whole.reason, testing::HasSubstr("1 stored and 0 newly planned"));
  const double straight_m = (world.places['U'] - world.places['V']).norm();
  ASSERT_GT(whole.cost_m, config.detour_ratio * straight_m);
  const auto way = beside(between(u, v));
  ASSERT_TRUE(way);
  expect_same(*way, whole);
  world.graph.set_cost(round, 4.0);
  EXPECT_FALSE(beside(between(u, v)));
  EXPECT_THAT(plan(between(u, v)).routes, testing::IsEmpty());
}

TEST_F(StoredRoutes, WhatIsNotCertainIsLeftToTheFullLook) {
  const LandmarkId m = landmark('M');
  const LandmarkId n = landmark('N');
  route(m, n, "MUN");
  EXPECT_TRUE(beside(between(m, n)));
  EXPECT_FALSE(beside(between(n, m))) << "no route leads there";
  EXPECT_FALSE(beside(between(m, m)));
  EXPECT_FALSE(beside(between(m, 77)));
  EXPECT_FALSE(beside(request('M', 'N'))) << "the route to the first landmark is not known";
  PlanRequest asks_more = between(m, n);
  asks_more.alternatives = 1;
  EXPECT_FALSE(beside(asks_more));
  block('U');
  EXPECT_FALSE(beside(between(m, n)));
}

}  // namespace
}  // namespace cairn
