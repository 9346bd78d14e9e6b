#include "plugins/ros2_robot/ros2_robot.hpp"

#include "plugins/ros2_robot/ros_link.hpp"

namespace cairn::ros2_robot {

std::unique_ptr<live::BaseLink> link_to(const Config& config, const RobotModel& robot, const Budget& budget,
                                        const std::filesystem::path& guard, bool wants_images) {
  return std::make_unique<RosLink>(config, robot, budget, guard, wants_images);
}

}  // namespace cairn::ros2_robot
