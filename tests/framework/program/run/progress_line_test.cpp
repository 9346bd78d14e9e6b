#include "framework/program/run/progress_line.hpp"

#include <gmock/gmock.h>

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
  const LandmarkGraph graph_;
  const RobotModel robot_;
};

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

TEST_F(ProgressLineTest, AStallSaysForHowLongAndWhere) {
  ProgressLine line(out_, false, [&] { return status_; });
  publish(line, Stalled{"detector", "template_matcher", 1.25}, 3.0);
  EXPECT_EQ(out_.str(),
            "    3.0 s  the robot was stopped: no tick had ended for 1.25 s (in stage detector of module "
            "template_matcher); it goes on\n");
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
