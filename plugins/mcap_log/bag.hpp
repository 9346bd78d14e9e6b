// What a robot sensed, as it lies in an MCAP file of ROS 2: messages by topic, in the order of the file.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "maps/exchange/recordings/ros2_read.hpp"
#include "plugins/mcap_log/config.hpp"
#include "plugins/mcap_log/picture_store.hpp"

namespace cairn::mcap_log {

namespace ros2 = exchange::ros2;

struct Moment {
  std::size_t order = 0;  // in the file
  double stamp_s = 0.0;
  int part = 0;  // counts the jumps of the clock before it

  // By time.
  friend std::partial_ordering operator<=>(const Moment& a, const Moment& b) {
    if (a.part != b.part) return a.part <=> b.part;
    return a.stamp_s <=> b.stamp_s;
  }
  friend bool operator==(const Moment& a, const Moment& b) { return a.part == b.part && a.stamp_s == b.stamp_s; }
};

template <class Message>
struct Timed {
  Moment at;
  std::uint64_t offset = 0;  // in the file
  Message message;
};

template <class Message>
using Topics = std::map<std::string, std::vector<Timed<Message>>>;

struct Bag {
  Topics<ros2::RangeMessage> ranges;
  Topics<ros2::LaserScanMessage> scans;
  Topics<ros2::OdometryMessage> odometry;
  Topics<ros2::ImuMessage> compasses;
  Topics<ros2::TransformMessage> transforms;
  Topics<StoredPicture> images;              // when they are wanted
  std::map<std::string, std::string> types;  // of all topics that have messages
};

// Reads what the settings may need. Messages and chunks that cannot be read go to scans as bad ones, a file that ends
// early as a note. images: where pictures are kept; null: they are not wanted. Throws ConfigError when the file is none
// of MCAP, ReadingEnded when the budget is exhausted.
[[nodiscard]] Bag read_bag(const Config& config, log_common::ScanLog& scans, const Budget& budget,
                           PictureStore* images = nullptr);

}  // namespace cairn::mcap_log
