// A robot behind a rosbridge_server of a test's own, driven as a mission does.
#pragma once

#include <gtest/gtest.h>

#include "framework/live/live_robot.hpp"
#include "framework/live/steady_time.hpp"
#include "plugins/rosbridge_robot/rosbridge_robot.hpp"
#include "tests/plugins/rosbridge_robot/rosbridge_server.hpp"

namespace cairn::rosbridge_robot {

inline RobotModel bridged_robot() {
  RobotModel model;
  model.sonars.resize(3);
  model.lasers.resize(1);
  return model;
}

inline Config bridged_config(const RosbridgeServer& server, int ros = 2) {
  Config made;
  made.host = "127.0.0.1";
  made.port = server.port();
  made.ros = ros;
  made.ranges = {{"/sonar", ros::RangeKind::range, {"sonar_0", "sonar_1", "sonar_2"}, 0}};
  made.emergency = "/e_stop";
  return made;
}

inline std::unique_ptr<live::LiveRobot> bridged(const Config& config) {
  return std::make_unique<live::LiveRobot>(link_to(config, bridged_robot()), config.stop_when, bridged_robot());
}

// Orders 0.2 m/s at each observation, for so long after the first; what the last of them was.
inline SensorStep drive_bridged(live::LiveRobot& driven, double for_s) {
  SensorStep step = driven.next({});
  if (step.state != SensorState::observation) return step;
  for (const double begin_s = live::now_s(); live::now_s() - begin_s < for_s;) {
    step = driven.next({});
    if (step.state != SensorState::observation) return step;
    driven.drive()->command({0.2, 0.0}, 0.3);
  }
  return step;
}

}  // namespace cairn::rosbridge_robot
