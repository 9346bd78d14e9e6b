#include "plugins/rosbridge_robot/rosbridge_robot.hpp"

#include "plugins/rosbridge_robot/rosbridge_link.hpp"

namespace cairn::rosbridge_robot {

std::unique_ptr<live::BaseLink> link_to(const Config& config, const RobotModel& robot) {
  return std::make_unique<RosbridgeLink>(config, robot);
}

}  // namespace cairn::rosbridge_robot
