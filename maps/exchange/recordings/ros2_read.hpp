// Messages of ROS 2 read from the wire (CDR of either byte order), as far as a robot in the plane needs them.
//
// Numbers are what the message says: metres, radians, any of them not finite. Fields behind those here are not looked
// at, so that a newer definition with more of them reads the same.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::exchange::ros2 {

// Bytes that are no such message.
class MessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ReadHeader {
  std::int64_t stamp_ns = 0;
  std::string frame;
};

struct ReadPose {
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;
  double qx = 0.0, qy = 0.0, qz = 0.0, qw = 1.0;  // as said: of any length
};
// Of the x axis, seen from above; none of what is no rotation.
[[nodiscard]] std::optional<double> heading_rad(const ReadPose& pose);

struct RangeMessage {
  ReadHeader header;
  double field_of_view_rad = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
  double range_m = 0.0;
};
struct LaserScanMessage {
  ReadHeader header;
  double first_rad = 0.0;
  double step_rad = 0.0;
  double min_m = 0.0;
  double max_m = 0.0;
  std::vector<float> ranges_m;
};
struct OdometryMessage {
  ReadHeader header;
  std::string child_frame;
  ReadPose pose;
};
struct ImuMessage {
  ReadHeader header;
  std::optional<double> heading_rad;  // none: it says that it has no orientation
};
struct TransformMessage {
  ReadHeader header;
  std::string child_frame;
  ReadPose pose;
};
// The data are those of the message's bytes.
struct ImageMessage {
  ReadHeader header;
  std::uint32_t height_px = 0;
  std::uint32_t width_px = 0;
  std::string encoding;
  bool is_bigendian = false;
  std::uint32_t step = 0;  // bytes of a row
  std::span<const std::uint8_t> data;
};
struct CompressedImageMessage {
  ReadHeader header;
  std::string format;
  std::span<const std::uint8_t> data;
};

// Throw MessageError.
[[nodiscard]] RangeMessage read_range(std::string_view cdr);
[[nodiscard]] LaserScanMessage read_laser_scan(std::string_view cdr);
[[nodiscard]] OdometryMessage read_odometry(std::string_view cdr);
[[nodiscard]] ImuMessage read_imu(std::string_view cdr);
[[nodiscard]] std::vector<TransformMessage> read_tf(std::string_view cdr);
// The bytes must outlive these.
[[nodiscard]] ImageMessage read_image(std::string_view cdr);
[[nodiscard]] CompressedImageMessage read_compressed_image(std::string_view cdr);

}  // namespace cairn::exchange::ros2
