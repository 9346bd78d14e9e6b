// Messages of ROS 2 as they are on the wire (CDR, little-endian), with the text of their definitions, so that a
// recording needs no package of ROS to be read.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "maps/exchange/recordings/foxglove_json.hpp"
#include "maps/geometry/pose.hpp"

namespace cairn::exchange::ros2 {

enum class Message { pose_stamped, occupancy_grid, tf };

// "geometry_msgs/msg/PoseStamped".
[[nodiscard]] std::string_view name_of(Message message);
// With the definitions that it uses, as the schema encoding ros2msg has it.
[[nodiscard]] std::string definition_of(Message message);

struct Header {
  std::uint64_t time_ns = 0;
  std::string_view frame;
};

struct Transform {
  std::string child;
  Pose2 T_frame_child;
};

[[nodiscard]] std::string pose_stamped(const Header& header, const Pose2& T_frame_object);
[[nodiscard]] std::string tf(const Header& header, std::span<const Transform> transforms);
// -1 unknown, otherwise the probability of being occupied in per cent.
[[nodiscard]] std::string occupancy_grid(const Header& header, const foxglove::GridBytes& grid);

}  // namespace cairn::exchange::ros2
