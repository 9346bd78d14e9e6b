#include "plugins/submap_graph/gathered_echoes.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cairn::submap_graph {
namespace {

const std::vector<Point> kAhead = {{1.0, 0.0}};

TEST(GatheredEchoes, ThoseOfTheLastMetresOfTheWayAreSeenFromANode) {
  GatheredEchoes echoes(2.0);
  for (int i = 0; i <= 5; ++i) echoes.add(kAhead, {1.0 * i, 0.0, 0.0});
  const Pose2 T_local_node{5.0, 1.0, 0.5 * std::numbers::pi};
  const std::vector<Point> seen_m = echoes.all(T_local_node);
  ASSERT_EQ(seen_m.size(), 3U) << "of the poses 3, 4 and 5";
  EXPECT_NEAR(seen_m.front().x(), -1.0, 1e-12);
  EXPECT_NEAR(seen_m.front().y(), 1.0, 1e-12);
}

TEST(GatheredEchoes, EachIsNewOnce) {
  GatheredEchoes echoes(2.0);
  echoes.add(kAhead, {});
  echoes.add(kAhead, {0.3, 0.0, 0.0});
  EXPECT_EQ(echoes.since_last_node({}).size(), 2U);
  EXPECT_TRUE(echoes.since_last_node({}).empty());
  echoes.add(kAhead, {9.0, 0.0, 0.0});
  EXPECT_EQ(echoes.since_last_node({}).size(), 1U);
  EXPECT_EQ(echoes.all({}).size(), 1U);
}

TEST(GatheredEchoes, NothingIsKeptOfNoWay) {
  GatheredEchoes echoes(0.0);
  echoes.add(kAhead, {});
  EXPECT_TRUE(echoes.all({}).empty());
}

}  // namespace
}  // namespace cairn::submap_graph
