#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/conformance/behaviour_host.hpp"
#include "tests/plugins/python_module/python_file.hpp"

namespace cairn::testing_python {
namespace {

using conformance::BehaviourHost;
using testing::HasSubstr;
using testing::MatchesRegex;

std::string ticking(const std::string& body, const std::string& more = "") {
  return "class It:\n"
         "  def __init__(self, context): self.context = context; self.ticks = 0\n"
         "  def tick(self, world, ask):\n"
         "    self.ticks += 1\n" +
         body + more;
}

std::string error_of_tick(const std::string& body) {
  const auto behaviour = behaviour_of(ticking(body));
  BehaviourHost host;
  return error_of([&] { (void)host.tick(*behaviour); });
}

TEST(PythonBehaviour, SeesTheWorldAndDrives) {
  const auto behaviour = behaviour_of(
      ticking("    x_m, y_m, heading = world.pose\n"
              "    assert (x_m, y_m, heading) == (1.0, 1.0, 0.0) and not world.is_lost\n"
              "    assert world.covariance.shape == (3, 3) and world.time_s == 0.0\n"
              "    square, = world.landmarks\n"
              "    assert square.id == 1 and square.category == 'square' and square.approach_pose[1] == 3.5\n"
              "    assert world.grid.probability()[world.grid.cell_of(3, 2.5)] > 0.9\n"
              "    seen = world.observation\n"
              "    assert len(seen.ranges_m) == 8 and seen.sensor_poses.shape == (8, 3)\n"
              "    ask.drive(0.1, w_radps=-0.2)\n"
              "    ask.report('so far')\n"
              "    return 'running', 'on its way'\n"));
  BehaviourHost host;
  const Status status = host.tick(*behaviour);
  EXPECT_EQ(status, (Status{StepState::running, "on its way"}));
  EXPECT_THAT(host.record(), HasSubstr("drive v 0.10000000000000001 w -0.20000000000000001"));
  EXPECT_THAT(host.record(), HasSubstr("so far"));
}

TEST(PythonBehaviour, SeesThatTheMapHasMovedAndWherePlacesLieNow) {
  const auto behaviour = behaviour_of(
      ticking("    if self.ticks == 1:\n"
              "      assert world.map_moves == 0 and world.moved((1, 1)) is None\n"
              "      return 'running', 'before'\n"
              "    assert world.map_moves == self.ticks // 2\n"
              "    (x_m, y_m), here = world.moved((1, 1)), world.moved((1, 1, 0))\n"
              "    assert 0.0 < abs(x_m - 1) < 0.05 and here[:2] == (x_m, y_m) and abs(here[2] - 0.002) < 1e-9\n"
              "    return 'running', 'after'\n"));
  BehaviourHost host;
  host.ticks_to_exchange = 2;
  host.T_map_robot = {1.0, 1.0, 0.0};
  EXPECT_EQ(host.tick(*behaviour).reason, "before");
  EXPECT_EQ(host.tick(*behaviour).reason, "after");
  EXPECT_EQ(host.tick(*behaviour).reason, "after");
  EXPECT_THAT(error_of_tick("    world.moved((1,))\n    return 'running', ''\n"), HasSubstr("(x, y, heading)"));
}

TEST(PythonBehaviour, PlansAndFollowsAPathToALandmark) {
  const auto behaviour =
      behaviour_of(ticking("    if self.ticks == 1:\n"
                           "      self.plan = ask.plan(to=world.landmarks[0])\n"
                           "      assert self.plan.solved and self.plan.path.shape[1] == 3\n"
                           "    state, left_m = ask.follow(self.plan.path, speed_mps=0.3)\n"
                           "    return ('success' if state == 'arrived' else 'running'), f'{left_m:.1f} m'\n"));
  BehaviourHost host;
  EXPECT_EQ(host.run(*behaviour, 120.0).state, StepState::success);
  EXPECT_LT((host.T_map_robot.position() - Point(4.5, 3.5)).norm(), 0.3);
}

TEST(PythonBehaviour, GivesAndTakesPlacesByName) {
  const auto behaviour =
      behaviour_of(ticking("    assert ask.input('p') is None\n"
                           "    ask.output('p', (1, 2)); assert ask.input('p') == (1, 2)\n"
                           "    ask.output('p', (1, 2, 3)); assert ask.input('p') == (1, 2, 3)\n"
                           "    ask.output('p', world.landmarks[0]); assert ask.input('p') == [1]\n"
                           "    assert ask.name_landmark(1, 'desk')[0] and not ask.name_landmark(9, 'desk')[0]\n"
                           "    assert ask.name_cluster('C1:L1', 'room') == (False, 'there is no cluster C1:L1')\n"
                           "    done, reason = ask.save('so_far.cairn'); assert done and reason\n"
                           "    return 'success', 'given'\n"));
  BehaviourHost host;
  EXPECT_EQ(host.tick(*behaviour), (Status{StepState::success, "given"}));
}

TEST(PythonBehaviour, WithoutHaltItIsMadeAnew) {
  const auto behaviour = behaviour_of(ticking("    return 'running', str(self.ticks)\n"));
  BehaviourHost host;
  (void)host.tick(*behaviour);
  EXPECT_EQ(host.tick(*behaviour).reason, "2");
  behaviour->halt();
  EXPECT_EQ(host.tick(*behaviour).reason, "1");
}

TEST(PythonBehaviour, HaltIsItsOwnWhereItHasOne) {
  const auto behaviour =
      behaviour_of(ticking("    return 'running', str(self.ticks)\n", "  def halt(self): self.ticks = 10\n"));
  BehaviourHost host;
  (void)host.tick(*behaviour);
  behaviour->halt();
  EXPECT_EQ(host.tick(*behaviour).reason, "11");
}

TEST(PythonBehaviour, SaysWhetherItNeedsAPose) {
  EXPECT_TRUE(behaviour_of(ticking("    return 'running', 'x'\n"))->needs_pose());
  EXPECT_FALSE(behaviour_of(ticking("    return 'running', 'x'\n", "  needs_pose = False\n"))->needs_pose());
}

TEST(PythonBehaviour, WhatItReturnsIsChecked) {
  EXPECT_THAT(error_of_tick("    pass\n"), HasSubstr("tick() must return (state, reason) with one of running, success, "
                                                     "failure; found None"));
  EXPECT_THAT(error_of_tick("    return 'done', 'x'\n"), HasSubstr("found tuple ('done', 'x')"));
  EXPECT_THAT(error_of_tick("    return 'running', 7\n"), HasSubstr("must be text, found int 7"));
}

TEST(PythonBehaviour, WhatItRaisesHasItsLine) {
  EXPECT_THAT(error_of_tick("    return world.posee\n"),
              MatchesRegex("[^\n]*\\.py:5:[0-9]+: AttributeError: [^\n]*posee[^\n]*\n.*"));
  EXPECT_THAT(error_of_tick("    ask.plan(to='L1')\n"), HasSubstr("to must be (x, y) or (x, y, heading)"));
}

// A host below which something fails: a std::runtime_error as the contract says, or the end of the mission, which is
// none.
class FailingHost : public BehaviourHost {
 public:
  struct End {};
  void report(const std::string& sentence) override {
    if (sentence == "end") throw End{};
    throw std::logic_error("no " + sentence);
  }
};

TEST(PythonBehaviour, WhatTheHostThrowsBelowItComesOutAsItWas) {
  FailingHost host;
  const auto through = behaviour_of(ticking("    ask.report('pen')\n"));
  EXPECT_THROW((void)host.tick(*through), std::logic_error);
  const auto caught =
      behaviour_of(ticking("    try: ask.report('pen')\n"
                           "    except RuntimeError as error: return 'failure', str(error)\n"));
  EXPECT_EQ(host.tick(*caught), (Status{StepState::failure, "no pen"}));
}

TEST(PythonBehaviour, CannotGoOnWhenTheMissionHasEnded) {
  FailingHost host;
  const auto behaviour =
      behaviour_of(ticking("    try: ask.report('end')\n"
                           "    except BaseException: return 'running', 'never mind'\n"));
  EXPECT_THROW((void)host.tick(*behaviour), FailingHost::End);
}

}  // namespace
}  // namespace cairn::testing_python
