// Which topics of a log are used: those of the settings, or those that their types single out.
#pragma once

#include <string>
#include <vector>

#include "plugins/mcap_log/bag.hpp"

namespace cairn::mcap_log {

struct ChosenTopics {
  std::vector<std::string> ranges;
  std::string odometry;            // of nav_msgs/msg/Odometry; empty: none
  std::string transforms;          // instead, those of this topic from odometry_frame; empty: none
  std::vector<ImageTopic> images;  // when the bag has any
};

// Throws ConfigError, naming the topics of the log, when settings name one that is not there or is of another type, and
// when nothing singles one out.
[[nodiscard]] ChosenTopics chosen_topics(const Config& config, const Bag& bag, bool wants_images = false);

// "/odom (nav_msgs/msg/Odometry), /scan (sensor_msgs/msg/LaserScan)".
[[nodiscard]] std::string shown_topics(const Bag& bag);

}  // namespace cairn::mcap_log
