// An MCAP file of ROS 2 (rosbag2) played back. Plugin `mcap_log`, kind sensor; nothing to drive.
//
// Read are messages in CDR: sensor_msgs/msg/LaserScan and Range as observations, nav_msgs/msg/Odometry or the
// transforms of the odometry's frame as poses, sensor_msgs/msg/Imu as a compass, pictures when they are wanted. The
// pose of an observation is that between the two around its stamp. Range messages with the same stamp are one
// observation. Where a sensor is on the robot is what the transforms say, those of the static topic first, or the
// settings.
//
// Odometry knows no place in a map: the mission's `start` says where the robot was at the first observation. With
// compass_from_pose the log's frame is the map's, and its first pose is the start.
//
// Bad records, refused or skipped and counted: a chunk whose checksum is wrong or that does not unpack, a message that
// ends early, limits that are none, a sensor whose place is not known, a pose beyond 100 km. A file that ends early is
// read up to its last whole chunk in any case.
#pragma once

#include <vector>

#include "framework/contracts/robot_model.hpp"
#include "plugins/common/pictures/picture_player.hpp"
#include "plugins/mcap_log/config.hpp"

namespace cairn::mcap_log {

// Reads the whole log. Throws ConfigError for what is refused, for topics that must be chosen, and for a log without an
// observation.
[[nodiscard]] log_common::ScanLog read_mcap_log(const Config& config, const Budget& budget = {});

struct LogWithPictures {
  log_common::ScanLog scans;
  std::vector<pictures::RecordedPicture> pictures;  // in their order, for a PicturePlayer
};
// The same with the pictures of sensor_msgs/msg/Image and CompressedImage. One that cannot be read, or has another size
// than its camera, is a bad record.
[[nodiscard]] LogWithPictures read_with_pictures(const Config& config, const std::vector<CameraModel>& cameras,
                                                 const Budget& budget = {});

}  // namespace cairn::mcap_log
