#include "maps/exchange/recordings/ros2_read.hpp"

#include <bit>
#include <cmath>

namespace cairn::exchange::ros2 {
namespace {

constexpr std::size_t kEncoding = 4;  // bytes that name it

// Each number at a multiple of its own size behind the encoding.
class CdrReader {
 public:
  explicit CdrReader(std::string_view bytes) : bytes_(bytes) {
    const bool is_cdr = bytes.size() >= kEncoding && bytes[0] == 0 && (bytes[1] == 0 || bytes[1] == 1);
    if (!is_cdr) throw MessageError("the message is not in plain CDR");
    is_little_ = bytes[1] == 1;
    at_ = kEncoding;
  }
  std::uint8_t u8() { return number<std::uint8_t>(); }
  std::uint32_t u32() { return number<std::uint32_t>(); }
  double f32() { return std::bit_cast<float>(number<std::uint32_t>()); }
  double f64() { return std::bit_cast<double>(number<std::uint64_t>()); }
  std::string text() {
    const std::uint32_t size = u32();  // with its final 0
    if (size == 0) return {};
    std::string text(take(size));
    text.pop_back();
    return text;
  }
  // Of a sequence whose elements have that many bytes at least.
  std::uint32_t count(std::size_t each) {
    const std::uint32_t count = u32();
    if (count > (bytes_.size() - at_) / each) throw MessageError("the message ends early");
    return count;
  }
  std::span<const std::uint8_t> octets() {
    const std::string_view data = take(u32());
    return {reinterpret_cast<const std::uint8_t*>(data.data()), data.size()};
  }
  ReadHeader header() {
    constexpr std::int64_t kNsOfSecond = 1'000'000'000;
    const auto seconds = static_cast<std::int32_t>(u32());
    ReadHeader header;
    header.stamp_ns = kNsOfSecond * seconds + u32();
    header.frame = text();
    return header;
  }
  ReadPose pose() {
    ReadPose pose;
    for (double* value : {&pose.x_m, &pose.y_m, &pose.z_m, &pose.qx, &pose.qy, &pose.qz, &pose.qw}) *value = f64();
    return pose;
  }

 private:
  std::string_view take(std::size_t count) {
    if (count > bytes_.size() - at_) throw MessageError("the message ends early");
    at_ += count;
    return bytes_.substr(at_ - count, count);
  }
  template <class Unsigned>
  Unsigned number() {
    constexpr std::size_t kSize = sizeof(Unsigned);
    (void)take((kSize - (at_ - kEncoding) % kSize) % kSize);
    const std::string_view bytes = take(kSize);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < kSize; ++i)
      value = value << 8U | static_cast<unsigned char>(bytes[is_little_ ? kSize - 1 - i : i]);
    return static_cast<Unsigned>(value);
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool is_little_ = true;
};

}  // namespace

std::optional<double> heading_rad(const ReadPose& pose) {
  const double size = pose.qx * pose.qx + pose.qy * pose.qy + pose.qz * pose.qz + pose.qw * pose.qw;
  constexpr double kMin = 0.5;
  constexpr double kMax = 2.0;
  if (!(size > kMin && size < kMax)) return std::nullopt;
  if (pose.qx == 0.0 && pose.qy == 0.0) return 2.0 * std::atan2(pose.qz, pose.qw);  // exact to the last bits
  return std::atan2(2.0 * (pose.qw * pose.qz + pose.qx * pose.qy),
                    size - 2.0 * (pose.qy * pose.qy + pose.qz * pose.qz));
}

RangeMessage read_range(std::string_view cdr) {
  CdrReader in(cdr);
  RangeMessage message;
  message.header = in.header();
  (void)in.u8();  // by sound or by light
  message.field_of_view_rad = in.f32();
  message.min_m = in.f32();
  message.max_m = in.f32();
  message.range_m = in.f32();
  return message;
}

LaserScanMessage read_laser_scan(std::string_view cdr) {
  CdrReader in(cdr);
  LaserScanMessage message;
  message.header = in.header();
  message.first_rad = in.f32();
  (void)in.f32();  // the last angle
  message.step_rad = in.f32();
  (void)in.f32();  // time between beams
  (void)in.f32();  // and between scans
  message.min_m = in.f32();
  message.max_m = in.f32();
  message.ranges_m.resize(in.count(sizeof(float)));
  for (float& range_m : message.ranges_m) range_m = static_cast<float>(in.f32());
  return message;
}

OdometryMessage read_odometry(std::string_view cdr) {
  CdrReader in(cdr);
  OdometryMessage message;
  message.header = in.header();
  message.child_frame = in.text();
  message.pose = in.pose();
  return message;
}

ImuMessage read_imu(std::string_view cdr) {
  CdrReader in(cdr);
  ImuMessage message;
  message.header = in.header();
  ReadPose pose;
  for (double* value : {&pose.qx, &pose.qy, &pose.qz, &pose.qw}) *value = in.f64();
  constexpr double kUnknown = -1.0;  // as the first covariance
  if (in.f64() != kUnknown) message.heading_rad = heading_rad(pose);
  return message;
}

std::vector<TransformMessage> read_tf(std::string_view cdr) {
  CdrReader in(cdr);
  constexpr std::size_t kSmallest = 72;  // two empty names, a stamp and seven numbers
  std::vector<TransformMessage> messages(in.count(kSmallest));
  for (TransformMessage& message : messages) {
    message.header = in.header();
    message.child_frame = in.text();
    message.pose = in.pose();
  }
  return messages;
}

ImageMessage read_image(std::string_view cdr) {
  CdrReader in(cdr);
  ImageMessage message;
  message.header = in.header();
  message.height_px = in.u32();
  message.width_px = in.u32();
  message.encoding = in.text();
  message.is_bigendian = in.u8() != 0;
  message.step = in.u32();
  message.data = in.octets();
  return message;
}

CompressedImageMessage read_compressed_image(std::string_view cdr) {
  CdrReader in(cdr);
  CompressedImageMessage message;
  message.header = in.header();
  message.format = in.text();
  message.data = in.octets();
  return message;
}

}  // namespace cairn::exchange::ros2
