// Ends that are poses are joined to the landmarks of their own cluster, and a path from cluster to cluster is preferred
// to the direct one where cutting its corners leaves it hardly longer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "maps/hierarchy/hierarchies.hpp"
#include "tests/planners/hybrid/hybrid_world.hpp"

namespace cairn {
namespace {

using ::testing::ElementsAre;
using ::testing::MatchesRegex;

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + words.size()));
}

// A is a cluster by itself, in the left room; U, in the middle of the upper corridor, and B, in the right room, are
// another.
class HybridClusters : public test::Hybrid {
 protected:
  HybridClusters() : a_(landmark('A')), u_(landmark('U')), b_(landmark('B')) {
    route(a_, u_, "AU");
    route(u_, b_, "UB");
    for (const ClusterId id : {1, 2}) {
      clusters_.clusters[id].id = id;
      clusters_.clusters[id].anchor = id == 1 ? a_ : u_;
    }
    clusters_.cluster_of = {{a_, 1}, {u_, 2}, {b_, 2}};
    clusters_.next_id = 3;
  }

  [[nodiscard]] PlanResult plan_in_clusters(const PlanRequest& request) const {
    const Hierarchies hierarchies(world.graph, clusters_, {});
    WorldView view = world.view();
    view.hierarchies = &hierarchies;
    return HybridPlanner(config, router, searcher).plan(request, view, {});
  }

  LandmarkId a_, u_, b_;
  ClusterTree clusters_;
};

// From M it is 5 squares back to A, and 9 on to U.
TEST_F(HybridClusters, AStartIsJoinedToTheLandmarksOfItsOwnClusterOnly) {
  EXPECT_THAT(plan(request('M', 'B')).landmarks, ElementsAre(u_, b_)) << "without clusters, to the cheapest";
  const PlanResult result = plan_in_clusters(request('M', 'B'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.landmarks, ElementsAre(a_, u_, b_)) << result.reason;
  const double direct_m = (world.places['B'] - world.places['M']).norm();
  EXPECT_GT(result.cost_m, 1.3 * direct_m) << "more than a path over landmarks may cost within one cluster";
  EXPECT_LE(result.length_m, 1.1 * direct_m) << "its corners are cut\n" << test::drawing_of(world.grid, result.path);
  expect_clear(result);
}

TEST_F(HybridClusters, AGoalIsJoinedToTheLandmarksOfItsOwnClusterOnly) {
  route(b_, u_, "BU");
  route(u_, a_, "UA");
  EXPECT_THAT(plan(request('B', 'M')).landmarks, ElementsAre(b_, u_)) << "without clusters, to the cheapest";
  const PlanResult result = plan_in_clusters(request('B', 'M'));
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.landmarks, ElementsAre(b_, u_, a_)) << result.reason;
}

// From corridor to corridor: straight on through the right room, or back by landmarks through the left one. What stands
// between the corridors lets no cut corner make the one as short as the other.
class HybridDetour : public test::Hybrid {
 protected:
  HybridDetour() : u_(landmark('U')), m_(landmark('M')), p_(landmark('P')), v_(landmark('V')) {
    route(u_, m_, "UM");
    route(m_, p_, "", 0.8);
    route(p_, v_, "PV");
  }
  // second: the cluster of P and V; U and M are in cluster 1.
  [[nodiscard]] PlanResult plan_in_clusters(ClusterId second) const {
    return plan_in_clusters(second, between(u_, v_));
  }
  [[nodiscard]] PlanResult plan_in_clusters(ClusterId second, const PlanRequest& request) const {
    ClusterTree clusters;
    for (ClusterId id = 1; id <= second; ++id) {
      clusters.clusters[id].id = id;
      clusters.clusters[id].anchor = id == 1 ? u_ : v_;
    }
    clusters.cluster_of = {{u_, 1}, {m_, 1}, {p_, second}, {v_, second}};
    clusters.next_id = second + 1;
    const Hierarchies hierarchies(world.graph, clusters, {});
    WorldView view = world.view();
    view.hierarchies = &hierarchies;
    return HybridPlanner(config, router, searcher).plan(request, view, {});
  }

  LandmarkId u_, m_, p_, v_;
};

TEST_F(HybridDetour, WithinOneClusterIsNotTaken) {
  config.shortened_ratio = 3.0;
  const PlanResult result = plan_in_clusters(1);
  ASSERT_EQ(result.outcome, PlanOutcome::solved) << result.reason;
  EXPECT_THAT(result.reason, MatchesRegex("directly: over landmarks it costs [0-9.]+ m, more than 1.3 times the direct "
                                          "path's lower bound of [0-9.]+ m; .*"));
  EXPECT_GT(number_after(result.reason, "it costs "), 1.3 * number_after(result.reason, "lower bound of "));
}

TEST_F(HybridDetour, FromClusterToClusterIsTakenUpToTheShortenedRatio) {
  const PlanResult direct = plan_in_clusters(2);
  ASSERT_EQ(direct.outcome, PlanOutcome::solved) << direct.reason;
  EXPECT_EQ(router->calls, 1) << "for the direct path alone: no leg is planned of a path that is not taken";
  EXPECT_THAT(
      direct.reason,
      MatchesRegex("directly: over landmarks it is [0-9.]+ m long with its corners cut, more than 1.1 times the "
                   "direct path's lower bound of [0-9.]+ m; .*"))
      << "1.1 unless set";
  EXPECT_GE(number_after(direct.reason, "lower bound of "), 0.9 * direct.length_m);
  EXPECT_LE(number_after(direct.reason, "lower bound of "), direct.length_m + 0.005);
  config.shortened_ratio = 3.0;
  const PlanResult over = plan_in_clusters(2);
  ASSERT_EQ(over.outcome, PlanOutcome::solved) << over.reason;
  EXPECT_THAT(over.landmarks, ElementsAre(u_, m_, p_, v_)) << over.reason;
  EXPECT_GT(over.length_m, 1.1 * direct.length_m);
  EXPECT_LT(over.length_m, over.cost_m);
  EXPECT_NEAR(number_after(direct.reason, "over landmarks it is "), over.length_m, 0.05)
      << "what was compared, not its cost";
  expect_clear(over);
}

// Cutting corners from one end only leaves other corners than from the other.
TEST_F(HybridDetour, IsTakenInBothDirectionsOrInNone) {
  route(v_, p_, "VP");
  route(p_, m_, "", 0.8);
  route(m_, u_, "MU");
  int taken = 0;
  for (const double ratio : {1.1, 1.5, 1.6, 1.7, 1.8, 1.9, 2.0, 2.5}) {
    config.shortened_ratio = ratio;
    const bool over = plan_in_clusters(2).landmarks.size() > 2;
    const bool back = plan_in_clusters(2, between(v_, u_)).landmarks.size() > 2;
    EXPECT_EQ(over, back) << ratio;
    taken += over ? 1 : 0;
  }
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, 8);
}

}  // namespace
}  // namespace cairn
