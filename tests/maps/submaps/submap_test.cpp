#include "maps/submaps/submap.hpp"

#include <gtest/gtest.h>

#include "tests/maps/submaps/seen_room.hpp"

namespace cairn {
namespace {

TEST(Submap, HoldsScansInTheFrameOfItsAnchorWhereverTheAnchorIsInTheMap) {
  const std::vector<DrawnWall> room = drawn_room();
  const Pose2 T_map_anchor{3.0, 2.0, 0.7};
  Submap submap(7, 0.1);
  for (int i = 0; i < 4; ++i) {
    const Pose2 T_anchor_node{0.3 * i, 0.0, 0.1 * i};
    const auto seed = static_cast<std::uint64_t>(i + 1);
    submap.add(7 + static_cast<std::size_t>(i), T_anchor_node,
               seen_from(room, T_map_anchor * T_anchor_node, 180, 0.01, seed));
  }
  EXPECT_EQ(submap.anchor(), 7U);
  EXPECT_EQ(submap.nodes(), (std::vector<std::size_t>{7, 8, 9, 10}));
  const Pose2 T_anchor_scan{0.5, 0.2, -0.3};
  const std::vector<Point> scan_m = seen_from(room, T_map_anchor * T_anchor_scan, 180, 0.01, 9);
  const auto found = search(submap.pyramid(0.1, 0.12, 5), scan_m, {{}, 1.0, 0.5}, 0.5);
  ASSERT_TRUE(found);
  const Alignment aligned = align(submap.surfaces(), scan_m, found->T_field_scan, {}, {});
  EXPECT_LT((aligned.T_map_scan.position() - T_anchor_scan.position()).norm(), 0.01);
}

}  // namespace
}  // namespace cairn
