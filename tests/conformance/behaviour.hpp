// Conformance of modules of kind `behaviour`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyStep, BehaviourConformance,
//                            testing::Values(module<cairn::Behaviour>(FOLDER, "my_step", "{for_s: 2}")));
//   }
//
// The robot stands at (1, 1) m in a room of 6 x 5 m with a post in the middle; landmark L1 is a square at
// (4.5, 4) m. What a step needs to be done within that, its config gives.
#pragma once

#include "tests/conformance/behaviour_host.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class BehaviourConformance : public Conformance<Behaviour> {
 protected:
  static constexpr double kWhile_s = 60.0;

  // Runs for a while in a world that something is odd about.
  template <class Change>
  void expect_unharmed(const std::string& what, Change change) const {
    const auto behaviour = make();
    BehaviourHost host;
    change(host);
    Status status;
    ASSERT_NO_THROW(status = host.run(*behaviour, kWhile_s)) << "with " << what << "; end with failure and a reason";
    EXPECT_EQ(host.fault(), "") << "with " << what;
    EXPECT_NE(status.reason, "") << "with " << what;
    ASSERT_NO_THROW(behaviour->halt()) << "with " << what;
  }
};

TEST_P(BehaviourConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(BehaviourConformance, OutlivesTheLibraryThatMadeIt) {
  const auto behaviour = GetParam().make_outliving_library();
  BehaviourHost host;
  EXPECT_NE(host.run(*behaviour, kWhile_s).state, StepState::failure) << host.record();
}

TEST_P(BehaviourConformance, RunsOrEndsWithASentenceAndFiniteOrders) {
  const auto behaviour = make();
  BehaviourHost host;
  Status status;
  for (int i = 0; i < 1200 && status.state == StepState::running; ++i) {
    status = host.tick(*behaviour);
    ASSERT_EQ(host.fault(), "") << "velocities must be finite";
    ASSERT_NE(status.reason, "") << "say what the step is doing, or why it ended";
  }
  EXPECT_NE(status.state, StepState::failure) << "nothing is in the way of this step: " << status.reason;
}

TEST_P(BehaviourConformance, AHaltAsksForNothing) {
  const auto behaviour = make();
  BehaviourHost host;
  for (int i = 0; i < 40; ++i) {
    if (host.tick(*behaviour).state != StepState::running) break;
  }
  const std::string before = host.record();
  behaviour->halt();
  behaviour->halt();
  EXPECT_EQ(host.record(), before) << "halt() may ask for nothing: the orders of a tick are gone when it returns";
}

TEST_P(BehaviourConformance, IsDestroyedInTheMiddleOfItsWork) {
  auto behaviour = make();
  BehaviourHost host;
  (void)host.run(*behaviour, 2.0);
  const std::string before = host.record();
  behaviour.reset();
  EXPECT_EQ(host.record(), before) << "a destructor may ask for nothing";
}

TEST_P(BehaviourConformance, IsHaltedBeforeItHasBegun) {
  const auto behaviour = make();
  const auto fresh = make();
  behaviour->halt();
  BehaviourHost host;
  BehaviourHost other;
  (void)host.run(*behaviour, 5.0);
  (void)other.run(*fresh, 5.0);
  EXPECT_EQ(host.record(), other.record()) << "a halt before the first tick changes nothing";
}

TEST_P(BehaviourConformance, BeginsAfreshAfterAHalt) {
  const auto fresh = make();
  BehaviourHost expected;
  (void)expected.run(*fresh, kWhile_s);
  for (const double halted_after_s : {1.0, 15.0}) {
    const auto behaviour = make();
    BehaviourHost first;
    (void)first.run(*behaviour, halted_after_s);
    behaviour->halt();
    BehaviourHost host;
    (void)host.run(*behaviour, kWhile_s);
    EXPECT_EQ(host.record(), expected.record()) << "after halt() a tick begins the step anew, as on a new object";
  }
}

TEST_P(BehaviourConformance, TheSameWorldGivesTheSameOrders) {
  const auto first = make(7);
  const auto second = make(7);
  BehaviourHost host;
  BehaviourHost other;
  (void)host.run(*first, kWhile_s);
  (void)other.run(*second, kWhile_s);
  EXPECT_EQ(host.record(), other.record()) << "the answer must depend on config, seed and input only";
}

TEST_P(BehaviourConformance, TwoObjectsShareNothing) {
  const auto alone = make(7);
  BehaviourHost host;
  for (int i = 0; i < 200; ++i)
    if (host.tick(*alone).state != StepState::running) break;
  const auto behaviour = make(7);
  const auto other = make(7);
  BehaviourHost own;
  BehaviourHost others;
  others.T_map_robot = {5.0, 1.0, 2.0};
  bool other_runs = true;
  for (int i = 0; i < 200; ++i) {
    other_runs = other_runs && others.tick(*other).state == StepState::running;
    if (own.tick(*behaviour).state != StepState::running) break;
  }
  EXPECT_EQ(own.record(), host.record()) << "another object of the module changed what this one asks for";
}

TEST_P(BehaviourConformance, OddWorldsAreOutcomesNotExceptions) {
  expect_unharmed("an empty grid", [](BehaviourHost& host) { host.grid = OccupancyGrid(0.05); });
  expect_unharmed("a graph without landmarks", [](BehaviourHost& host) { host.graph = {}; });
  expect_unharmed("no observation", [](BehaviourHost& host) { host.sees = false; });
  expect_unharmed("odd readings", [](BehaviourHost& host) { host.sees_oddly = true; });
  expect_unharmed("a planner that finds nothing", [](BehaviourHost& host) { host.finds_no_route = true; });
  expect_unharmed("plans without a pose", [](BehaviourHost& host) { host.finds_empty_paths = true; });
  expect_unharmed("a stop layer that lets nothing through", [](BehaviourHost& host) { host.holds_back = true; });
  expect_unharmed("time that stands still", [](BehaviourHost& host) { host.tick_s = 0.0; });
  expect_unharmed("time that goes back", [](BehaviourHost& host) { host.tick_s = -0.05; });
}

TEST_P(BehaviourConformance, AMapThatIsExchangedIsAnOutcomeNotAnException) {
  for (const bool is_known : {true, false})
    expect_unharmed("a map that is exchanged again and again", [&](BehaviourHost& host) {
      host.ticks_to_exchange = 100;
      host.knows_map_moves = is_known;
    });
}

TEST_P(BehaviourConformance, OddPosesAndTimesAreOutcomesNotExceptions) {
  for (const double far_m : {1e3, 1e6, -1e9, kHuge})
    expect_unharmed("the robot at x " + text_of(far_m), [&](BehaviourHost& host) { host.T_map_robot.x_m = far_m; });
  expect_unharmed("the robot in a wall", [](BehaviourHost& host) { host.T_map_robot = {3.0, 2.5, 0.0}; });
  for (const double time_s : {-1e6, 1e12, kHuge})
    expect_unharmed("the clock at " + text_of(time_s), [&](BehaviourHost& host) { host.time_s = time_s; });
}

TEST_P(BehaviourConformance, OddRobotsAreOutcomesNotExceptions) {
  expect_unharmed("a robot that cannot move", [](BehaviourHost& host) {
    host.robot.max_v_mps = 0.0;
    host.robot.max_w_radps = 0.0;
    host.robot.max_acceleration_mps2 = 0.0;
    host.robot.max_turn_acceleration_radps2 = 0.0;
  });
  expect_unharmed("a robot without sonars", [](BehaviourHost& host) { host.robot.sonars.clear(); });
  expect_unharmed("a robot without size", [](BehaviourHost& host) { host.robot.radius_m = 0.0; });
  expect_unharmed("a robot larger than the room", [](BehaviourHost& host) { host.robot.radius_m = 4.0; });
  expect_unharmed("a car", [](BehaviourHost& host) {
    host.robot.kinematics = Kinematics::car;
    host.robot.min_turning_radius_m = 0.5;
  });
}

}  // namespace cairn::conformance
