#include "framework/behaviour_tree/state.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/behaviour_tree/scripted_leaves.hpp"

namespace cairn {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing_tree::letter_of;
using testing_tree::ScriptedLeaves;
using testing_tree::steps_of;

std::string refusal_of(const std::string& text) {
  try {
    (void)tree_state_of(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

TEST(TreeState, ReportsWhatIsWrongWithAText) {
  const std::string rest = "\"next\":0,\"rounds\":0,\"begun_s\":0,\"failures\":\"\",\"outcomes\":[]}]}";
  const auto node = [](const std::string& members) { return "{\"running\":[{" + members + "}]}"; };
  EXPECT_EQ(refusal_of("{\"running\":[{\"path\":\"1\"," + rest), "taken");
  EXPECT_THAT(refusal_of("{"), HasSubstr("it is not JSON"));
  EXPECT_EQ(refusal_of("[]"), "it holds no list \"running\"");
  EXPECT_EQ(refusal_of("{\"running\":[3]}"), "a node is not an object");
  EXPECT_EQ(refusal_of(node("")), "a node has no \"path\"");
  EXPECT_EQ(refusal_of(node("\"path\":7")), "\"path\" of a node is not text");
  EXPECT_EQ(refusal_of(node("\"path\":\"1\",\"next\":-1")), "\"next\" of a node is not a count");
  EXPECT_EQ(refusal_of(node("\"path\":\"1\",\"next\":1e300")), "\"next\" of a node is not a count");
  EXPECT_EQ(refusal_of(node("\"path\":\"1\",\"next\":0,\"rounds\":0,\"begun_s\":\"x\"")),
            "\"begun_s\" of a node is not a number");
  EXPECT_EQ(refusal_of(std::string(100000, '[')), "it is nested too deeply");
  EXPECT_EQ(refusal_of(std::string(17U << 20U, ' ')), "it is too long");
}

std::string misfit_of(const std::string& yaml, const TreeState& state) {
  const std::vector<TreeNode> steps = steps_of(yaml);
  ScriptedLeaves leaves({});
  TreeRunner runner(steps.front(), leaves);
  try {
    runner.restore(state, 10.0);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "taken";
}

TEST(TreeState, IsTakenByTheTreeThatItIsOfOnly) {
  const std::string tree = "[repeat: {times: 3, do: [a, {fallback: [b, c]}, {parallel: [d, e]}]}]";
  const auto state = [](std::vector<NodeState> nodes) { return TreeState{std::move(nodes)}; };
  EXPECT_EQ(misfit_of(tree, state({{"1", 0, 2, 4.0}, {"1/1", 1}, {"1/1/2", 1}})), "taken");
  EXPECT_THAT(misfit_of(tree, state({{"2"}})), HasSubstr("is not in this step"));
  EXPECT_THAT(misfit_of(tree, state({{"1/1/1"}})), HasSubstr("is not a node that remembers"));
  EXPECT_THAT(misfit_of(tree, state({{"1"}, {"1"}})), HasSubstr("is there twice"));
  EXPECT_THAT(misfit_of(tree, state({{"1/1"}})), HasSubstr("the node above it is not"));
  EXPECT_THAT(misfit_of(tree, state({{"1"}, {"1/1", 0}, {"1/1/2"}})), HasSubstr("it is not its turn"));
  EXPECT_THAT(misfit_of(tree, state({{"1"}, {"1/1", 3}})), HasSubstr("has no such child"));
  EXPECT_THAT(misfit_of(tree, state({{"1", 0, 3}})), HasSubstr("cannot have done such rounds"));
  EXPECT_THAT(misfit_of(tree, state({{"1", 0, 0, 11.0}})), HasSubstr("at a time that has not come"));
  EXPECT_THAT(misfit_of(tree, state({{"1"}, {"1/1", 2}, {"1/1/3", 0, 0, 0.0, "", {Status{}}}})),
              HasSubstr("has outcomes of other children"));
}

TEST(TreeState, GoesOnInTheRoundThatWasUnderWay) {
  const std::vector<TreeNode> steps = steps_of("[repeat: {times: 3, do: [a, {timeout: {after_s: 5, do: b}}]}]");
  ScriptedLeaves before({{"a", "S"}, {"b", "SRRRRRRRR"}});
  TreeRunner killed(steps.front(), before);
  for (int i = 0; i < 4; ++i) (void)killed.tick(i);  // round 2: b runs since 1 s
  ScriptedLeaves after({{"a", "S"}, {"b", "R"}});
  TreeRunner restored(steps.front(), after);
  restored.restore(killed.state(), 3.0);
  EXPECT_EQ(letter_of(restored.tick(4.0).state), 'R');
  EXPECT_EQ(after.log, "b");
  const Status timed_out = restored.tick(6.0);
  EXPECT_EQ(timed_out.state, StepState::failure);
  EXPECT_THAT(timed_out.reason, HasSubstr("(round 2 of 3)"));
}

// Leaves that say how long they still take.
class TimedLeaves : public ScriptedLeaves {
 public:
  using ScriptedLeaves::ScriptedLeaves;
  LeafTick tick_leaf(const TreeNode& leaf) override {
    LeafTick tick = ScriptedLeaves::tick_leaf(leaf);
    if (leaf.name == "b") tick.status.left_s = 7.0;
    return tick;
  }
};

TEST(TimeLeft, AddsWhatLeavesReportAndWhatRoundsHaveTaken) {
  const std::vector<TreeNode> steps = steps_of("[{repeat: {times: 4, do: [a, b]}}]");
  TimedLeaves leaves({{"a", "RS"}, {"b", "RRSR"}});
  TreeRunner runner(steps.front(), leaves);
  NodeTimes times;
  TimeLeft left = runner.time_left(0.0, times);
  EXPECT_THAT(left.without, ElementsAre("a", "b"));
  EXPECT_EQ(text_of(left), "time left unknown");
  for (int i = 0; i < 2; ++i) (void)runner.tick(i);  // b runs: 7 s left of a round that has lasted 1 s
  left = runner.time_left(1.0, times);
  EXPECT_TRUE(left.without.empty());
  EXPECT_DOUBLE_EQ(left.about_s, 7.0 + 3 * (1.0 + 7.0));
  EXPECT_EQ(text_of(left), "about 31 s left");
  for (int i = 2; i < 4; ++i) (void)runner.tick(i);  // the first round took 3 s
  times.add("b", 2.0);
  left = runner.time_left(3.0, times);
  EXPECT_DOUBLE_EQ(left.about_s, 3 * 3.0);
}

TEST(TimeLeft, IsCutByTimeoutsAndSaysWhatItLeavesOut) {
  const std::vector<TreeNode> steps = steps_of("[{timeout: {after_s: 60, do: [{sequence: [b, c]}]}}]");
  TimedLeaves leaves({{"b", "R"}, {"c", "R"}});
  TreeRunner runner(steps.front(), leaves);
  (void)runner.tick(0.0);
  (void)runner.tick(58.0);
  const TimeLeft left = runner.time_left(58.0, {});
  EXPECT_DOUBLE_EQ(left.max_s, 2.0);
  EXPECT_DOUBLE_EQ(left.about_s, 2.0);
  EXPECT_THAT(left.without, ElementsAre("c"));
  EXPECT_EQ(text_of(left), "about 2 s left; c not counted");
}

}  // namespace
}  // namespace cairn
