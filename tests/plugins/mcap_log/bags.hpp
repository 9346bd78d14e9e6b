// Small bags of ROS 2, written message by message.
#pragma once

#include <cmath>
#include <string>

#include "maps/exchange/recordings/mcap_writer.hpp"
#include "maps/exchange/recordings/ros2_messages.hpp"
#include "plugins/mcap_log/mcap_log.hpp"
#include "tests/plugins/log_files.hpp"

namespace cairn::mcap_log::bags {

namespace written = exchange::ros2;

inline std::uint64_t ns_of(double time_s) {
  return static_cast<std::uint64_t>(std::llround(1e9 * time_s));
}

class BagWriter {
 public:
  explicit BagWriter(exchange::McapOptions options = {})
      : writer_([this](std::string_view bytes) { bytes_ += bytes; }, std::move(options)) {}

  void write(const std::string& topic, const std::string& type, double time_s, const std::string& message,
             const std::string& encoding = "cdr") {
    const auto [known, is_new] = channels_.try_emplace(topic, 0);
    if (is_new) known->second = writer_.add_channel(topic, writer_.add_schema(type, "ros2msg", ""), encoding);
    writer_.write(known->second, ns_of(time_s), message);
  }
  void odom(double time_s, const Pose2& pose, const std::string& topic = "/odom") {
    write(topic, "nav_msgs/msg/Odometry", time_s, written::odometry({ns_of(time_s), "odom"}, "base_link", pose));
  }
  void tf(const std::string& topic, double time_s, const std::string& parent, const std::string& child,
          const Pose2& pose) {
    const written::Transform transform{child, pose};
    write(topic, "tf2_msgs/msg/TFMessage", time_s, written::tf({ns_of(time_s), parent}, {&transform, 1}));
  }
  void range(double time_s, const std::string& frame, double range_m, const std::string& topic = "/sonar") {
    write(topic, "sensor_msgs/msg/Range", time_s, written::range({ns_of(time_s), frame}, {0.25, 0.125, 4.0, range_m}));
  }
  void scan(double time_s, const std::vector<double>& ranges_m, const std::string& topic = "/scan") {
    exchange::foxglove::Scan scan;
    scan.first_rad = -1.0;
    scan.last_rad = 1.0;
    scan.ranges_m = ranges_m;
    write(topic, "sensor_msgs/msg/LaserScan", time_s, written::laser_scan({ns_of(time_s), "laser"}, scan, 0.125, 8.0));
  }
  void image(double time_s, int width_px, int height_px, const std::string& encoding, const std::string& pixels,
             const std::string& topic = "/image") {
    const auto width = static_cast<std::uint32_t>(width_px);
    std::string bytes = header_of(time_s);
    append(bytes, static_cast<std::uint32_t>(height_px));
    append(bytes, width);
    append(bytes, encoding);
    bytes += '\0';  // little-endian
    append(bytes, static_cast<std::uint32_t>(pixels.size() / static_cast<std::size_t>(height_px)));
    append(bytes, static_cast<std::uint32_t>(pixels.size()));
    write(topic, "sensor_msgs/msg/Image", time_s, bytes + pixels);
  }
  void packed_image(double time_s, const std::string& packed, const std::string& topic = "/image/compressed") {
    std::string bytes = header_of(time_s);
    append(bytes, std::string("jpeg"));
    append(bytes, static_cast<std::uint32_t>(packed.size()));
    write(topic, "sensor_msgs/msg/CompressedImage", time_s, bytes + packed);
  }
  std::string closed() {
    writer_.close();
    return bytes_;
  }

 private:
  // CDR by hand: numbers stand at multiples of four behind the encoding.
  static void append(std::string& bytes, std::uint32_t number) {
    bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xffU);
  }
  static void append(std::string& bytes, const std::string& text) {
    append(bytes, static_cast<std::uint32_t>(text.size() + 1));
    bytes += text;
    bytes += '\0';
  }
  static std::string header_of(double time_s) {
    std::string bytes("\0\1\0\0", 4);
    append(bytes, static_cast<std::uint32_t>(ns_of(time_s) / 1'000'000'000));
    append(bytes, static_cast<std::uint32_t>(ns_of(time_s) % 1'000'000'000));
    append(bytes, std::string("camera"));
    return bytes;
  }

  std::string bytes_;
  exchange::McapWriter writer_;
  std::map<std::string, std::uint16_t> channels_;
};

// A robot that drives 1 m/s ahead for two seconds, with a laser 0.2 m ahead of its centre.
inline std::string laser_bag(exchange::McapOptions options = {}) {
  BagWriter bag(std::move(options));
  bag.tf("/tf_static", 0.0, "base_link", "laser", {0.25, 0.0, 0.0});
  for (int i = 0; i <= 20; ++i) {
    bag.odom(10.0 + 0.1 * i, {0.1 * i, 0.0, 0.0});
    bag.scan(10.05 + 0.1 * i, {1.0, 2.0, 3.0});
  }
  return bag.closed();
}

// What happened while `file` was played: the observations, or the refusal.
struct Played {
  std::vector<Observation> seen;
  std::string reason;  // of the end, or the refusal without its folder
  std::optional<Pose2> start;
};

inline Played played(const log_files::LogFolder& folder, const std::string& bytes, Config config = {}) {
  config.file = folder.write("a.mcap", bytes);
  Played played;
  try {
    log_common::ScanPlayer player(read_mcap_log(config));
    played.seen = log_files::play(player, played.reason);
    played.start = player.start();
  } catch (const ConfigError& error) {
    played.reason = folder.without_folder(error.what());
  }
  return played;
}

}  // namespace cairn::mcap_log::bags
