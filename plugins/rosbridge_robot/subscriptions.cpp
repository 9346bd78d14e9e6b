#include "plugins/rosbridge_robot/subscriptions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "plugins/rosbridge_robot/json_messages.hpp"

namespace cairn::rosbridge_robot {
namespace {

using nlohmann::json;

constexpr double kAskAgainAfter_s = 2.0;
constexpr const char* kBool = "std_msgs/Bool";
constexpr int kKeptFrames = 100;  // messages of static frames, each said once

const char* type_of(ros::RangeKind kind) {
  switch (kind) {
    case ros::RangeKind::range:
      return "sensor_msgs/Range";
    case ros::RangeKind::laser:
      return "sensor_msgs/LaserScan";
    case ros::RangeKind::point_cloud:
      return "sensor_msgs/PointCloud";
    case ros::RangeKind::point_cloud2:
      break;
  }
  return "sensor_msgs/PointCloud2";
}

double null_m_of(NullRange null_range) {
  return null_range == NullRange::no_echo ? std::numeric_limits<double>::infinity()
                                          : std::numeric_limits<double>::quiet_NaN();
}

// Of messages that have a header in some versions of their drivers' bridges.
ros::Header header_or_none(const json& msg) {
  return msg.is_object() && msg.contains("header") ? header_in(msg) : ros::Header{};
}

}  // namespace

Subscriptions::Subscriptions(const Config& config, ros::RobotObserver& observer)
    : config_(config), observer_(observer) {
  add(config.odometry, "nav_msgs/Odometry", true,
      [this](const json& msg, double arrived_s) { observed_ = observer_.take(odometry_in(msg), arrived_s); });
  add_ranges();
  const bool is_imu = config.compass.kind == ros::CompassKind::imu;
  add(config.compass.topic, is_imu ? "sensor_msgs/Imu" : "sensor_msgs/MagneticField", true,
      [this, is_imu](const json& msg, double arrived_s) {
        const double offset_rad = config_.compass.offset_rad;
        observer_.take_compass(
            header_in(msg),
            is_imu ? ros::compass_rad(imu_in(msg), offset_rad) : ros::compass_rad(field_in(msg), offset_rad),
            arrived_s);
      });
  add(config.battery, "sensor_msgs/BatteryState", false, [this](const json& msg, double arrived_s) {
    observer_.take_battery(header_or_none(msg), percentage_in(msg), arrived_s);
  });
  for (std::size_t i = 0; i < config.bumpers.size(); ++i)
    add(config.bumpers[i], kBool, false,
        [this, i](const json& msg, double arrived_s) { observer_.take_bumper(i, bool_in(msg), arrived_s); });
  add(config.emergency, kBool, false,
      [this](const json& msg, double arrived_s) { observer_.take_emergency(bool_in(msg), arrived_s); });
  add(config.static_frames, "tf2_msgs/TFMessage", false, [this](const json& msg, double arrived_s) {
    observer_.heard().add(config_.static_frames, arrived_s);
    for (const FrameIn& frame : frames_in(msg))
      observer_.take_frame(frame.parent, frame.child, frame.position_m, frame.rotation);
  });
  if (!config.static_frames.empty()) topics_.back().queue_length = kKeptFrames;
}

void Subscriptions::add(const std::string& name, const std::string& type, bool is_steady,
                        std::function<void(const json&, double)> take) {
  if (!name.empty())
    topics_.push_back({name, type_name(type, config_.ros), 1, 0, is_steady, type != kBool, std::move(take)});
}

void Subscriptions::add_ranges() {
  for (const ros::RangeTopic& range : config_.ranges) {
    add(range.topic, type_of(range.kind), true, [this, &range](const json& msg, double arrived_s) {
      const double null_m = null_m_of(config_.null_range);
      if (range.kind == ros::RangeKind::range)
        observer_.take(range, range_in(msg, null_m), arrived_s);
      else if (range.kind == ros::RangeKind::laser)
        observer_.take(range, scan_in(msg, null_m, ranges_m_), arrived_s);
      else
        observer_.take(range, header_in(msg), points_in(msg), arrived_s);
    });
    // Sonars of one topic may come in one burst.
    topics_.back().queue_length = std::max<int>(1, static_cast<int>(range.frames.size()));
    if (range.kind == ros::RangeKind::laser) topics_.back().throttle_ms = config_.scan_every_ms;
  }
}

std::vector<std::string> Subscriptions::requests(double now_s) {
  std::vector<std::string> texts;
  for (Topic& topic : topics_) {
    topic.asked_s = now_s;
    topic.is_heard = false;
    texts.push_back(subscribe_text(topic.name, topic.type, topic.queue_length, topic.throttle_ms));
  }
  return texts;
}

std::vector<std::string> Subscriptions::repeated_requests(double now_s) {
  std::vector<std::string> texts;
  for (Topic& topic : topics_) {
    if (topic.is_heard || !topic.is_asked_again || now_s - topic.asked_s < kAskAgainAfter_s) continue;
    topic.asked_s = now_s;
    texts.push_back(unsubscribe_text(topic.name));
    texts.push_back(subscribe_text(topic.name, topic.type, topic.queue_length, topic.throttle_ms));
  }
  return texts;
}

std::optional<Observation> Subscriptions::take(const std::string& name, const json& msg, double arrived_s) {
  observed_.reset();
  for (Topic& topic : topics_) {
    if (topic.name != name) continue;
    topic.is_heard = true;
    try {
      topic.take(msg, arrived_s);
    } catch (const std::runtime_error& error) {
      const std::string why = error.what();
      if (why.find(name) != std::string::npos) throw;
      throw std::runtime_error(fmt::format("{}: {}", name, why));
    }
  }
  return std::exchange(observed_, std::nullopt);
}

}  // namespace cairn::rosbridge_robot
