#include "plugins/ros2_robot/settings_check.hpp"

#include <utility>

namespace cairn::ros2_robot {

void check_settings(const Config& config, const RobotModel& robot) {
  constexpr const char* kModule = "ros2_robot";
  ros::check_topics(kModule, config, robot);
  for (const ImageTopic& image : config.images) ros::check_topic(kModule, "images.topic", image.topic, false);
  ros::check_topic(kModule, "command.topic", config.command.topic, false);
  for (const auto& [key, topic] :
       {std::pair{"show.map", config.show.map}, std::pair{"show.pose", config.show.pose},
        std::pair{"show.plan", config.show.plan}, std::pair{"show.landmarks", config.show.landmarks},
        std::pair{"show.diagnostics", config.show.diagnostics}, std::pair{"goal", config.goal},
        std::pair{"initial_pose.topic", config.initial_pose.topic}})
    ros::check_topic(kModule, key, topic, true);
}

}  // namespace cairn::ros2_robot
