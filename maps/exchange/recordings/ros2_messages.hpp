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

enum class Message { pose_stamped, occupancy_grid, tf, odometry, range, laser_scan, imu };

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

struct Range {
  double half_beam_rad = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
  double range_m = 0.0;  // as REP-117 has it
};

[[nodiscard]] std::string pose_stamped(const Header& header, const Pose2& T_frame_object);
[[nodiscard]] std::string tf(const Header& header, std::span<const Transform> transforms);
// -1 unknown, otherwise the probability of being occupied in per cent.
[[nodiscard]] std::string occupancy_grid(const Header& header, const foxglove::GridBytes& grid);

// All covariances 0: not known.
[[nodiscard]] std::string odometry(const Header& header, std::string_view child_frame, const Pose2& T_frame_child);
// By sound; a beam without width as of light.
[[nodiscard]] std::string range(const Header& header, const Range& range);
// What the scan says of its laser's place is left to the header's frame.
[[nodiscard]] std::string laser_scan(const Header& header, const foxglove::Scan& scan, double min_m, double max_m);
// An orientation alone.
[[nodiscard]] std::string imu(const Header& header, double heading_rad);

}  // namespace cairn::exchange::ros2
