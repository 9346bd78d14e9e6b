#include "framework/contracts/module.hpp"

#include <dlfcn.h>

#include <filesystem>

#include "framework/live/live_robot.hpp"
#include "plugins/ros2_robot/ros2_robot.hpp"

namespace {

// Beside this module.
std::filesystem::path guard_program() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&guard_program), &info) == 0) return {};
  return std::filesystem::absolute(info.dli_fname).parent_path() / "ros2_guard";
}

void register_module(cairn::Registrar& registrar) {
  namespace ros2_robot = cairn::ros2_robot;
  registrar.add<cairn::Sensor, ros2_robot::Config>(
      "ros2_robot", "drives a robot on a ROS 2 network, without ROS on this computer",
      [](const ros2_robot::Config& config, const cairn::SensorContext& context) {
        return std::make_unique<cairn::live::LiveRobot>(
            ros2_robot::link_to(config, context.robot, context.budget, guard_program(), context.wants_images),
            config.stop_when, context.robot);
      });
}

}  // namespace

CAIRN_MODULE(register_module)
