#include "plugins/mcap_log/topics.hpp"

#include <algorithm>

#include "maps/base/text.hpp"

namespace cairn::mcap_log {
namespace {

constexpr std::string_view kNone = "none";
constexpr std::size_t kMaxNamed = 40;

[[noreturn]] void refuse(const Config& config, const std::string& sentence, const Bag& bag) {
  throw ConfigError({config.file.string(), 0, 0}, sentence + ". Its topics: " + shown_topics(bag));
}

template <class Message>
std::vector<std::string> names_of(const Topics<Message>& topics) {
  std::vector<std::string> names;
  for (const auto& [name, messages] : topics) names.push_back(name);
  return names;
}

std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

// setting: where the name is from; types: what can be read there.
void check(const Config& config, const Bag& bag, const std::string& setting, const std::string& topic, bool is_read,
           const std::string& types) {
  if (is_read) return;
  const auto found = bag.types.find(topic);
  if (found != bag.types.end())
    refuse(config, setting + ": " + in_quotes(topic) + " is of " + found->second + ", not of " + types, bag);
  std::vector<std::string> all;
  for (const auto& [name, type] : bag.types) all.push_back(name);
  refuse(config, setting + ": the log has no topic " + in_quotes(topic) + did_you_mean(topic, all), bag);
}

std::vector<std::string> chosen_ranges(const Config& config, const Bag& bag) {
  for (const std::string& topic : config.ranges)
    check(config, bag, "ranges", topic, bag.ranges.contains(topic) || bag.scans.contains(topic),
          "sensor_msgs/msg/Range or LaserScan");
  if (!config.ranges.empty()) return config.ranges;
  if (bag.ranges.empty() && bag.scans.empty()) refuse(config, "the log has no topic of ranges", bag);
  if (bag.scans.empty()) return names_of(bag.ranges);
  if (bag.scans.size() == 1 && bag.ranges.empty()) return names_of(bag.scans);
  std::vector<std::string> all = names_of(bag.scans);
  for (const std::string& name : names_of(bag.ranges)) all.push_back(name);
  refuse(config, "ranges of several kinds or lasers; choose by `ranges` among " + listed(all), bag);
}

// The topic that has transforms from the odometry's frame; empty: none.
std::string moving_transforms(const Config& config, const Bag& bag) {
  for (const auto& [name, transforms] : bag.transforms)
    if (std::ranges::any_of(
            transforms, [&](const auto& transform) { return transform.message.header.frame == config.odometry_frame; }))
      return name;
  return {};
}

void choose_odometry(const Config& config, const Bag& bag, ChosenTopics& chosen) {
  if (config.odometry == kNone) return;
  if (!config.odometry.empty()) {
    const bool is_of_transforms = bag.transforms.contains(config.odometry);
    check(config, bag, "odometry", config.odometry, is_of_transforms || bag.odometry.contains(config.odometry),
          "nav_msgs/msg/Odometry or tf2_msgs/msg/TFMessage");
    (is_of_transforms ? chosen.transforms : chosen.odometry) = config.odometry;
    return;
  }
  if (bag.odometry.size() > 1)
    refuse(config, "several topics of odometry; choose by `odometry` among " + listed(names_of(bag.odometry)), bag);
  if (!bag.odometry.empty()) {
    chosen.odometry = bag.odometry.begin()->first;
    return;
  }
  chosen.transforms = moving_transforms(config, bag);
  if (chosen.transforms.empty())
    refuse(config,
           "the log has no topic of nav_msgs/msg/Odometry and no transforms from frame " +
               in_quotes(config.odometry_frame) +
               "; set odometry_frame, or `odometry: none` for a localizer that needs none (scan_to_map)",
           bag);
}

// Nothing has been read of them when they are not wanted.
std::vector<ImageTopic> chosen_images(const Config& config, const Bag& bag, bool wants_images) {
  if (!wants_images) return {};
  for (const ImageTopic& image : config.images)
    check(config, bag, "images", image.topic, bag.images.contains(image.topic),
          "sensor_msgs/msg/Image or CompressedImage");
  if (!config.images.empty() || bag.images.empty()) return config.images;
  if (bag.images.size() > 1)
    refuse(config, "several topics of pictures; choose by `images` among " + listed(names_of(bag.images)), bag);
  return {{bag.images.begin()->first, 0}};
}

}  // namespace

std::string shown_topics(const Bag& bag) {
  std::string text;
  std::size_t named = 0;
  for (const auto& [name, type] : bag.types) {
    if (named++ == kMaxNamed) return text + ", ...";
    text.append(text.empty() ? "" : ", ").append(name).append(" (").append(type).append(")");
  }
  return text.empty() ? "none" : text;
}

ChosenTopics chosen_topics(const Config& config, const Bag& bag, bool wants_images) {
  ChosenTopics chosen;
  chosen.images = chosen_images(config, bag, wants_images);
  chosen.ranges = chosen_ranges(config, bag);
  choose_odometry(config, bag, chosen);
  if (!config.compass.empty())
    check(config, bag, "compass", config.compass, bag.compasses.contains(config.compass), "sensor_msgs/msg/Imu");
  return chosen;
}

}  // namespace cairn::mcap_log
