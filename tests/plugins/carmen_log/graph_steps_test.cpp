#include "plugins/carmen_log/graph_steps.hpp"

#include <gtest/gtest.h>

#include "plugins/carmen_log/carmen_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::carmen_log {
namespace {

std::string scan(double stamp_s, double x_m) {
  return "ROBOTLASER1 0 -1.5 3 1.5 50 0.1 0 2 4 5 0 " + std::to_string(x_m) + " 0 0 " + std::to_string(x_m) +
         " 0 0 0 0 0 0 0 " + std::to_string(stamp_s) + " host 0\n";
}

std::vector<Observation> play(const std::string& text, Poses poses, std::string& reason) {
  const log_files::LogFolder folder;
  Config config;
  config.file = folder.write("a.log", text);
  config.poses = poses;
  log_common::ScanPlayer player(read_carmen_log(config));
  return log_files::play(player, reason);
}

// The vertices are corrected: the middle one does not lie where the steps lead.
const std::string kGraph = "VERTEX2 10 0 0 0\n" + scan(1.0, 0.0) + "VERTEX2 11 9 9 0\n" + scan(2.0, 9.0) +
                           "VERTEX2 12 2 0 0\n" + scan(3.0, 2.0) +
                           "#SEQUENTIAL EDGES\n"
                           "EDGE2 12 11 -1 0 0 1 0 1 1 0 0\n"
                           "EDGE2 10 11 1 0 0.5 1 0 1 1 0 0\n"
                           "#LOOP EDGES\nEDGE2 10 12 3 3 3 1 0 1 1 0 0\n";

TEST(GraphSteps, TheEdgesBetweenTheScansAreTheOdometryWhereItIsAskedFor) {
  std::string reason;
  const auto seen = play(kGraph, Poses::odometry, reason);
  ASSERT_EQ(seen.size(), 3U);
  EXPECT_EQ(seen[0].T_odom_robot, Pose2{});
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 1.0, 1e-12);
  EXPECT_NEAR(seen[1].T_odom_robot.theta_rad, 0.5, 1e-12);
  EXPECT_NEAR(seen[2].T_odom_robot.x_m, 1.0 + std::cos(0.5), 1e-12) << "an edge that is stated from its end";
  EXPECT_NEAR(seen[2].T_odom_robot.y_m, std::sin(0.5), 1e-12);
  EXPECT_EQ(seen[2].recorded_s, 3.0);
}

TEST(GraphSteps, TheLinesPosesStayTheOdometryOtherwise) {
  std::string reason;
  EXPECT_EQ(play(kGraph, Poses::log, reason)[1].T_odom_robot.x_m, 9.0);
  EXPECT_EQ(play(scan(1.0, 0.0) + scan(2.0, 9.0), Poses::odometry, reason)[1].T_odom_robot.x_m, 9.0) << "no graph";
}

TEST(GraphSteps, AScanWithoutAnEdgeFromTheOneBeforeIsCounted) {
  std::string reason;
  const auto seen = play("VERTEX_SE2 0 0 0 0\n" + scan(1.0, 0.0) + "VERTEX_SE2 1 5 0 0\n" + scan(2.0, 5.0) +
                             "VERTEX_SE2 2 6 0 0\n" + scan(3.0, 6.0) + "EDGE_SE2 1 2 1 0 0 1 0 0 1 0 1\nFIX 0\n",
                         Poses::odometry, reason);
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 5.0, 1e-12) << "as the laser lines say";
  EXPECT_NEAR(seen[2].T_odom_robot.x_m, 6.0, 1e-12);
  EXPECT_NE(reason.find("1 step between scans without an edge, taken from the laser lines"), std::string::npos)
      << reason;
}

TEST(GraphSteps, StepsLeadOverVerticesWithoutScans) {
  std::string reason;
  const auto seen = play("VERTEX_SE2 0 0 0 0\n" + scan(1.0, 0.0) + "VERTEX_SE2 1 5 0 0\nVERTEX_SE2 2 6 0 0\n" +
                             scan(3.0, 6.0) + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 1 2 2 0 0 1 0 0 1 0 1\n",
                         Poses::odometry, reason);
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 3.0, 1e-12);
  EXPECT_EQ(reason.find("without an edge"), std::string::npos) << reason;
}

TEST(GraphSteps, ScansBehindAllVerticesBelongToThemInOrder) {
  std::string reason;
  const auto seen = play(
      "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 5 0 0\n" + scan(1.0, 0.0) + scan(2.0, 5.0) + "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n",
      Poses::odometry, reason);
  EXPECT_NEAR(seen[1].T_odom_robot.x_m, 1.0, 1e-12);
}

TEST(GraphSteps, AVertexThatIsNoWholeNumberIsRefusedAtItsPlace) {
  std::string reason;
  try {
    (void)play("VERTEX2 0.5 0 0 0\n" + scan(1.0, 0.0), Poses::odometry, reason);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_NE(std::string(error.what()).find("a.log:1:9: a vertex is a whole number from 0 on, not 0.5"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace cairn::carmen_log
