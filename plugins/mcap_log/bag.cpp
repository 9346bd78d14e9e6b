#include "plugins/mcap_log/bag.hpp"

#include <algorithm>
#include <functional>

#include "maps/exchange/recordings/mcap_reader.hpp"
#include "plugins/common/logs/log_text.hpp"

namespace cairn::mcap_log {
namespace {

using exchange::McapChannel;
using exchange::McapEnding;
using exchange::McapMessage;

constexpr double kNsPerS = 1e9;

class BagReader {
 public:
  BagReader(const Config& config, log_common::ScanLog& scans, PictureStore* images)
      : config_(config), scans_(scans), images_(images) {}

  Bag read(const Budget& budget);

 private:
  using Take = std::function<void(const McapMessage&)>;

  void introduce(const McapChannel& channel);
  [[nodiscard]] Take taker_of(const std::string& topic, std::string_view type);
  [[nodiscard]] Take image_taker_of(const std::string& topic, std::string_view type);
  template <class Message>
  Take into(std::vector<Timed<Message>>& messages, Message (*decode)(std::string_view));
  [[nodiscard]] Moment moment_of(std::int64_t stamp_ns, const McapMessage& message) const;
  void bad(std::uint64_t offset, const std::string& what) const {
    scans_.bad_line(ConfigError({config_.file.string(), 0, 0}, "byte " + std::to_string(offset) + ": " + what));
  }

  const Config& config_;
  log_common::ScanLog& scans_;
  PictureStore* images_;
  Bag bag_;
  std::map<std::uint16_t, Take> takers_;  // by channel
  std::size_t order_ = 0;
};

bool is_wanted(const std::vector<std::string>& names, const std::string& topic) {
  return names.empty() || std::ranges::find(names, topic) != names.end();
}

Moment BagReader::moment_of(std::int64_t stamp_ns, const McapMessage& message) const {
  const bool is_header = config_.stamp == Stamp::header && stamp_ns != 0;
  return {order_, (is_header ? static_cast<double>(stamp_ns) : static_cast<double>(message.log_time_ns)) / kNsPerS, 0};
}

template <class Message>
BagReader::Take BagReader::into(std::vector<Timed<Message>>& messages, Message (*decode)(std::string_view)) {
  return [this, &messages, decode](const McapMessage& message) {
    Message content = decode(message.data);
    const Moment at = moment_of(content.header.stamp_ns, message);
    messages.push_back({at, message.offset, std::move(content)});
  };
}

BagReader::Take BagReader::taker_of(const std::string& topic, std::string_view type) {
  const auto named = [&](const std::string& setting) { return setting.empty() || setting == topic; };
  if (type == "sensor_msgs/msg/Range" && is_wanted(config_.ranges, topic))
    return into(bag_.ranges[topic], ros2::read_range);
  if (type == "sensor_msgs/msg/LaserScan" && is_wanted(config_.ranges, topic))
    return into(bag_.scans[topic], ros2::read_laser_scan);
  if (type == "nav_msgs/msg/Odometry" && named(config_.odometry))
    return into(bag_.odometry[topic], ros2::read_odometry);
  if (type == "sensor_msgs/msg/Imu" && config_.compass == topic) return into(bag_.compasses[topic], ros2::read_imu);
  if (type == "tf2_msgs/msg/TFMessage")
    return [this, &into = bag_.transforms[topic]](const McapMessage& message) {
      for (ros2::TransformMessage& transform : ros2::read_tf(message.data)) {
        const Moment at = moment_of(transform.header.stamp_ns, message);
        into.push_back({at, message.offset, std::move(transform)});
      }
    };
  return image_taker_of(topic, type);
}

BagReader::Take BagReader::image_taker_of(const std::string& topic, std::string_view type) {
  const bool is_compressed = type == "sensor_msgs/msg/CompressedImage";
  const bool is_image = is_compressed || type == "sensor_msgs/msg/Image";
  const bool is_named =
      config_.images.empty() || std::ranges::find(config_.images, topic, &ImageTopic::topic) != config_.images.end();
  if (images_ == nullptr || !is_image || !is_named) return {};
  return [this, is_compressed, &into = bag_.images[topic]](const McapMessage& message) {
    const auto take = [&](const auto& content) {
      const Moment at = moment_of(content.header.stamp_ns, message);
      into.push_back({at, message.offset, images_->add(content)});
    };
    if (is_compressed)
      take(ros2::read_compressed_image(message.data));
    else
      take(ros2::read_image(message.data));
  };
}

void BagReader::introduce(const McapChannel& channel) {
  const std::string topic(channel.topic);
  std::string type(channel.schema.empty() ? "messages without a type" : channel.schema);
  const bool is_cdr = channel.encoding == "cdr";
  takers_[channel.id] = is_cdr ? taker_of(topic, type) : Take{};
  bag_.types[topic] = is_cdr ? type : type + " in " + std::string(channel.encoding);
}

Bag BagReader::read(const Budget& budget) {
  log_common::LogBytes bytes(config_.file, budget);
  exchange::McapHandlers handlers;
  handlers.channel = [&](const McapChannel& channel) { introduce(channel); };
  handlers.message = [&](const McapMessage& message) {
    ++order_;
    const Take& take = takers_[message.channel];
    if (!take) return;
    try {
      take(message);
    } catch (const ros2::MessageError& error) {
      bad(message.offset, error.what());
    }
  };
  handlers.damaged = [&](std::uint64_t offset, const std::string& what) { bad(offset, what); };
  handlers.look = [&] { log_common::check_budget(budget, config_.file.string()); };
  try {
    const auto ending = read_mcap([&](char* to, std::size_t count) { return bytes.read(to, count); }, handlers);
    if (!bytes.damage().empty()) scans_.bad_line(ConfigError({config_.file.string(), 0, 0}, bytes.damage()));
    if (ending == McapEnding::cut) scans_.note("the file ends early: it was read up to its last whole chunk");
  } catch (const exchange::McapError& error) {
    throw log_common::RefusedLine({config_.file.string(), 0, 0},
                                  bytes.damage().empty() ? error.what() : bytes.damage());
  }
  return std::move(bag_);
}

}  // namespace

Bag read_bag(const Config& config, log_common::ScanLog& scans, const Budget& budget, PictureStore* images) {
  return BagReader(config, scans, images).read(budget);
}

}  // namespace cairn::mcap_log
