// What the simulated robot observes, with what really was.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "plugins/simulated_robot/simulated_robot.hpp"

namespace cairn::testing {

struct Witnessed : Observation {
  std::optional<Pose2> true_T_map_robot{};
  std::optional<Contact> contact{};
};

inline Witnessed observe(SimulatedRobot& robot) {
  SensorStep step = robot.next({});
  EXPECT_EQ(step.state, SensorState::observation) << step.reason;
  Witnessed seen{std::move(step.observation)};
  if (const auto truth = robot.truth()->last_truth()) {
    seen.true_T_map_robot = truth->T_map_robot;
    seen.contact = truth->contact;
  }
  return seen;
}

}  // namespace cairn::testing
