// Drives a robot straight on until it is killed: ros2_driver DOMAIN GUARD
#include <string>

#include "framework/live/live_robot.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"

int main(int count, char** arguments) {
  using namespace cairn;
  if (count != 3) return 2;
  ros2_robot::Config config;
  config.domain = std::stoi(arguments[1]);
  config.network = ros2_robot::Network::localhost;
  config.ranges = {{"/sonar", ros2_robot::RangeKind::range, {"sonar_0", "sonar_1", "sonar_2"}, 0}};
  RobotModel robot;
  robot.sonars.resize(3);
  live::LiveRobot driven(ros2_robot::link_to(config, robot, {}, arguments[2]), config.stop_when, robot);
  while (driven.next({}).state == SensorState::observation) driven.drive()->command({0.2, 0.0}, 0.3);
  return 1;
}
