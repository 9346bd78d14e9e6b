#include "plugins/submap_graph/laser_graph.hpp"

#include <gtest/gtest.h>

#include "tests/plugins/submap_graph/driven_ring.hpp"

namespace cairn::submap_graph {
namespace {

constexpr int kBeams = 120;

LaserGraph driven(const std::vector<DrivenScan>& drive, const Config& config = {}) {
  LaserGraph graph(config, drive.front().T_map_robot);
  const std::vector<DrawnWall> walls = ring_walls();
  std::uint64_t seed = 0;
  for (const DrivenScan& scan : drive)
    graph.add(seen_from(walls, scan.T_map_robot, kBeams, 0.01, ++seed), scan.T_odom_robot);
  return graph;
}

double worst_error_m(const std::vector<Pose2>& poses, const std::vector<DrivenScan>& drive) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i)
    worst_m = std::max(worst_m, (poses[i].position() - drive[i].T_map_robot.position()).norm());
  return worst_m;
}

TEST(LaserGraph, ADriveRoundAndRoundComesBackToWhereItBeganAlthoughOdometryDoesNot) {
  const std::vector<DrivenScan> drive = ring_drive(2, radians(3.0), 0.05);
  const Pose2 T_odom_first = drive.front().T_map_robot;
  EXPECT_GT((T_odom_first * drive.back().T_odom_robot).position().norm(), 5.0) << "odometry alone";
  LaserGraph graph = driven(drive);
  while (graph.finish_part()) {
  }
  EXPECT_GT(graph.graph().believed(), 20U);
  EXPECT_GE(graph.revision(), 1U);
  EXPECT_LT(worst_error_m(graph.poses(), drive), 0.08);
  EXPECT_FALSE(graph.finish_part()) << "once is enough";
}

// Eight echoes a scan, of at most 5 m: none is matched alone.
TEST(LaserGraph, FewEchoesThatAreGatheredOverTheWayCloseLoopsToo) {
  const std::vector<DrivenScan> drive = ring_drive(3, radians(0.3), 0.01);
  Config config;
  config.gather_m = 5.0;
  config.submap_m = 8.0;
  config.surface_cell_m = 0.3;
  config.echo_sigma_m = 0.1;
  config.odometry_ratio = 0.05;
  config.odometry_rad_per_m = radians(2.0);
  LaserGraph graph(config, drive.front().T_map_robot);
  const std::vector<DrawnWall> walls = ring_walls();
  std::uint64_t seed = 0;
  for (const DrivenScan& scan : drive)
    graph.add(seen_from(walls, scan.T_map_robot, 8, 0.02, ++seed), scan.T_odom_robot);
  while (graph.finish_part()) {
  }
  const double odometry_m = (drive.front().T_map_robot * drive.back().T_odom_robot).position().norm();
  EXPECT_GT(graph.graph().believed(), 10U);
  EXPECT_LT((graph.poses().back().position() - drive.back().T_map_robot.position()).norm(), 0.5 * odometry_m);
}

TEST(LaserGraph, TheSameScansGiveTheSamePosesToTheLastBit) {
  std::vector<DrivenScan> drive = ring_drive(1, radians(2.0), 0.0);
  drive.resize(60);
  EXPECT_EQ(driven(drive).poses(), driven(drive).poses());
}

TEST(LaserGraph, WithoutEchoesItFollowsOdometry) {
  LaserGraph graph({}, {1.0, 2.0, 0.5});
  Pose2 T_odom_robot;
  for (int i = 0; i < 30; ++i) {
    graph.add({}, T_odom_robot);
    T_odom_robot = T_odom_robot * Pose2{0.2, 0.0, 0.05};
  }
  while (graph.finish_part()) {
  }
  const std::vector<Pose2> poses = graph.poses();
  ASSERT_EQ(poses.size(), 30U);
  const Pose2 T_back =
      inverse(T_odom_robot * inverse(Pose2{0.2, 0.0, 0.05})) * inverse(Pose2{1.0, 2.0, 0.5}) * poses.back();
  EXPECT_LT(T_back.position().norm(), 1e-6);
}

TEST(LaserGraph, ARobotThatStandsStillAddsNoNodes) {
  const std::vector<DrawnWall> walls = ring_walls();
  LaserGraph graph({}, {1.0, 1.0, 0.0});
  for (std::uint64_t seed = 1; seed <= 50; ++seed) graph.add(seen_from(walls, {1.0, 1.0, 0.0}, kBeams, 0.01, seed), {});
  EXPECT_EQ(graph.graph().size(), 1U);
  EXPECT_EQ(graph.poses().size(), 50U);
}

}  // namespace
}  // namespace cairn::submap_graph
