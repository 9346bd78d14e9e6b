#include "plugins/submap_graph/closures.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/submap_graph/driven_ring.hpp"
#include "tests/plugins/submap_graph/usual_closer.hpp"

namespace cairn::submap_graph {
namespace {

// A finished submap of the way from (3, 1) to (7, 1), then a long way elsewhere, then back.
class ClosuresTest : public testing::Test {
 protected:
  ClosuresTest() {
    for (std::size_t i = 0; i < 9; ++i) drive({3.0 + 0.5 * static_cast<double>(i), 1.0, 0.0}, true);
    for (std::size_t i = 0; i < 40; ++i)
      drive({7.0 + 0.2 * static_cast<double>(i), 1.0 + 0.2 * static_cast<double>(i), 0.0}, false);
    submaps_.push_back(submap_);
  }
  // Believed to be off by so much from where it is, as seen from the map.
  std::size_t drive(const Pose2& T_map_robot, bool is_in_submap, const Point& off_m = {0.0, 0.0}) {
    const std::vector<Point> points_m = seen_from(walls_, T_map_robot, 120, 0.01, ++seed_);
    const std::size_t node =
        graph_.add_node({T_map_robot.x_m + off_m.x(), T_map_robot.y_m + off_m.y(), T_map_robot.theta_rad});
    closures_.add_node(points_m, T_map_robot);
    if (is_in_submap) submap_->add(node, inverse(Pose2{3.0, 1.0, 0.0}) * T_map_robot, points_m);
    return node;
  }

  const std::vector<DrawnWall> walls_ = ring_walls();
  std::uint64_t seed_ = 0;
  TiedGraph graph_;
  std::shared_ptr<LoopCloser> closer_ = usual_closer();
  Closures closures_{Config{}, closer_};
  std::shared_ptr<Submap> submap_ = std::make_shared<Submap>(0, 0.1);
  std::vector<std::shared_ptr<const Submap>> submaps_;
};

TEST_F(ClosuresTest, AClosureIsBelievedWhenASecondOneAgrees) {
  const std::size_t first = drive({5.0, 1.0, 0.0}, false, {0.5, 0.3});
  EXPECT_TRUE(closures_.close(first, graph_, submaps_, Budget{}).empty()) << "one alone";
  const std::size_t second = drive({5.6, 1.0, 0.0}, false, {0.5, 0.3});
  const std::vector<Closure> believed = closures_.close(second, graph_, submaps_, Budget{});
  ASSERT_EQ(believed.size(), 2U);
  EXPECT_EQ(believed[0].node, first);
  EXPECT_EQ(believed[1].node, second);
  EXPECT_NEAR(believed[1].T_anchor_node.x_m, 2.6, 0.03) << "where it is, not where it was believed to be";
  EXPECT_NEAR(believed[1].T_anchor_node.y_m, 0.0, 0.03);
}

TEST_F(ClosuresTest, AnotherPlaceGivesNoClosureWhateverIsBelieved) {
  for (int i = 0; i < 4; ++i) {
    const std::size_t node = drive({15.0, 4.0 + 0.6 * i, radians(90.0)}, false, {-9.5, -3.0 - 0.6 * i});
    EXPECT_TRUE(closures_.close(node, graph_, submaps_, Budget{}).empty()) << i;
  }
}

// Records what it is asked, and proposes nothing but what it is given.
class RecordingCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget&) override {
    asked.push_back(query);
    submaps.emplace_back(query.submaps.begin(), query.submaps.end());
    return proposed;
  }
  std::vector<LoopProposal> proposed;
  std::vector<LoopQuery> asked;
  std::vector<std::vector<PassedSubmap>> submaps;
};

TEST_F(ClosuresTest, NodesOfTheSubmapAndItsNeighboursOnTheWayAreNoCandidates) {
  const auto closer = std::make_shared<RecordingCloser>();
  closures_ = Closures(Config{}, closer);
  for (std::size_t i = 0; i < 9; ++i) closures_.add_node({}, {3.0 + 0.5 * static_cast<double>(i), 1.0, 0.0});
  EXPECT_TRUE(closures_.close(4, graph_, submaps_, Budget{}).empty());
  EXPECT_TRUE(closures_.close_again(4, graph_, submaps_).empty());
  ASSERT_EQ(closer->asked.size(), 2U);
  EXPECT_TRUE(closer->submaps[0].empty());
  EXPECT_TRUE(closer->submaps[1].empty());
}

TEST_F(ClosuresTest, TheCloserHearsWhereTheNodeIsBelievedToBeAndHowFarThatMayBeOff) {
  const auto closer = std::make_shared<RecordingCloser>();
  closures_ = Closures(Config{}, closer);
  const std::vector<Point> echo = {{1.0, 2.0}};
  for (std::size_t node = 0; node < graph_.size(); ++node)
    closures_.add_node(echo, {0.5 * static_cast<double>(node), 0.0, 0.0});
  const std::size_t last = graph_.size() - 1;
  (void)closures_.close(last, graph_, submaps_, Budget{});
  (void)closures_.close_again(last, graph_, submaps_);
  ASSERT_EQ(closer->asked.size(), 2U);
  const LoopQuery& query = closer->asked[0];
  EXPECT_EQ(query.node, last);
  EXPECT_EQ(query.points_m.size(), 1U);
  EXPECT_EQ(query.T_map_node, graph_.T_map(last));
  EXPECT_NEAR(query.drift_m, 0.03 * 0.5 * static_cast<double>(last), 1e-9) << "nothing has closed yet";
  EXPECT_FALSE(query.max_turn_rad.has_value());
  EXPECT_FALSE(query.is_afterwards);
  ASSERT_EQ(closer->submaps[0].size(), 1U);
  EXPECT_EQ(closer->submaps[0][0].submap, submap_);
  EXPECT_EQ(closer->submaps[0][0].T_map_submap, graph_.T_map(0));
  EXPECT_NEAR(closer->submaps[0][0].distance_m, (graph_.T_map(last).position() - Point(7.0, 1.0)).norm(), 1e-9);
  EXPECT_TRUE(closer->asked[1].is_afterwards);
  EXPECT_TRUE(closer->asked[1].max_turn_rad.has_value());
}

TEST_F(ClosuresTest, ARunThatGoesOnLooksAroundAsFarAsItsStartMayBeOffUntilALoopCloses) {
  const std::vector<Pose2> held = {{3.0, 1.0, 0.0}};
  const auto closer = std::make_shared<RecordingCloser>();
  closures_ = Closures(Config{}, closer);
  closures_.hold(held, 1.5);
  graph_ = {};
  graph_.add_node(held.front());
  const auto submap = std::make_shared<Submap>(0, 0.1);
  submap->add(0, {}, {});
  const std::vector<std::shared_ptr<const Submap>> submaps = {submap};
  for (std::size_t i = 0; i < 3; ++i) {
    const Pose2 pose{4.0 + 2.0 * static_cast<double>(i), 1.0, 0.0};
    closures_.add_node({}, pose);
    closer->proposed = {LoopProposal{0, inverse(held.front()) * pose}};
    (void)closures_.close(graph_.add_node(pose), graph_, submaps, Budget{});
  }
  ASSERT_EQ(closer->asked.size(), 3U);
  EXPECT_NEAR(closer->asked[0].drift_m, 1.5, 1e-9);
  EXPECT_NEAR(closer->asked[1].drift_m, 1.5 + 0.03 * 2.0, 1e-9);
  EXPECT_NEAR(closer->asked[2].drift_m, 0.03 * 2.0, 1e-9) << "the second closure has found a witness";
}

TEST_F(ClosuresTest, WithoutACloserThereAreNone) {
  closures_ = Closures(Config{}, nullptr);
  closures_.add_node({}, {});
  EXPECT_TRUE(closures_.close(0, graph_, submaps_, Budget{}).empty());
  EXPECT_TRUE(closures_.close_again(0, graph_, submaps_).empty());
}

}  // namespace
}  // namespace cairn::submap_graph
