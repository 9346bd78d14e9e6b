#include "framework/behaviour_tree/runner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/framework/behaviour_tree/scripted_leaves.hpp"

namespace cairn {
namespace {

using testing::HasSubstr;
using testing_tree::letter_of;
using testing_tree::ScriptedLeaves;
using testing_tree::steps_of;

constexpr double kTick_s = 1.0;

struct Case {
  std::string what;
  std::string yaml;  // one step
  std::map<std::string, std::string> scripts;
  int ticks = 1;
  std::string outcomes;  // of the root, a letter a tick
  std::string log;       // of the leaves, ticks apart
};

struct Ran {
  std::string outcomes;
  std::string log;
};

Ran run(const TreeNode& root, ScriptedLeaves& leaves, int ticks) {
  TreeRunner runner(root, leaves);
  Ran ran;
  for (int i = 0; i < ticks; ++i) {
    if (i > 0) leaves.log += " | ";
    ran.outcomes += letter_of(runner.tick(i * kTick_s).state);
  }
  ran.log = leaves.log;
  return ran;
}

void expect(const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    const std::vector<TreeNode> steps = steps_of(c.yaml);
    ScriptedLeaves leaves(c.scripts);
    const Ran ran = run(steps.front(), leaves, c.ticks);
    EXPECT_EQ(ran.outcomes, c.outcomes) << c.what;
    EXPECT_EQ(ran.log, c.log) << c.what;
  }
}

TEST(TreeRunner, ASequenceGoesOnWhereItWas) {
  const std::string tree = "[sequence: [a, b, c]]";
  expect({{"all at once", tree, {{"a", "S"}, {"b", "S"}, {"c", "S"}}, 1, "S", "a b c"},
          {"memory", tree, {{"a", "S"}, {"b", "RRS"}, {"c", "RS"}}, 4, "RRRS", "a b | b | b c | c"},
          {"the first failure ends it", tree, {{"a", "S"}, {"b", "RF"}, {"c", "S"}}, 2, "RF", "a b | b"},
          {"afresh after its end", tree, {{"a", "S"}, {"b", "FS"}, {"c", "S"}}, 2, "FS", "a b | a b c"}});
}

TEST(TreeRunner, LeavesUnderWayBeginAfreshAndTheNodesAboveThemGoOn) {
  const std::vector<TreeNode> steps = steps_of("[sequence: [a, b, c]]");
  ScriptedLeaves leaves({{"a", "S"}, {"b", "RRS"}, {"c", "S"}});
  TreeRunner runner(steps.front(), leaves);
  EXPECT_EQ(runner.tick(0.0).state, StepState::running);
  runner.begin_leaves_afresh();
  EXPECT_TRUE(runner.is_running());
  EXPECT_FALSE(runner.wanted());
  leaves.log += " |";
  EXPECT_EQ(runner.tick(1.0).state, StepState::running);
  EXPECT_EQ(leaves.log, "a b !b | b") << "a is not ticked again";
}

TEST(TreeRunner, AFallbackGoesOnWhereItWas) {
  const std::string tree = "[fallback: [a, b, c]]";
  expect({{"the first success ends it", tree, {{"a", "S"}, {"b", "S"}, {"c", "S"}}, 1, "S", "a"},
          {"memory", tree, {{"a", "F"}, {"b", "RRF"}, {"c", "RS"}}, 4, "RRRS", "a b | b | b c | c"},
          {"all fail", tree, {{"a", "F"}, {"b", "F"}, {"c", "F"}}, 1, "F", "a b c"},
          {"afresh after its end", tree, {{"a", "F"}, {"b", "SF"}, {"c", "S"}}, 2, "SS", "a b | a b c"}});
}

TEST(TreeRunner, AReactiveSequenceBeginsWithItsFirstChildInEveryTick) {
  const std::string tree = "[reactive_sequence: [a, b, c]]";
  expect({{"first again", tree, {{"a", "S"}, {"b", "S"}, {"c", "RRS"}}, 3, "RRS", "a b c | a b c | a b c"},
          {"an earlier failure halts", tree, {{"a", "SSF"}, {"b", "S"}, {"c", "R"}}, 3, "RRF", "a b c | a b c | a !c"},
          {"an earlier one that runs halts, too",
           tree,
           {{"a", "SRS"}, {"b", "S"}, {"c", "R"}},
           3,
           "RRR",
           "a b c | a !c | a b c"}});
}

TEST(TreeRunner, AReactiveFallbackBeginsWithItsFirstChildInEveryTick) {
  const std::string tree = "[reactive_fallback: [a, b, c]]";
  expect({{"an earlier success halts", tree, {{"a", "FFS"}, {"b", "F"}, {"c", "R"}}, 3, "RRS", "a b c | a b c | a !c"},
          {"an earlier one that runs halts, too",
           tree,
           {{"a", "FRF"}, {"b", "F"}, {"c", "RS"}},
           3,
           "RRS",
           "a b c | a !c | a b c"},
          {"all fail", tree, {{"a", "F"}, {"b", "F"}, {"c", "RF"}}, 2, "RF", "a b c | a b c"}});
}

TEST(TreeRunner, AParallelTicksAllThatRunAndHaltsTheRestInReverseOrder) {
  expect({{"all must succeed", "[parallel: [a, b]]", {{"a", "S"}, {"b", "RRS"}}, 3, "RRS", "a b | b | b"},
          {"any failure fails",
           "[parallel: [a, b, c]]",
           {{"a", "R"}, {"b", "RF"}, {"c", "R"}},
           2,
           "RF",
           "a b c | a b c !c !a"},
          {"any success",
           "[parallel: {succeed_when: any, fail_when: all, do: [a, b, c]}]",
           {{"a", "F"}, {"b", "RS"}, {"c", "R"}},
           2,
           "RS",
           "a b c | b c !c"},
          {"all failed",
           "[parallel: {succeed_when: any, fail_when: all, do: [a, b]}]",
           {{"a", "F"}, {"b", "RF"}},
           2,
           "RF",
           "a b | b"},
          {"two of three",
           "[parallel: {succeed_when: 2, fail_when: all, do: [a, b, c]}]",
           {{"a", "S"}, {"b", "R"}, {"c", "RS"}},
           2,
           "RS",
           "a b c | b c !b"},
          {"failed as soon as it cannot succeed",
           "[parallel: {succeed_when: 2, fail_when: all, do: [a, b, c]}]",
           {{"a", "F"}, {"b", "R"}, {"c", "RF"}},
           2,
           "RF",
           "a b c | b c !b"},
          {"failure comes first",
           "[parallel: {succeed_when: any, fail_when: any, do: [a, b]}]",
           {{"a", "S"}, {"b", "F"}},
           1,
           "F",
           "a b"},
          {"afresh after its end", "[parallel: [a, b]]", {{"a", "S"}, {"b", "FS"}}, 2, "FS", "a b | a b"}});
}

TEST(TreeRunner, RepeatAndRetryBeginTheNextRoundWithTheNextTick) {
  expect({{"repeat", "[repeat: {times: 3, do: a}]", {{"a", "SRS"}}, 4, "RRRS", "a | a | a | a"},
          {"repeat ends with a failure", "[repeat: {times: 3, do: a}]", {{"a", "SF"}}, 2, "RF", "a | a"},
          {"repeat forever", "[repeat: {times: forever, do: a}]", {{"a", "SSSSF"}}, 5, "RRRRF", "a | a | a | a | a"},
          {"retry", "[retry: {times: 3, do: a}]", {{"a", "FRS"}}, 3, "RRS", "a | a | a"},
          {"retry gives up", "[retry: {times: 2, do: a}]", {{"a", "F"}}, 2, "RF", "a | a"},
          {"retry forever", "[retry: {times: forever, do: a}]", {{"a", "FFFS"}}, 4, "RRRS", "a | a | a | a"},
          {"rounds are counted afresh", "[retry: {times: 2, do: a}]", {{"a", "FFF"}}, 4, "RFRF", "a | a | a | a"}});
}

TEST(TreeRunner, TimeoutHaltsItsChildWhenTheTimeIsUp) {
  const std::string tree = "[timeout: {after_s: 2, do: a}]";
  expect({{"in time", tree, {{"a", "RS"}}, 2, "RS", "a | a"},
          {"too late", tree, {{"a", "R"}}, 3, "RRF", "a | a | !a"},
          {"the time begins anew", tree, {{"a", "R"}}, 6, "RRFRRF", "a | a | !a | a | a | !a"}});
}

TEST(TreeRunner, NotAndForceSuccessChangeWhatTheirChildEndsWith) {
  expect({{"not", "[not: a]", {{"a", "RSF"}}, 3, "RFS", "a | a | a"},
          {"force_success", "[force_success: a]", {{"a", "RSF"}}, 3, "RSS", "a | a | a"},
          {"a list is a sequence", "[not: [a, b]]", {{"a", "S"}, {"b", "F"}}, 1, "S", "a b"}});
}

TEST(TreeRunner, AForgivenFailureIsReportedAndTheTreeGoesOn) {
  expect({{"in a sequence", "[sequence: [a, b]]", {{"a", "X"}, {"b", "S"}}, 1, "S", "a b"},
          {"as the root", "[a]", {{"a", "X"}}, 1, "F", "a"}});
}

// Every leaf that runs is halted once, the last first, wherever in the tree it is.
TEST(TreeRunner, HaltGoesThroughTheTreeInReverseOrder) {
  const auto steps = steps_of(
      "[parallel: [{sequence: [a, b]}, {retry: {times: 2, do: {fallback: [c, d]}}}, {not: {timeout: "
      "{after_s: 9, do: e}}}, f]]");
  ScriptedLeaves leaves({{"a", "S"}, {"b", "R"}, {"c", "F"}, {"d", "R"}, {"e", "R"}, {"f", "S"}});
  TreeRunner runner(steps.front(), leaves);
  EXPECT_EQ(runner.tick(0.0).state, StepState::running);
  EXPECT_EQ(leaves.log, "a b c d e f");
  leaves.log.clear();
  runner.halt(1.0, "enough");
  EXPECT_EQ(leaves.log, "!e !d !b");
  runner.halt(2.0, "enough");
  EXPECT_EQ(leaves.log, "!e !d !b") << "once";
  EXPECT_FALSE(runner.is_running());
  leaves.log.clear();
  EXPECT_EQ(runner.tick(3.0).state, StepState::running);
  EXPECT_EQ(leaves.log, "a b c d e f") << "afresh";
}

TEST(TreeRunner, AHaltThatThrowsLeavesTheOthersToBeHalted) {
  const auto steps = steps_of("[sequence: [{parallel: [a, {parallel: [b, c]}]}]]");
  ScriptedLeaves leaves({{"a", "R"}, {"b", "R"}, {"c", "R"}});
  leaves.throws_in_halt = "c";
  TreeRunner runner(steps.front(), leaves);
  (void)runner.tick(0.0);
  leaves.log.clear();
  EXPECT_THROW(runner.halt(1.0, "enough"), std::runtime_error);
  ASSERT_TRUE(runner.is_running());
  runner.halt(1.0, "enough");
  EXPECT_EQ(leaves.log, "!c !b !a");
}

TEST(TreeRunner, TheVelocityIsThatOfTheLeafThatGoesOn) {
  const auto wanted = [](const std::string& yaml, std::map<std::string, std::string> scripts) {
    const auto steps = steps_of(yaml);
    ScriptedLeaves leaves(std::move(scripts));
    TreeRunner runner(steps.front(), leaves);
    (void)runner.tick(0.0);
    return runner.wanted() ? runner.wanted()->v_mps : 0.0;
  };
  EXPECT_EQ(wanted("[a]", {{"a", "r"}}), 'a');
  EXPECT_EQ(wanted("[a]", {{"a", "R"}}), 0.0);
  EXPECT_EQ(wanted("[a]", {{"a", "s"}}), 0.0) << "a leaf that has ended orders nothing";
  EXPECT_EQ(wanted("[sequence: [a, b]]", {{"a", "s"}, {"b", "R"}}), 0.0);
  EXPECT_EQ(wanted("[sequence: [a, b]]", {{"a", "s"}, {"b", "r"}}), 'b');
  EXPECT_EQ(wanted("[parallel: [a, b]]", {{"a", "r"}, {"b", "R"}}), 'a');
  EXPECT_EQ(wanted("[parallel: [a, b]]", {{"a", "r"}, {"b", "s"}}), 'a');
  EXPECT_EQ(wanted("[parallel: [a, b]]", {{"a", "r"}, {"b", "F"}}), 0.0) << "it was halted in this tick";
}

TEST(TreeRunner, TwoChildrenOfAParallelThatBothDriveAreAFailureThatNamesThem) {
  const auto steps = steps_of("[fallback: [{parallel: [{sequence: [a, b]}, c, d]}, e]]");
  ScriptedLeaves leaves({{"a", "S"}, {"b", "r"}, {"c", "Rr"}, {"d", "R"}, {"e", "r"}});
  TreeRunner runner(steps.front(), leaves);
  EXPECT_EQ(runner.tick(0.0).state, StepState::running);
  leaves.log.clear();
  EXPECT_EQ(runner.tick(1.0).state, StepState::running) << "the fallback goes on with e";
  EXPECT_EQ(leaves.log, "b c !d !c !b e");
  EXPECT_EQ(runner.wanted()->v_mps, 'e');
  EXPECT_EQ(runner.reports().at(1).status.reason, "b (1/1/1/2) and c (1/1/2) drive at the same time");
}

TEST(TreeRunner, AReasonSaysWhichChildFailed) {
  const auto reason = [](const std::string& yaml, int ticks) {
    const auto steps = steps_of(yaml);
    ScriptedLeaves leaves({{"a", "F"}, {"b", "F"}, {"r", "R"}, {"s", "S"}});
    TreeRunner runner(steps.front(), leaves);
    Status status;
    for (int i = 0; i < ticks; ++i) status = runner.tick(i * kTick_s);
    EXPECT_EQ(status.state, StepState::failure);
    return status.reason;
  };
  EXPECT_EQ(reason("[sequence: [s, a]]", 1), "a: no a");
  EXPECT_EQ(reason("[fallback: [a, b]]", 1), "a: no a; b: no b");
  EXPECT_EQ(reason("[reactive_fallback: [a, b]]", 1), "a: no a; b: no b");
  EXPECT_EQ(reason("[parallel: [r, b]]", 1), "b: no b");
  EXPECT_EQ(reason("[retry: {times: 3, do: {name: try it, sequence: [a]}}]", 3), "try it: a: no a (attempt 3 of 3)");
  EXPECT_EQ(reason("[repeat: {times: forever, do: a}]", 1), "a: no a (round 1)");
  EXPECT_EQ(reason("[timeout: {after_s: 1.5, do: r}]", 3), "r has not ended within 1.5 s");
}

// A condition below a reactive node is asked in every tick; its answer is published when it changes.
TEST(TreeRunner, NodesThatBeginAndEndInOneTickAreReportedWhenTheirOutcomeChanges) {
  const auto steps = steps_of("[reactive_sequence: [{not: {landmark_known: x}}, {timeout: {after_s: 99, do: a}}]]");
  class Leaves : public ScriptedLeaves {
   public:
    using ScriptedLeaves::ScriptedLeaves;
    LeafTick tick_leaf(const TreeNode& leaf) override {
      if (leaf.kind != NodeKind::landmark_known) return ScriptedLeaves::tick_leaf(leaf);
      return {{++asked_ < 4 ? StepState::failure : StepState::success, ""}};
    }

   private:
    int asked_ = 0;
  } leaves(std::map<std::string, std::string>{{"a", "R"}});
  TreeRunner runner(steps.front(), leaves);
  for (int i = 0; i < 4; ++i) (void)runner.tick(i * kTick_s);
  EXPECT_EQ(leaves.reported, "+1/1 +1/1/1 F1/1/1 S1/1 +1/2 +1/2/1 +1/1 +1/1/1 S1/1/1 F1/1 H1/2/1 H1/2 ");
}

TEST(TreeRunner, ReportsHoldWhatHasComeOfEachNodeThatWasTicked) {
  const auto steps = steps_of("[fallback: [{retry: {times: 2, do: a}}, b, c]]");
  ScriptedLeaves leaves({{"a", "RF"}, {"b", "R"}, {"c", "S"}});
  TreeRunner runner(steps.front(), leaves);
  for (int i = 0; i < 4; ++i) (void)runner.tick(i * kTick_s);
  runner.halt(9.0, "enough");
  const std::vector<NodeReport> reports = runner.reports();
  ASSERT_EQ(reports.size(), 4U) << "c was never ticked";
  EXPECT_EQ(reports[0].path, "1");
  EXPECT_TRUE(reports[0].is_halted);
  EXPECT_EQ(reports[2].path, "1/1/1");
  EXPECT_EQ(reports[2].kind, "a");
  EXPECT_EQ(reports[2].ticks, 3);
  EXPECT_EQ(reports[2].runs, 2);
  EXPECT_EQ(reports[2].begin_s, 0.0);
  EXPECT_EQ(reports[2].end_s, 2.0);
  EXPECT_EQ(reports[2].status, (Status{StepState::failure, "no a"}));
  EXPECT_EQ(reports[3].path, "1/2");
  EXPECT_EQ(reports[3].status, (Status{StepState::failure, "enough"}));
  EXPECT_EQ(reports[3].begin_s, 2.0);
  EXPECT_EQ(reports[3].end_s, 9.0);
}

TEST(TreeRunner, WhatIsAbandonedIsNotHalted) {
  const auto steps = steps_of("[sequence: [a]]");
  ScriptedLeaves leaves(std::map<std::string, std::string>{{"a", "R"}});
  TreeRunner runner(steps.front(), leaves);
  (void)runner.tick(0.0);
  runner.abandon(1.0, "given up");
  EXPECT_EQ(leaves.log, "a");
  EXPECT_FALSE(runner.is_running());
  EXPECT_EQ(runner.reports().at(1).status.reason, "given up");
}

}  // namespace
}  // namespace cairn
