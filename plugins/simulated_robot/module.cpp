#include "framework/contracts/module.hpp"

#include "plugins/simulated_robot/config.hpp"
#include "plugins/simulated_robot/simulated_robot.hpp"

namespace {

void register_module(cairn::Registrar& registrar) {
  registrar.add<cairn::Sensor, cairn::SimulatedRobotConfig>(
      "simulated_robot", "a robot that drives and measures in a simulated world",
      [](const cairn::SimulatedRobotConfig& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::SimulatedRobot>(config, context.robot, context.world, context.T_map_start,
                                                       context.seed, context.begin_s, context.wants_images);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
