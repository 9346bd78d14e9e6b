// Drives straight on until it is killed: rosbridge_driver PORT
#include <string>

#include "framework/live/live_robot.hpp"
#include "plugins/rosbridge_robot/rosbridge_robot.hpp"

int main(int count, char** arguments) {
  using namespace cairn;
  if (count != 2) return 2;
  rosbridge_robot::Config config;
  config.host = "127.0.0.1";
  config.port = std::stoi(arguments[1]);
  config.ranges = {{"/sonar", ros::RangeKind::range, {"sonar_0", "sonar_1", "sonar_2"}, 0}};
  RobotModel robot;
  robot.sonars.resize(3);
  live::LiveRobot driven(rosbridge_robot::link_to(config, robot), config.stop_when, robot);
  while (driven.next({}).state == SensorState::observation) driven.drive()->command({0.2, 0.0}, 0.3);
  return 1;
}
