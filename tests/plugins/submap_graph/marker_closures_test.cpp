#include "plugins/submap_graph/marker_closures.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

namespace cairn::submap_graph {
namespace {

const Pose2 kT_map_marker{5.0, 1.0, radians(200.0)};

MarkerSighting seen_from(const Pose2& T_map_robot, double position_m = 0.02, double angle_rad = 0.02) {
  MarkerSighting sighting;
  sighting.marker = {MarkerFamily::tag36h11, 7};
  sighting.pose.T_robot_marker = inverse(T_map_robot) * kT_map_marker;
  sighting.pose.covariance =
      Eigen::Vector3d(position_m * position_m, position_m * position_m, angle_rad * angle_rad).asDiagonal();
  return sighting;
}

TEST(MarkerClosures, TieANodeToTheOneThatTheMarkerWasSeenFromFirst) {
  MarkerClosures closures;
  const Pose2 T_map_first{1.0, 0.0, 0.2};
  const Pose2 T_map_node{2.0, 1.5, -0.3};
  const Pose2 T_node_robot{0.2, 0.1, 0.1};
  EXPECT_FALSE(closures.see(seen_from(T_map_first), 3, {}));
  EXPECT_FALSE(closures.see(seen_from(T_map_node), 5, {})) << "the way between them says as much";
  const auto closure = closures.see(seen_from(T_map_node * T_node_robot), 40, T_node_robot);
  ASSERT_TRUE(closure);
  EXPECT_EQ(closure->anchor, 3U);
  EXPECT_EQ(closure->node, 40U);
  const Pose2 off = inverse(closure->T_anchor_node) * (inverse(T_map_first) * T_map_node);
  EXPECT_LT(off.position().norm() + std::abs(off.theta_rad), 1e-9);
  EXPECT_FALSE(closures.see(seen_from(T_map_node), 40, {})) << "once a node";
  EXPECT_TRUE(closures.see(seen_from(T_map_node), 41, {}));
}

TEST(MarkerClosures, AnAmbiguousSightingSaysNothing) {
  MarkerClosures closures;
  MarkerSighting unsure = seen_from({1.0, 0.0, 0.0});
  unsure.mirrored = unsure.pose;
  EXPECT_FALSE(closures.see(unsure, 0, {}));
  EXPECT_FALSE(closures.see(seen_from({1.0, 0.0, 0.0}), 20, {})) << "the first that counts";
}

// Against errors that are drawn.
TEST(MarkerClosures, TheirInformationIsThatOfTheirErrors) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Pose2 T_map_first{1.0, 0.0, 0.2};
  const Pose2 T_map_node{2.0, 3.5, -0.9};
  constexpr double kPosition_m = 0.05;
  constexpr double kAngle_rad = 0.04;
  const auto drawn_from = [&](const Pose2& T_map_robot) {
    MarkerSighting sighting = seen_from(T_map_robot, kPosition_m, kAngle_rad);
    Pose2& T_robot_marker = sighting.pose.T_robot_marker;
    T_robot_marker.x_m += kPosition_m * normal(random);
    T_robot_marker.y_m += kPosition_m * normal(random);
    T_robot_marker.theta_rad += kAngle_rad * normal(random);
    return sighting;
  };
  double sum = 0.0;
  constexpr int kDraws = 2000;
  for (int i = 0; i < kDraws; ++i) {
    MarkerClosures closures;
    (void)closures.see(drawn_from(T_map_first), 0, {});
    const auto closure = closures.see(drawn_from(T_map_node), 20, {});
    const Pose2 off = inverse(inverse(T_map_first) * T_map_node) * closure->T_anchor_node;
    const Eigen::Vector3d error(off.x_m, off.y_m, wrap_angle(off.theta_rad));
    sum += error.dot(closure->information * error);
  }
  EXPECT_NEAR(sum / kDraws, 2.2, 0.6) << "3, less the floor of 0.03 m and half a degree";
}

}  // namespace
}  // namespace cairn::submap_graph
