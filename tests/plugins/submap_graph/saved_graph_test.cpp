// A graph that goes on from what earlier runs have saved.
#include "plugins/submap_graph/saved_graph.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/submap_graph/driven_ring.hpp"
#include "tests/plugins/submap_graph/usual_closer.hpp"

namespace cairn::submap_graph {
namespace {

constexpr int kScanBeams = 120;
const Pose2 kPushed{0.3, -0.2, radians(3.0)};  // where a robot is believed to be, seen from where it is

// What a run leaves that goes on from what was saved, and where it has put the robot.
struct Continued {
  KeptSubmaps saved;
  std::vector<Pose2> poses;
  std::size_t closures_with_earlier = 0;
};
Continued go_on(const KeptSubmaps& earlier, const Pose2& T_map_start, const std::vector<DrivenScan>& drive,
                std::uint64_t seed) {
  const Config config;
  LaserGraph graph(config, T_map_start, usual_closer(), {}, earlier_part_of(earlier, config, {}));
  const std::vector<DrawnWall> walls = ring_walls();
  double stamp_s = 0.0;
  for (const DrivenScan& scan : drive)
    graph.add(seen_from(walls, scan.T_map_robot, kScanBeams, 0.01, ++seed), scan.T_odom_robot, stamp_s += 0.5);
  while (graph.finish_part()) {
  }
  const std::vector<double> stamps_s(graph.nodes(), 1.0);
  Continued run{saved_graph(earlier, graph, stamps_s, config), graph.poses()};
  for (std::size_t i = 0; i < graph.graph().closures().size(); ++i)
    if (graph.graph().closures()[i].anchor < earlier.nodes.size() && graph.graph().is_believed()[i])
      ++run.closures_with_earlier;
  return run;
}

const std::vector<DrivenScan>& first_drive() {
  static const std::vector<DrivenScan> drive = ring_drive(2, radians(3.0), 0.05);
  return drive;
}
const KeptSubmaps& first_saved() {
  static const KeptSubmaps saved = go_on({}, first_drive().front().T_map_robot, first_drive(), 0).saved;
  return saved;
}

double worst_error_m(const Continued& run, const std::vector<DrivenScan>& drive) {
  double worst_m = 0.0;
  for (std::size_t i = 0; i < drive.size(); ++i)
    worst_m = std::max(worst_m, (run.poses[i].position() - drive[i].T_map_robot.position()).norm());
  return worst_m;
}

std::vector<DrivenScan> half_a_round() {
  std::vector<DrivenScan> drive = ring_drive(1, radians(3.0), 0.05);
  drive.resize(drive.size() / 2);
  return drive;
}

TEST(SavedGraph, ARunThatGoesOnClosesLoopsWithTheSubmapsOfEarlierOnes) {
  const std::vector<DrivenScan> drive = half_a_round();
  const Pose2 T_map_believed = drive.front().T_map_robot * kPushed;
  const Continued alone = go_on({}, T_map_believed, drive, 5000);
  EXPECT_GT(worst_error_m(alone, drive), 0.3) << "nothing corrects the start";
  const Continued second = go_on(first_saved(), T_map_believed, drive, 5000);
  EXPECT_GT(second.closures_with_earlier, 10U);
  EXPECT_LT(worst_error_m(second, drive), 0.1);
}

TEST(SavedGraph, EarlierNodesStayWhereTheyWereAndTheNewOnesAreTiedToThem) {
  const std::vector<DrivenScan> drive = half_a_round();
  const KeptSubmaps& first = first_saved();
  const Continued second = go_on(first, drive.front().T_map_robot * kPushed, drive, 5000);
  ASSERT_EQ(fault_of(second.saved), "");
  const std::int64_t last_earlier = first.nodes.back().number;
  EXPECT_GT(second.saved.nodes.back().number, last_earlier + 20);
  EXPECT_FALSE(std::ranges::binary_search(second.saved.nodes, last_earlier + 1, {}, &KeptNode::number))
      << "a gap: no submap holds nodes of two runs";
  EXPECT_TRUE(std::ranges::binary_search(second.saved.nodes, last_earlier + 2, {}, &KeptNode::number));
  std::size_t kept = 0;
  for (const KeptNode& node : second.saved.nodes) {
    const auto before = std::ranges::find(first.nodes, node.number, &KeptNode::number);
    if (before == first.nodes.end()) continue;
    ++kept;
    EXPECT_EQ(node, *before);
  }
  EXPECT_GT(kept, first.nodes.size() / 2);
  std::size_t ties = 0;
  std::size_t closures = 0;
  for (const KeptEdge& edge : second.saved.edges)
    if (edge.from <= last_earlier && edge.to > last_earlier) ++(edge.is_closure ? closures : ties);
  EXPECT_LE(ties, 1U) << "the start pose, unless the submap of its anchor is covered by now";
  EXPECT_GT(closures, 10U);
}

TEST(SavedGraph, ARobotThatHasStoodAddsNothing) {
  const std::vector<DrivenScan> stands(1200, {first_drive().front().T_map_robot, {}});
  EXPECT_EQ(go_on(first_saved(), stands.front().T_map_robot, stands, 5000).saved, first_saved());
}

TEST(SavedGraph, ARobotThatDrivesWhereItHasBeenAddsNothingInTheEnd) {
  KeptSubmaps saved = first_saved();
  std::vector<std::size_t> submaps;
  const std::vector<DrivenScan> drive = half_a_round();
  for (std::uint64_t time = 1; time <= 6; ++time) {
    Continued next = go_on(saved, drive.front().T_map_robot, drive, 5000 * time);
    EXPECT_LT(worst_error_m(next, drive), 0.1) << time;
    saved = std::move(next.saved);
    submaps.push_back(saved.submaps.size());
  }
  EXPECT_LE(submaps[5], submaps[3] + 2);
  EXPECT_LE(saved.nodes.size(), 8 * submaps[5]);
}

// Of the second scan.
double variance_m2(const KeptSubmaps& earlier, const StartUncertainty& start) {
  const Config config;
  LaserGraph graph(config, {1.0, 1.0, 0.0}, nullptr, {}, earlier_part_of(earlier, config, start));
  const std::vector<DrawnWall> walls = ring_walls();
  for (std::uint64_t scan = 1; scan <= 2; ++scan)
    graph.add(seen_from(walls, {1.0, 1.0, 0.0}, kScanBeams, 0.01, scan), {}, 0.5 * static_cast<double>(scan));
  return graph.covariance()(0, 0);
}

TEST(SavedGraph, ThePoseIsNoSurerThanTheStartOfTheRunInTheMapBeforeALoopCloses) {
  const StartUncertainty start{0.5, radians(5.0)};
  EXPECT_NEAR(variance_m2(first_saved(), start), variance_m2(first_saved(), {}) + 0.25, 1e-9);
  EXPECT_DOUBLE_EQ(variance_m2({}, start), variance_m2({}, {})) << "it begins the map";
}

TEST(SavedGraph, SonarsGoOnFromEarlierSubmapsToo) {
  Config config;
  config.gather_m = 5.0;
  LaserGraph graph(config, {1.0, 1.0, 0.0}, usual_closer(), {}, earlier_part_of(first_saved(), config, {}));
  graph.add({}, {}, 0.0);
  graph.add({}, {0.6, 0.0, 0.0}, 1.0);
  while (graph.finish_part()) {
  }
  ASSERT_EQ(graph.graph().size(), graph.graph().held() + 2);
  ASSERT_EQ(graph.graph().ties().size(), 2U);
  EXPECT_LT(graph.graph().ties()[0].from, graph.graph().held());
  EXPECT_EQ(graph.graph().ties()[1].from, graph.graph().held()) << "odometry, from the run's first node";
}

TEST(StartTie, IsAsSureAsTheStartPoseIsSaidToBe) {
  EarlierPart earlier;
  earlier.T_map_node = {{5.0, 5.0, 1.0}, {1.0, 0.5, 0.0}};
  earlier.start = {0.5, radians(10.0)};
  const LocalMap::Tie tie = start_tie(earlier, {1.2, 0.5, 0.0});
  EXPECT_EQ(tie.anchor, 1U);
  EXPECT_NEAR(tie.T_anchor_node.x_m, 0.2, 1e-12);
  EXPECT_NEAR(tie.information(0, 0), 4.0, 1e-9);
  earlier.start = {};
  EXPECT_NEAR(start_tie(earlier, {1.2, 0.5, 0.0}).information(0, 0), 100.0, 1e-9) << "never surer than 0.1 m";
}

}  // namespace
}  // namespace cairn::submap_graph
