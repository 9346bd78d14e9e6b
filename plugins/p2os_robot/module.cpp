#include "framework/contracts/module.hpp"

#include "framework/live/live_robot.hpp"
#include "plugins/p2os_robot/microcontroller.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  namespace p2os_robot = cairn::p2os_robot;
  registrar.add<cairn::Sensor, p2os_robot::Config>(
      "p2os_robot", "drives a Pioneer at a serial line: PSOS, P2OS, ARCOS",
      [](const p2os_robot::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::live::LiveRobot>(
            std::make_unique<p2os_robot::Microcontroller>(config, context.robot), config.stop_when, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
