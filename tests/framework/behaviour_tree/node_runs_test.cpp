#include "framework/behaviour_tree/node_runs.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

NodeReport report_of(double end_s, StepState state) {
  NodeReport report;
  report.end_s = end_s;
  report.status.state = state;
  return report;
}

TEST(NodeRuns, KeepEachRunAndJoinAnswersGivenAtOnceAgainAndAgain) {
  TreeNode node;
  node.path = "1/1";
  NodeRuns runs;
  for (int i = 0; i < 5; ++i) runs.add(node, report_of(0.04 * i, StepState::failure), 0.04 * i);
  runs.add(node, report_of(0.2, StepState::success), 0.2);
  runs.add(node, report_of(3.0, StepState::success), 1.0);
  ASSERT_EQ(runs.runs().size(), 3U);
  EXPECT_EQ(runs.runs()[0].runs, 5);
  EXPECT_DOUBLE_EQ(runs.runs()[0].end_s, 0.16);
  EXPECT_EQ(runs.runs()[1].end, RunEnd::success);
  EXPECT_DOUBLE_EQ(runs.runs()[2].begin_s, 1.0);
}

TEST(NodeRuns, AreNoMoreThanTheirMostAndSayHowManyAreLeftOut) {
  TreeNode node;
  node.path = "1";
  NodeRuns runs;
  for (std::size_t i = 0; i < kMaxNodeRuns + 7; ++i) {
    const double begun_s = 2.0 * static_cast<double>(i);
    runs.add(node, report_of(begun_s + 1.0, StepState::success), begun_s);
  }
  EXPECT_EQ(runs.runs().size(), kMaxNodeRuns);
  EXPECT_EQ(runs.left_out(), 7);
}

}  // namespace
}  // namespace cairn
