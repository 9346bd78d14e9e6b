#include "plugins/rosbridge_robot/json_messages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace cairn::rosbridge_robot {
namespace {

using nlohmann::json;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMaxRanges = 65536;
constexpr std::size_t kMaxPoints = 4096;
constexpr std::size_t kMaxFrames = 4096;

// "/pose/pose/position/x" is `pose.pose.position.x`.
std::string field_name(std::string path) {
  path.erase(0, 1);
  std::ranges::replace(path, '/', '.');
  return "`" + path + "`";
}

const json& value_at(const json& msg, const char* path) {
  const json::json_pointer pointer(path);
  if (!msg.is_object() || !msg.contains(pointer)) throw std::runtime_error("it has no " + field_name(path));
  return msg.at(pointer);
}

double number_of(const json& value, const char* path, double null = kNoNumber) {
  if (value.is_null()) return null;
  if (!value.is_number()) throw std::runtime_error("its " + field_name(path) + " is no number");
  return value.get<double>();
}

double number_at(const json& msg, const char* path, double null = kNoNumber) {
  return number_of(value_at(msg, path), path, null);
}

std::string text_at(const json& msg, const char* path) {
  const json& value = value_at(msg, path);
  if (!value.is_string()) throw std::runtime_error("its " + field_name(path) + " is no text");
  return value.get<std::string>();
}

// Old drivers begin it with a slash.
std::string frame_at(const json& msg, const char* path) {
  std::string frame = text_at(msg, path);
  if (frame.starts_with('/')) frame.erase(0, 1);
  return frame;
}

const json& list_at(const json& msg, const char* path, std::size_t most) {
  const json& value = value_at(msg, path);
  if (!value.is_array()) throw std::runtime_error("its " + field_name(path) + " is no list");
  if (value.size() > most) throw std::runtime_error("its " + field_name(path) + " is too long");
  return value;
}

Point point_at(const json& msg, const std::string& path) {
  const double x_m = number_at(msg, (path + "/x").c_str());
  return {x_m, number_at(msg, (path + "/y").c_str())};
}

ros::Quaternion quaternion_at(const json& msg, const std::string& path) {
  const auto part = [&](const char* name) { return number_at(msg, (path + name).c_str()); };
  return {part("/x"), part("/y"), part("/z"), part("/w")};
}

}  // namespace

ros::Header header_in(const json& msg) {
  const json& stamp = value_at(msg, "/header/stamp");
  const bool is_old = stamp.is_object() && stamp.contains("secs");
  const double stamp_s =
      number_at(stamp, is_old ? "/secs" : "/sec") + 1e-9 * number_at(stamp, is_old ? "/nsecs" : "/nanosec");
  if (!std::isfinite(stamp_s)) throw std::runtime_error("its `header.stamp` is no time");
  return {stamp_s, frame_at(msg, "/header/frame_id")};
}

ros::Odometry odometry_in(const json& msg) {
  return {header_in(msg), frame_at(msg, "/child_frame_id"), point_at(msg, "/pose/pose/position"),
          quaternion_at(msg, "/pose/pose/orientation")};
}

ros::Range range_in(const json& msg, double null_m) {
  return {header_in(msg), number_at(msg, "/min_range", 0.0), number_at(msg, "/max_range", 0.0),
          number_at(msg, "/range", null_m)};
}

ros::Scan scan_in(const json& msg, double null_m, std::vector<float>& ranges_m) {
  ranges_m.clear();
  for (const json& range : list_at(msg, "/ranges", kMaxRanges))
    ranges_m.push_back(static_cast<float>(number_of(range, "/ranges", null_m)));
  return {header_in(msg),
          number_at(msg, "/angle_min"),
          number_at(msg, "/angle_increment"),
          number_at(msg, "/range_min", 0.0),
          number_at(msg, "/range_max", 0.0),
          ranges_m};
}

std::vector<Point> points_in(const json& msg) {
  std::vector<Point> points_m;
  for (const json& point : list_at(msg, "/points", kMaxPoints)) points_m.push_back(point_at(point, ""));
  return points_m;
}

ros::Imu imu_in(const json& msg) {
  const json& covariance = list_at(msg, "/orientation_covariance", 9);
  const bool has_none = !covariance.empty() && number_of(covariance[0], "/orientation_covariance") < 0.0;
  return {quaternion_at(msg, "/orientation"), !has_none};
}

ros::MagneticField field_in(const json& msg) {
  return {number_at(msg, "/magnetic_field/x"), number_at(msg, "/magnetic_field/y")};
}

double percentage_in(const json& msg) {
  return number_at(msg, "/percentage");
}

bool bool_in(const json& msg) {
  const json& value = value_at(msg, "/data");
  if (!value.is_boolean()) throw std::runtime_error("its `data` is neither true nor false");
  return value.get<bool>();
}

std::vector<FrameIn> frames_in(const json& msg) {
  std::vector<FrameIn> frames;
  for (const json& one : list_at(msg, "/transforms", kMaxFrames)) {
    const auto number = [&](const char* path) { return number_at(one, path); };
    const ros::Quaternion q = quaternion_at(one, "/transform/rotation");
    frames.push_back({frame_at(one, "/header/frame_id"), frame_at(one, "/child_frame_id"),
                      Eigen::Vector3d(number("/transform/translation/x"), number("/transform/translation/y"),
                                      number("/transform/translation/z")),
                      Eigen::Quaterniond(q.w, q.x, q.y, q.z)});
  }
  return frames;
}

std::string type_name(const std::string& type, int ros) {
  const std::size_t slash = type.find('/');
  return ros == 1 ? type : type.substr(0, slash) + "/msg" + type.substr(slash);
}

std::string advertise_text(const std::string& topic, const std::string& type) {
  return json{{"op", "advertise"}, {"id", "cairn:" + topic}, {"topic", topic}, {"type", type}}.dump();
}

std::string subscribe_text(const std::string& topic, const std::string& type, int queue_length, int throttle_ms) {
  return json{{"op", "subscribe"},
              {"id", "cairn:" + topic},
              {"topic", topic},
              {"type", type},
              {"compression", "none"},
              {"queue_length", queue_length},
              {"throttle_rate", throttle_ms}}
      .dump();
}

std::string unsubscribe_text(const std::string& topic) {
  return json{{"op", "unsubscribe"}, {"id", "cairn:" + topic}, {"topic", topic}}.dump();
}

std::string call_text(const std::string& id, const std::string& service, const std::string& topic) {
  json call{{"op", "call_service"}, {"id", id}, {"service", service}, {"args", json::object()}};
  if (!topic.empty()) call["args"]["topic"] = topic;
  return call.dump();
}

std::string velocity_text(const CommandTopic& command, const Twist& twist) {
  const auto vector = [](double x, double z) { return json{{"x", x}, {"y", 0.0}, {"z", z}}; };
  json msg{{"linear", vector(twist.v_mps, 0.0)}, {"angular", vector(0.0, twist.w_radps)}};
  if (command.kind == CommandKind::twist_stamped)
    msg = {{"header", {{"frame_id", command.frame}}}, {"twist", std::move(msg)}};
  return json{{"op", "publish"}, {"topic", command.topic}, {"msg", std::move(msg)}}.dump();
}

}  // namespace cairn::rosbridge_robot
