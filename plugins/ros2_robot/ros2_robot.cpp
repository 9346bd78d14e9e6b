#include "plugins/ros2_robot/ros2_robot.hpp"

#include "plugins/ros2_robot/ros_link.hpp"

namespace cairn::ros2_robot {

std::unique_ptr<live::BaseLink> link_to(const Config& config, const RobotModel& robot, const Budget& budget,
                                        const std::filesystem::path& guard) {
  return std::make_unique<RosLink>(config, robot, budget, guard);
}

}  // namespace cairn::ros2_robot
