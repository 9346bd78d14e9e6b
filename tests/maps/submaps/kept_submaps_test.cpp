#include "maps/submaps/kept_submaps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "maps/submaps/covered_submaps.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::StrEq;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Point> wall(double from_x_m, double to_x_m) {
  std::vector<Point> points_m;
  for (double x_m = from_x_m; x_m < to_x_m; x_m += 0.02) points_m.emplace_back(x_m, 2.04);
  return points_m;
}

// Submaps of three nodes, half a metre apart, each some centimetres beside the last; all see the wall from 0 to 4 m.
KeptSubmaps passes(std::int64_t times) {
  KeptSubmaps submaps;
  for (std::int64_t i = 0; i < times; ++i) {
    const double off_m = 0.02 * static_cast<double>(i % 3);
    for (std::int64_t k = 0; k < 3; ++k)
      submaps.nodes.push_back({10 * i + k, 0.0, {0.5 * static_cast<double>(k), off_m, 0.0}});
    KeptSubmap submap{.anchor = 10 * i, .finished = true, .cell_m = 0.05, .echoes = {}};
    std::vector<Point> seen_m = wall(0.0, 4.0);
    for (Point& point_m : seen_m) point_m.y() -= off_m;
    set_echoes(submap, seen_m);
    submaps.submaps.push_back(std::move(submap));
    for (std::int64_t k = 1; k < 3; ++k) submaps.edges.push_back({10 * i, 10 * i + k, {0.5, 0.0, 0.0}});
    if (i > 0) submaps.edges.push_back({10 * (i - 1), 10 * i, {}, Eigen::Matrix3d::Identity(), true, true});
  }
  return submaps;
}

TEST(DropCovered, ASubmapThatFiveNewerOnesCoverGoesWithItsNodesAndEdges) {
  KeptSubmaps submaps = passes(6);
  drop_covered(submaps, 5.0);
  EXPECT_EQ(submaps.submaps.size(), 5U);
  EXPECT_EQ(submaps.submaps.front().anchor, 10);
  EXPECT_EQ(submaps.nodes.front().number, 10);
  EXPECT_EQ(submaps.nodes.size(), 15U);
  EXPECT_EQ(submaps.edges.size(), 5U * 2U + 4U);
  EXPECT_EQ(fault_of(submaps), "");
}

TEST(DropCovered, FourAreNotEnough) {
  KeptSubmaps submaps = passes(5);
  drop_covered(submaps, 5.0);
  EXPECT_EQ(submaps, passes(5));
}

TEST(DropCovered, OneThatSeesWhatNoNewerOneDoesStays) {
  KeptSubmaps submaps = passes(9);
  set_echoes(submaps.submaps[1], wall(0.0, 5.0));
  drop_covered(submaps, 5.0);
  EXPECT_EQ(submaps.submaps.size(), 6U);
  EXPECT_EQ(submaps.submaps.front().anchor, 10);
}

TEST(DropCovered, NodesThatTwoSubmapsShareStayWithTheOneThatStays) {
  KeptSubmaps submaps = passes(7);
  submaps.nodes[3].number = 3;  // the way went on at once
  submaps.nodes[4].number = 4;
  submaps.nodes[5].number = 5;
  submaps.submaps[1].anchor = 3;
  set_echoes(submaps.submaps[0], wall(0.0, 5.0));
  submaps.edges.clear();
  drop_covered(submaps, 10.0);
  ASSERT_EQ(submaps.submaps.size(), 6U);
  EXPECT_EQ(submaps.submaps[0].anchor, 0);
  EXPECT_EQ(submaps.submaps[1].anchor, 20);
  EXPECT_EQ(submaps.nodes[5].number, 5);
}

TEST(KeptSubmapsCounts, ClosuresAreCountedByWhetherTheyAreBelieved) {
  KeptSubmaps submaps = passes(3);
  EXPECT_EQ(counts_of(submaps), (SubmapCounts{9, 3, 8, 2, 2}));
  submaps.edges.back().is_believed = false;
  EXPECT_EQ(counts_of(submaps).closures_believed, 1U);
  EXPECT_EQ(counts_of({}), SubmapCounts{});
}

TEST(KeptSubmapsNodes, FollowTheAnchorAsFarAsASubmapIsLong) {
  KeptSubmaps submaps;
  for (std::int64_t i = 0; i < 8; ++i)
    submaps.nodes.push_back({i < 6 ? i : i + 10, 0.0, {static_cast<double>(i), 0.0, 0.0}});
  submaps.submaps = {KeptSubmap{.anchor = 1, .echoes = {}}, KeptSubmap{.anchor = 4, .echoes = {}}};
  EXPECT_EQ(nodes_of(submaps, submaps.submaps[0], 2.5).size(), 4U) << "with the one that makes it so long";
  EXPECT_EQ(nodes_of(submaps, submaps.submaps[0], 2.5).front().number, 1);
  EXPECT_EQ(nodes_of(submaps, submaps.submaps[1], 2.5).size(), 2U) << "what follows is missing";
}

TEST(KeptSubmapsEchoes, AreTheMiddlesOfTheirCells) {
  KeptSubmap submap;
  set_echoes(submap, std::vector<Point>{{0.03, -0.01}, {0.04, -0.02}, {0.06, -0.03}, {-0.25, 0.31}});
  const std::vector<Point> once = echoes_of(submap, 1);
  ASSERT_EQ(once.size(), 2U);
  EXPECT_LT((once[0] - Point(0.05, -0.05)).norm(), 1e-12);
  EXPECT_LT((once[1] - Point(-0.25, 0.35)).norm(), 1e-12);
  EXPECT_EQ(echoes_of(submap, 2).size(), 3U);
}

TEST(KeptSubmapsFault, SaysWhyARunCannotGoOnWithThem) {
  const KeptSubmaps sound = passes(2);
  EXPECT_EQ(fault_of(sound), "");
  const auto after = [&](auto&& change) {
    KeptSubmaps submaps = sound;
    change(submaps);
    return fault_of(submaps);
  };
  EXPECT_THAT(after([](KeptSubmaps& s) { s.nodes[1].T_map_node.x_m = 1e18; }),
              StrEq("node 1 is at (1e+18, 0) m, 0 rad; finite ones up to 1e+06 m are allowed"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.nodes[1].number = 0; }), StrEq("node 0 follows node 0: numbers must rise"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.nodes.back().number = KeptSubmaps::kMaxNumber; }),
              StrEq("the number of node 1000000000 is none of 0 to 500000000, which leave numbers for more"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.nodes[1].stamp_s = kInfinity; }),
              StrEq("node 1 has the time inf, which is not finite"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.submaps[0].width = 3; }), StrEq("submap 0 says 3 x 1 cells and holds 80"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.submaps[0].width = -1; }),
              StrEq("submap 0 says -1 x 1 cells; 0 x 0 to 2048 x 2048 are allowed"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.submaps[0].cell_m = 0.0; }),
              StrEq("submap 0 has cells of 0 m; more than 0 and at most 10 m are allowed"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.submaps[0].min_y = 5000; }),
              StrEq("submap 0 begins at cell (0, 5000); -2048 to 2048 are allowed"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.submaps[1].anchor = 7; }),
              StrEq("submap 7 has no anchor: there is no node 7"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.edges[0].to = 7; }),
              StrEq("the edge from 0 to 7 lacks an end: there is no node 7"));
  EXPECT_THAT(after([](KeptSubmaps& s) { s.edges[0].information(0, 1) = kInfinity; }),
              StrEq("the edge from 0 to 1 has a relation or an information that is not finite"));
}

}  // namespace
}  // namespace cairn
