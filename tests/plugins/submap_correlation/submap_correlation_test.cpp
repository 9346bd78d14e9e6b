#include "plugins/submap_correlation/submap_correlation.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/maps/submaps/seen_room.hpp"

namespace cairn::submap_correlation {
namespace {

constexpr int kBeams = 120;

// A submap of a short drive through the room, and a node beside it.
class SubmapCorrelationTest : public testing::Test {
 protected:
  SubmapCorrelationTest() {
    for (int i = 0; i < 5; ++i) {
      const Pose2 T_map_robot{1.5 + 0.5 * i, 1.5, 0.0};
      submap_->add(static_cast<std::size_t>(i), inverse(kAnchor) * T_map_robot,
                   seen_from(walls_, T_map_robot, kBeams, 0.01, static_cast<std::uint64_t>(i) + 1));
    }
  }
  // The node is believed to be off by so much, as seen from itself.
  [[nodiscard]] LoopQuery query(const Pose2& off) const {
    LoopQuery query;
    query.node = 100;
    query.points_m = points_m_;
    query.T_map_node = kNode * off;
    query.submaps = submaps_;
    return query;
  }
  [[nodiscard]] std::vector<LoopProposal> proposals(const LoopQuery& query, const Config& config = {}) const {
    SubmapCorrelation closer(config);
    return closer.propose(query, Budget{});
  }

  static constexpr Pose2 kAnchor{1.5, 1.5, 0.0};
  static constexpr Pose2 kNode{3.2, 1.8, 0.4};
  const std::vector<DrawnWall> walls_ = drawn_room();
  std::shared_ptr<Submap> submap_ = std::make_shared<Submap>(0, 0.1);
  std::vector<PassedSubmap> submaps_ = {{submap_, kAnchor, 0.5}};
  std::vector<Point> points_m_ = seen_from(walls_, kNode, kBeams, 0.01, 99);
};

TEST_F(SubmapCorrelationTest, FindsTheNodeWhereItIsNotWhereItIsBelievedToBe) {
  const std::vector<LoopProposal> found = proposals(query({0.6, -0.5, 0.15}));
  ASSERT_EQ(found.size(), 1U);
  const Pose2 off = inverse(inverse(kAnchor) * kNode) * found[0].T_submap_node;
  EXPECT_LT(off.position().norm(), 0.02);
  EXPECT_LT(std::abs(off.theta_rad), radians(0.5));
  EXPECT_GT(found[0].score, 0.8);
}

TEST_F(SubmapCorrelationTest, TheWindowGrowsWithTheDriftUpToItsLimit) {
  LoopQuery far = query({0.0, 0.0, 0.0});
  far.T_map_node.x_m += 2.5;
  EXPECT_TRUE(proposals(far).empty());
  far.drift_m = 2.0;
  EXPECT_EQ(proposals(far).size(), 1U);
  Config narrow;
  narrow.max_window_m = 1.5;
  EXPECT_TRUE(proposals(far, narrow).empty());
}

TEST_F(SubmapCorrelationTest, AKnownHeadingTakesThePlaceOfItsOwnWindow) {
  LoopQuery turned = query({0.0, 0.0, radians(25.0)});
  EXPECT_TRUE(proposals(turned).empty());
  turned.max_turn_rad = radians(30.0);
  EXPECT_EQ(proposals(turned).size(), 1U);
}

TEST_F(SubmapCorrelationTest, AfterwardsTheWindowIsHalfTheLeast) {
  LoopQuery off = query({0.0, 0.0, 0.0});
  off.T_map_node.x_m += 0.8;
  EXPECT_EQ(proposals(off).size(), 1U);
  off.is_afterwards = true;
  EXPECT_TRUE(proposals(off).empty());
}

TEST_F(SubmapCorrelationTest, OfManySubmapsTheNearestAreSearched) {
  submaps_.clear();
  for (int i = 9; i >= 0; --i) submaps_.push_back({submap_, kAnchor, 0.1 * i});
  const std::vector<LoopProposal> found = proposals(query({}));
  ASSERT_EQ(found.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(found[i].submap, 9 - i);
  LoopQuery last = query({});
  last.is_afterwards = true;
  EXPECT_EQ(proposals(last).size(), 8U);
  submaps_ = {{submap_, kAnchor, 8.0}};
  EXPECT_TRUE(proposals(query({})).empty()) << "6 m around a submap's nodes, and the window";
}

// Of a plain corridor the place along it is uncertain.
TEST_F(SubmapCorrelationTest, WhatTheWallsDoNotSayIsNotInTheInformation) {
  const std::vector<DrawnWall> corridor = walls_of({{-100.0, 0.0}, {100.0, 0.0}, {100.0, 2.0}, {-100.0, 2.0}});
  const auto seen = [&](const Pose2& T_map_robot, std::uint64_t seed) {
    std::vector<Point> points_m = seen_from(corridor, T_map_robot, 360, 0.005, seed);
    std::erase_if(points_m, [](const Point& point_m) { return point_m.norm() > 6.0; });
    return points_m;
  };
  const auto submap = std::make_shared<Submap>(0, 0.1);
  for (int i = 0; i < 5; ++i)
    submap->add(static_cast<std::size_t>(i), {0.5 * i, 0.0, 0.0}, seen({0.5 * i, 1.0, 0.0}, 7));
  submaps_ = {{submap, {0.0, 1.0, 0.0}, 0.5}};
  points_m_ = seen({1.3, 1.0, 0.0}, 8);
  LoopQuery along = query({});
  along.T_map_node = {1.3, 1.0, 0.0};
  const std::vector<LoopProposal> found = proposals(along);
  ASSERT_EQ(found.size(), 1U);
  const Eigen::Matrix3d& information = found[0].information;
  EXPECT_GT(information(1, 1), 20.0 * information(0, 0));
}

TEST_F(SubmapCorrelationTest, ACancelledSearchBeginsNoSubmap) {
  const std::atomic<bool> cancel{true};
  SubmapCorrelation closer{Config{}};
  EXPECT_TRUE(closer.propose(query({}), Budget{.cancel = &cancel}).empty());
  EXPECT_EQ(closer.propose(query({}), Budget{}).size(), 1U);
}

TEST_F(SubmapCorrelationTest, NothingIsFoundWithoutEchoesOrSubmaps) {
  points_m_.clear();
  EXPECT_TRUE(proposals(query({})).empty());
  submaps_.clear();
  EXPECT_TRUE(proposals(query({})).empty());
}

}  // namespace
}  // namespace cairn::submap_correlation
