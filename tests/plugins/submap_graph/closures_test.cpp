#include "plugins/submap_graph/closures.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/submap_graph/driven_ring.hpp"

namespace cairn::submap_graph {
namespace {

// A finished submap of the way from (3, 1) to (7, 1), then a long way elsewhere, then back.
class CloserTest : public testing::Test {
 protected:
  CloserTest() {
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
    closer_.add_node(points_m, T_map_robot);
    if (is_in_submap) submap_->add(node, inverse(Pose2{3.0, 1.0, 0.0}) * T_map_robot, points_m);
    return node;
  }

  const std::vector<DrawnWall> walls_ = ring_walls();
  std::uint64_t seed_ = 0;
  TiedGraph graph_;
  Closer closer_{Config{}};
  std::shared_ptr<Submap> submap_ = std::make_shared<Submap>(0, 0.1);
  std::vector<std::shared_ptr<const Submap>> submaps_;
};

TEST_F(CloserTest, AClosureIsBelievedWhenASecondOneAgrees) {
  const std::size_t first = drive({5.0, 1.0, 0.0}, false, {0.5, 0.3});
  EXPECT_TRUE(closer_.close(first, graph_, submaps_).empty()) << "one alone";
  const std::size_t second = drive({5.6, 1.0, 0.0}, false, {0.5, 0.3});
  const std::vector<Closure> believed = closer_.close(second, graph_, submaps_);
  ASSERT_EQ(believed.size(), 2U);
  EXPECT_EQ(believed[0].node, first);
  EXPECT_EQ(believed[1].node, second);
  EXPECT_NEAR(believed[1].T_anchor_node.x_m, 2.6, 0.03) << "where it is, not where it was believed to be";
  EXPECT_NEAR(believed[1].T_anchor_node.y_m, 0.0, 0.03);
}

TEST_F(CloserTest, AnotherPlaceGivesNoClosureWhateverIsBelieved) {
  for (int i = 0; i < 4; ++i) {
    const std::size_t node = drive({15.0, 4.0 + 0.6 * i, radians(90.0)}, false, {-9.5, -3.0 - 0.6 * i});
    EXPECT_TRUE(closer_.close(node, graph_, submaps_).empty()) << i;
  }
}

TEST_F(CloserTest, NodesOfTheSubmapAndItsNeighboursOnTheWayAreLeftOut) {
  EXPECT_TRUE(closer_.close(4, graph_, submaps_).empty());
  EXPECT_TRUE(closer_.close_again(4, graph_, submaps_).empty());
}

}  // namespace
}  // namespace cairn::submap_graph
