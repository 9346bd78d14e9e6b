#include "framework/program/run/progress_line.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <sstream>

#include "framework/contracts/world_view.hpp"

namespace cairn {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

class ProgressLineTest : public testing::Test {
 protected:
  // In a world without cells, at that time.
  void publish(ProgressLine& line, const Event& event, double time_s) {
    const OccupancyGrid grid(0.1);
    const WorldView world{grid, graph_, robot_, {}, time_s};
    line.on(event, {world});
  }
  RunStatus status_;
  std::ostringstream out_;
  LandmarkGraph graph_;
  const RobotModel robot_{};
};

Landmark square() {
  Landmark landmark;
  landmark.category = "square";
  landmark.T_map_landmark = {1.5, 2.0, 0.0};
  landmark.degree = 0.61;
  return landmark;
}

TEST(ProgressText, NamesTheStepAndWhatIsKnown) {
  RunStatus status;
  status.explored_ratio = 0.634;
  EXPECT_EQ(progress_text(status), "63 % known");
  status.step = 1;
  status.steps = 3;
  status.step_name = "explore";
  EXPECT_EQ(progress_text(status), "step 1 of 3: explore, 63 % known");
}

TEST_F(ProgressLineTest, OnATerminalTheLineIsDrawnEveryTwoSecondsAndErasedBeforeASentence) {
  ProgressLine line(out_, true, [&] { return status_; });
  publish(line, TickDone{}, 1.0);
  EXPECT_EQ(out_.str(), "");
  publish(line, TickDone{}, 2.0);
  EXPECT_EQ(out_.str(), "    0.0 s  0 % known");
  publish(line, Message{"looks for a door"}, 2.5);
  EXPECT_THAT(out_.str(), EndsWith("\r    2.5 s  looks for a door\n"));
}

TEST_F(ProgressLineTest, ElsewhereALineIsPrintedEachMinute) {
  ProgressLine line(out_, false, [&] { return status_; });
  for (const double time_s : {20.0, 59.0, 60.0, 61.0, 119.0, 121.0}) publish(line, TickDone{}, time_s);
  EXPECT_EQ(out_.str(), "   60.0 s  0 % known\n  121.0 s  0 % known\n");
}

TEST_F(ProgressLineTest, ALongLineIsCutAtTheTerminalsWidth) {
  status_.steps = 1;
  status_.step_name = std::string(500, 'x');
  ProgressLine line(out_, true, [&] { return status_; });
  publish(line, TickDone{}, 2.0);
  EXPECT_EQ(out_.str().size(), 110U);
  EXPECT_THAT(out_.str(), EndsWith("..."));
}

TEST_F(ProgressLineTest, AnEmergencyStopSaysWhoHoldsTheRobotAndForHowLong) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, RobotStopped{"the emergency topic /e_stop"}, 3.0);
  publish(line, RobotReleased{"the emergency topic /e_stop", 4.5}, 7.5);
  EXPECT_EQ(out_.str(),
            "    3.0 s  the robot is stopped by the emergency topic /e_stop: it stands until that is released\n"
            "    7.5 s  released by the emergency topic /e_stop after 4.5 s\n");
}

TEST_F(ProgressLineTest, AStallSaysForHowLongAndWhere) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, Stalled{"detector", "template_matcher", 1.25}, 3.0);
  EXPECT_EQ(out_.str(),
            "    3.0 s  the robot was stopped: no tick had ended for 1.25 s (in stage detector of module "
            "template_matcher); it goes on\n");
}

TEST_F(ProgressLineTest, AStallOfTheWholeProcessBlamesNoStage) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, Stalled{"", "", 1.25}, 3.0);
  EXPECT_EQ(out_.str(),
            "    3.0 s  the robot was stopped: this whole process had stood still for 1.25 s (stopped by a signal, or "
            "without a processor); it goes on\n");
}

TEST_F(ProgressLineTest, AStageThatStallsInEachTickIsReportedOnceAndWhenItIsMuchWorse) {
  ProgressLine line(out_, false, [&] { return status_; });
  for (const double for_s : {0.3, 0.31, 0.4, 0.3, 0.7, 0.3, 1.3})
    publish(line, Stalled{"marker detector", "april_tags", for_s}, 3.0);
  publish(line, Stalled{"detector", "template_matcher", 0.3}, 4.0);
  const std::string text = out_.str();
  EXPECT_EQ(std::ranges::count(text, '\n'), 3) << text;
  EXPECT_THAT(text, AllOf(HasSubstr("for 0.30 s (in stage marker detector"), HasSubstr("for 0.70 s"),
                          HasSubstr("4.0 s  the robot was stopped")));
}

TEST_F(ProgressLineTest, ALandmarkIsReportedWhenItIsFoundAndWhenItsCategoryChanges) {
  ProgressLine line(out_, false, [&] { return status_; });
  Landmark landmark = square();
  landmark.id = 1;
  publish(line, LandmarkChanged{landmark, true}, 3.0);
  landmark.degree = 0.7;
  publish(line, LandmarkChanged{landmark, false}, 4.0);
  landmark.category = "octagon";
  publish(line, LandmarkChanged{landmark, false}, 5.0);
  EXPECT_EQ(out_.str(),
            "    3.0 s  found L1: square at (1.50, 2.00), degree 0.61\n"
            "    5.0 s  L1 is an octagon now, no longer a square, at (1.50, 2.00), degree 0.70\n");
}

TEST_F(ProgressLineTest, TheCategoryOfALandmarkThatWasKnownBeforeMayChangeToo) {
  Landmark landmark = square();
  landmark.id = graph_.add(landmark);
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, TickDone{}, 1.0);
  landmark.category = "circle";
  publish(line, LandmarkChanged{landmark, false}, 2.0);
  EXPECT_THAT(out_.str(), HasSubstr("L1 is a circle now, no longer a square"));
}

TEST_F(ProgressLineTest, AnAutosaveSaysHowFarItReaches) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, Autosaved{"m.autosave.cairn", 12.5, 183.2}, 13.0);
  EXPECT_EQ(out_.str(), "   13.0 s  autosaved m.autosave.cairn (state at 12.500 s, written in 183 ms)\n");
}

TEST_F(ProgressLineTest, TheOutcomeOfAStepIsNamedWithItsReason) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, StepEnded{0, "goto", {StepState::failure, "no route"}}, 3.0);
  publish(line, NodeEnded{"1/2", "goto", NodeKind::behaviour, {StepState::running, ""}, true}, 4.0);
  EXPECT_EQ(out_.str(), "    3.0 s  step 1: goto failed (no route)\n    4.0 s  step 1/2: goto halted\n");
}

TEST_F(ProgressLineTest, ControlCharactersOfAMessageAreQuoted) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, Message{"\x1b[2J"}, 1.0);
  EXPECT_THAT(out_.str(), AllOf(HasSubstr("\\x1b[2J"), Not(HasSubstr("\x1b"))));
}

}  // namespace
}  // namespace cairn
