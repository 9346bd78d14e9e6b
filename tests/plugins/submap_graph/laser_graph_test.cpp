#include "plugins/submap_graph/laser_graph.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

#include "tests/plugins/submap_graph/driven_ring.hpp"
#include "tests/plugins/submap_graph/usual_closer.hpp"

namespace cairn::submap_graph {
namespace {

constexpr int kBeams = 120;

constexpr double kPeriod_s = 0.5;

LaserGraph driven(const std::vector<DrivenScan>& drive, std::shared_ptr<LoopCloser> closer = usual_closer()) {
  LaserGraph graph({}, drive.front().T_map_robot, std::move(closer));
  const std::vector<DrawnWall> walls = ring_walls();
  double stamp_s = 0.0;
  std::uint64_t seed = 0;
  for (const DrivenScan& scan : drive)
    graph.add(seen_from(walls, scan.T_map_robot, kBeams, 0.01, ++seed), scan.T_odom_robot, stamp_s += kPeriod_s);
  return graph;
}

// Where each scan was put when it came, the machine being slow or not.
std::vector<Pose2> first_answers(const std::vector<DrivenScan>& drive, double period_s,
                                 std::chrono::microseconds pause) {
  LaserGraph graph({}, drive.front().T_map_robot, usual_closer());
  const std::vector<DrawnWall> walls = ring_walls();
  double stamp_s = 0.0;
  std::uint64_t seed = 0;
  std::vector<Pose2> answers;
  answers.reserve(drive.size());
  for (const DrivenScan& scan : drive) {
    const std::vector<Point> seen = seen_from(walls, scan.T_map_robot, kBeams, 0.01, ++seed);
    answers.push_back(graph.add(seen, scan.T_odom_robot, stamp_s += period_s));
    std::this_thread::sleep_for(pause);
  }
  EXPECT_GE(graph.revision(), 1U);
  return answers;
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
  LaserGraph graph(config, drive.front().T_map_robot, usual_closer());
  const std::vector<DrawnWall> walls = ring_walls();
  std::uint64_t seed = 0;
  for (const DrivenScan& scan : drive)
    graph.add(seen_from(walls, scan.T_map_robot, 8, 0.02, ++seed), scan.T_odom_robot,
              kPeriod_s * static_cast<double>(seed));
  while (graph.finish_part()) {
  }
  const double odometry_m = (drive.front().T_map_robot * drive.back().T_odom_robot).position().norm();
  EXPECT_GT(graph.graph().believed(), 10U);
  for (const Closure& closure : graph.graph().closures())
    EXPECT_LT(closure.information(2, 2), 1.0 / (radians(2.0) * radians(2.0))) << "echoes on axes know no more";
  EXPECT_LT((graph.poses().back().position() - drive.back().T_map_robot.position()).norm(), 0.5 * odometry_m);
}

TEST(LaserGraph, TheSameScansGiveTheSamePosesToTheLastBit) {
  std::vector<DrivenScan> drive = ring_drive(1, radians(2.0), 0.0);
  drive.resize(60);
  EXPECT_EQ(driven(drive).poses(), driven(drive).poses());
}

// At 20 Hz answers are taken four scans after they were asked for, and must not come when they are ready.
TEST(LaserGraph, HowLongASearchTakesChangesNothing) {
  const std::vector<DrivenScan> drive = ring_drive(2, radians(3.0), 0.05);
  EXPECT_EQ(first_answers(drive, 0.05, std::chrono::microseconds(0)),
            first_answers(drive, 0.05, std::chrono::milliseconds(10)));
}

TEST(LaserGraph, ACorrectionIsTakenAFixedTimeAfterItsSearchBegan) {
  std::vector<std::size_t> corrected_at;
  for (const double period_s : {0.5, 0.05}) {
    const std::vector<DrivenScan> drive = ring_drive(2, radians(3.0), 0.05);
    LaserGraph graph({}, drive.front().T_map_robot, usual_closer());
    const std::vector<DrawnWall> walls = ring_walls();
    std::size_t scans = 0;
    while (graph.revision() == 0 && scans < drive.size()) {
      const DrivenScan& scan = drive[scans++];
      const std::vector<Point> seen = seen_from(walls, scan.T_map_robot, kBeams, 0.01, scans);
      graph.add(seen, scan.T_odom_robot, period_s * static_cast<double>(scans));
    }
    corrected_at.push_back(scans);
  }
  // With the next scan, and not before the fourth.
  EXPECT_LT(corrected_at[0], corrected_at[1]);
  EXPECT_LE(corrected_at[1], corrected_at[0] + 8);
}

// The fixed time is of the stamps; ones that stand still, or go back, do not keep it for ever.
TEST(LaserGraph, StampsThatStandStillKeepNoAnswerBack) {
  EXPECT_EQ(first_answers(ring_drive(3, radians(3.0), 0.05), 0.0, std::chrono::microseconds(0)).size(),
            ring_drive(3, radians(3.0), 0.05).size());
}

class ThrowingCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget&) override {
    if (!query.submaps.empty()) throw std::runtime_error("no such place");
    return {};
  }
};

TEST(LaserGraph, WhatALoopCloserThrowsInItsThreadComesOutWithAScan) {
  EXPECT_THROW((void)driven(ring_drive(2, 0.0, 0.0), std::make_shared<ThrowingCloser>()), std::runtime_error);
}

// Once: the host still lets the localizer finish then.
class OnceThrowingCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery& query, const Budget&) override {
    if (!query.submaps.empty() && !std::exchange(has_thrown_, true)) throw std::runtime_error("no such place");
    return {};
  }

 private:
  bool has_thrown_ = false;
};

TEST(LaserGraph, AfterAFaultInItsThreadNothingIsLeftToFinish) {
  const std::vector<DrivenScan> drive = ring_drive(2, 0.0, 0.0);
  LaserGraph graph({}, drive.front().T_map_robot, std::make_shared<OnceThrowingCloser>());
  const std::vector<DrawnWall> walls = ring_walls();
  std::uint64_t scans = 0;
  const auto drive_on = [&] {
    for (const DrivenScan& scan : drive) {
      ++scans;
      graph.add(seen_from(walls, scan.T_map_robot, kBeams, 0.01, scans), scan.T_odom_robot,
                kPeriod_s * static_cast<double>(scans));
    }
  };
  EXPECT_THROW(drive_on(), std::runtime_error);
  EXPECT_FALSE(graph.finish_part());
  EXPECT_EQ(graph.poses().size(), scans - 1) << "all but the scan that it came out with";
}

// Searches until nobody waits any more.
class EndlessCloser : public LoopCloser {
 public:
  std::vector<LoopProposal> propose(const LoopQuery&, const Budget& budget) override {
    const auto at_most = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (!budget.exhausted() && std::chrono::steady_clock::now() < at_most)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    was_cancelled = budget.exhausted();
    return {};
  }
  std::atomic<bool> was_cancelled = false;
};

TEST(LaserGraph, ItsEndCancelsTheSearchUnderWay) {
  const auto closer = std::make_shared<EndlessCloser>();
  {
    LaserGraph graph({}, {1.0, 1.0, 0.0}, closer);
    graph.add(seen_from(ring_walls(), {1.0, 1.0, 0.0}, kBeams, 0.01, 1), {}, kPeriod_s);
  }
  EXPECT_TRUE(closer->was_cancelled);
}

TEST(LaserGraph, WithoutACloserNoLoopCloses) {
  LaserGraph graph = driven(ring_drive(2, radians(3.0), 0.05), nullptr);
  while (graph.finish_part()) {
  }
  EXPECT_TRUE(graph.graph().closures().empty());
  EXPECT_EQ(graph.revision(), 0U);
}

TEST(LaserGraph, WithoutEchoesItFollowsOdometry) {
  LaserGraph graph({}, {1.0, 2.0, 0.5}, usual_closer());
  Pose2 T_odom_robot;
  for (int i = 0; i < 30; ++i) {
    graph.add({}, T_odom_robot, kPeriod_s * i);
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
  LaserGraph graph({}, {1.0, 1.0, 0.0}, usual_closer());
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
    graph.add(seen_from(walls, {1.0, 1.0, 0.0}, kBeams, 0.01, seed), {}, kPeriod_s * static_cast<double>(seed));
  EXPECT_EQ(graph.graph().size(), 1U);
  EXPECT_EQ(graph.poses().size(), 50U);
}

}  // namespace
}  // namespace cairn::submap_graph
