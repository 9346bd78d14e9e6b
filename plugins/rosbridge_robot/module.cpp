#include "framework/contracts/module.hpp"

#include "framework/live/live_robot.hpp"
#include "plugins/rosbridge_robot/rosbridge_robot.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace rosbridge_robot = cairn::rosbridge_robot;
  registrar.add<cairn::Sensor, rosbridge_robot::Config>(
      "rosbridge_robot", "drives a robot with ROS 1 or 2 behind a rosbridge_server",
      [](const rosbridge_robot::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::live::LiveRobot>(rosbridge_robot::link_to(config, context.robot),
                                                        config.stop_when, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
