// The program that guards the wheels of a robot on a ROS 2 network; the module starts it.
#include "plugins/ros2_robot/guard.hpp"

int main(int count, char** arguments) {
  return cairn::ros2_robot::run_guard({arguments, static_cast<std::size_t>(count)});
}
