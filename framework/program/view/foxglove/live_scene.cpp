#include "framework/program/view/foxglove/live_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/reporting/recordings/topics.hpp"
#include "maps/base/base64.hpp"
#include "maps/exchange/recordings/foxglove_json.hpp"
#include "maps/exchange/recordings/foxglove_schemas.hpp"

namespace cairn {
namespace {

namespace foxglove = exchange::foxglove;
using exchange::FoxgloveMessage;

constexpr const char* kFrame = "map";
constexpr const char* kRobot = "base_link";
constexpr int kTileSide = 64;
constexpr int kUnknown = 127;
constexpr int kMaxSide = 1024;
constexpr std::int64_t kMaxCells = std::int64_t{1} << 28;
constexpr double kPathStep_m = 0.03;
constexpr std::size_t kMaxPath = 20'000;
constexpr double kNsPerS = 1e9;

constexpr const char* kAnything = R"({"type":"object"})";
constexpr const char* kRanges =
    R"({"title":"cairn.WatchedRanges","type":"object","properties":{"ranges":{"type":"array","items":{"type":"array"}}}})";
constexpr const char* kTree =
    R"({"title":"cairn.TreeNode","type":"object","properties":{"path":{"type":"string"},"name":{"type":"string"},)"
    R"("kind":{"type":"string"},"state":{"type":"string"},"reason":{"type":"string"}}})";

foxglove_protocol::Channel known(LiveChannel id, const char* topic, FoxgloveMessage message) {
  return {id, topic, "json", name_of(message), schema_of(message), "jsonschema"};
}

double number(const nlohmann::json& value) {
  return value.is_number() ? value.get<double>() : 0.0;
}

std::string scene_text(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Pose2 pose_of(const nlohmann::json& list) {
  return {number(list.at(0)), number(list.at(1)), list.size() > 2 ? number(list.at(2)) : 0.0};
}

std::vector<Pose2> path_of(const nlohmann::json& points) {
  std::vector<Pose2> path;
  for (const nlohmann::json& point : points) path.push_back(pose_of(point));
  return path;
}

Landmark landmark_of(const nlohmann::json& row) {
  Landmark landmark;
  landmark.id = row.at("id").get<LandmarkId>();
  landmark.name = row.at("label").get<std::string>();
  landmark.category = row.at("category").get<std::string>();
  landmark.T_map_landmark = {number(row.at("x")), number(row.at("y")), 0.0};
  landmark.degree = number(row.at("degree"));
  landmark.sightings = row.at("sightings").get<int>();
  return landmark;
}

}  // namespace

std::vector<foxglove_protocol::Channel> LiveScene::channels() {
  return {known(live_map, topics::kMap, FoxgloveMessage::grid),
          known(live_transform, topics::kTransform, FoxgloveMessage::frame_transform),
          known(live_pose, topics::kPose, FoxgloveMessage::pose_in_frame),
          known(live_truth, topics::kTruth, FoxgloveMessage::pose_in_frame),
          known(live_landmarks, topics::kLandmarks, FoxgloveMessage::scene_update),
          known(live_driven, topics::kDrivenPath, FoxgloveMessage::poses_in_frame),
          known(live_plan, topics::kPlan, FoxgloveMessage::poses_in_frame),
          {live_tree, topics::kTree, "json", "cairn.TreeNode", kTree, "jsonschema"},
          known(live_log, topics::kLog, FoxgloveMessage::log),
          {live_ranges, topics::kWatchedRanges, "json", "cairn.WatchedRanges", kRanges, "jsonschema"},
          {live_status, topics::kStatus, "json", "cairn.Status", kAnything, "jsonschema"}};
}

std::vector<LiveMessage> LiveScene::take(const nlohmann::json& line) {
  std::vector<LiveMessage> messages;
  if (line.contains("tree")) name_nodes(line["tree"]);
  if (line.contains("time_s"))
    time_ns_ = static_cast<std::uint64_t>(std::llround(kNsPerS * std::clamp(number(line["time_s"]), 0.0, 9e9)));
  take_map(line, messages);
  take_pose(line, messages);
  take_state(line, messages);
  return messages;
}

void LiveScene::take_map(const nlohmann::json& line, std::vector<LiveMessage>& messages) {
  if (line.value("afresh", false)) {
    tiles_.clear();
    for (const auto& [id, landmark] : std::exchange(landmarks_, {}))
      messages.push_back(message(live_landmarks, foxglove::no_landmark(time_ns_, id)));
  }
  if (line.contains("grid")) {
    cell_m_ = number(line["grid"].at("cell_m"));
    origin_m_ = pose_of(line["grid"].at("origin_m")).position();
    box_ = line["grid"].at("box");
    changed_[live_map] = true;
  }
  for (const nlohmann::json& tile : line.value("tiles", nlohmann::json::array())) {
    std::vector<std::uint8_t> ol = bytes_of_base64(tile.at(2).get_ref<const std::string&>());
    if (ol.size() != std::size_t{kTileSide} * kTileSide) throw std::runtime_error("a tile of another size");
    tiles_[{tile.at(0).get<int>(), tile.at(1).get<int>()}] = std::move(ol);
    changed_[live_map] = true;
  }
  for (const nlohmann::json& row : line.value("landmarks", nlohmann::json::array())) {
    const Landmark landmark = landmark_of(row);
    messages.push_back(message(live_landmarks, foxglove::landmark(time_ns_, kFrame, landmark)));
    landmarks_[landmark.id] = landmark;
  }
  for (const nlohmann::json& id : line.value("retired", nlohmann::json::array()))
    if (landmarks_.erase(id.get<LandmarkId>()) > 0)
      messages.push_back(message(live_landmarks, foxglove::no_landmark(time_ns_, id.get<LandmarkId>())));
}

void LiveScene::take_pose(const nlohmann::json& line, std::vector<LiveMessage>& messages) {
  if (line.contains("driven")) {
    driven_ = path_of(line["driven"]);
    changed_[live_driven] = true;
  }
  const auto tell = [&](LiveChannel channel, std::string text) {
    last_[channel] = text;
    messages.push_back(message(channel, std::move(text)));
  };
  if (line.contains("pose")) {
    const nlohmann::json& pose = line["pose"];
    const Pose2 T_map_robot{number(pose.at("x_m")), number(pose.at("y_m")), number(pose.at("theta_rad"))};
    tell(live_transform, foxglove::frame_transform(time_ns_, kFrame, kRobot, T_map_robot));
    tell(live_pose, foxglove::pose_in_frame(time_ns_, kFrame, T_map_robot));
    drive_to(T_map_robot);
  }
  if (line.contains("truth")) tell(live_truth, foxglove::pose_in_frame(time_ns_, kFrame, pose_of(line["truth"])));
  if (line.contains("plan")) {
    const bool is_over = line["plan"].is_null();
    tell(live_plan, foxglove::poses_in_frame(time_ns_, kFrame,
                                             is_over ? std::vector<Pose2>{} : path_of(line["plan"].at("points"))));
  }
  if (line.contains("ranges")) tell(live_ranges, scene_text(nlohmann::json{{"ranges", line["ranges"]}}));
  if (line.contains("status")) tell(live_status, scene_text(line["status"]));
}

void LiveScene::drive_to(const Pose2& T_map_robot) {
  if (!driven_.empty() && (driven_.back().position() - T_map_robot.position()).norm() < kPathStep_m) return;
  driven_.push_back(T_map_robot);
  changed_[live_driven] = true;
  if (driven_.size() <= kMaxPath) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < driven_.size(); i += 2) driven_[kept++] = driven_[i];
  driven_.resize(kept);
}

void LiveScene::take_state(const nlohmann::json& line, std::vector<LiveMessage>& messages) {
  for (const nlohmann::json& row : line.value("nodes", nlohmann::json::array())) {
    const auto& path = row.at(0).get_ref<const std::string&>();
    Node& node = nodes_[path];
    node.state = row.at(1).get<std::string>();
    node.reason = row.at(2).get<std::string>();
    messages.push_back(message(live_tree, node_text(path)));
  }
  for (const nlohmann::json& row : line.value("log", nlohmann::json::array()))
    messages.push_back(message(
        live_log, foxglove::log(time_ns_, foxglove::LogLevel::info, "cairn", row.at(1).get_ref<const std::string&>())));
}

void LiveScene::name_nodes(const nlohmann::json& tree) {
  for (const nlohmann::json& node : tree) {
    nodes_[node.at("path").get<std::string>()] = {node.at("name").get<std::string>(),
                                                  node.at("kind").get<std::string>(), "", ""};
    name_nodes(node.value("children", nlohmann::json::array()));
  }
}

std::string LiveScene::node_text(const std::string& path) const {
  const Node& node = nodes_.at(path);
  return scene_text(
      {{"path", path}, {"name", node.name}, {"kind", node.kind}, {"state", node.state}, {"reason", node.reason}});
}

std::string LiveScene::map_text() const {
  const int left = box_.at("x").get<int>(), low = box_.at("y").get<int>();
  const int width = box_.at("width").get<int>(), height = box_.at("height").get<int>();
  if (width < 0 || height < 0 || std::int64_t{width} * height > kMaxCells)
    throw std::runtime_error("the map has too many cells to be shown: " + std::to_string(width) + " x " +
                             std::to_string(height));
  foxglove::GridBytes bytes{origin_m_ + cell_m_ * Point(left, low), cell_m_, width, {}};
  bytes.ol.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), kUnknown);
  for (const auto& [at, ol] : tiles_) {
    const int x0 = kTileSide * at.first - left, y0 = kTileSide * at.second - low;
    const int from = std::clamp(x0, 0, width), to = std::clamp(x0 + kTileSide, 0, width);
    for (int y = std::max(y0, 0); y < std::min(y0 + kTileSide, height) && from < to; ++y)
      std::copy_n(ol.begin() + (y - y0) * kTileSide + from - x0, to - from,
                  bytes.ol.begin() + std::ptrdiff_t{y} * width + from);
  }
  return foxglove::grid(time_ns_, kFrame, foxglove::halved_to(kMaxSide, std::move(bytes)));
}

std::vector<LiveMessage> LiveScene::standing(std::uint32_t channel) const {
  std::vector<LiveMessage> messages;
  if (channel == live_map && !box_.is_null()) messages.push_back(message(live_map, map_text()));
  if (channel == live_driven)
    messages.push_back(message(live_driven, foxglove::poses_in_frame(time_ns_, kFrame, driven_)));
  if (channel == live_landmarks)
    for (const auto& [id, landmark] : landmarks_)
      messages.push_back(message(live_landmarks, foxglove::landmark(time_ns_, kFrame, landmark)));
  if (channel == live_tree)
    for (const auto& [path, node] : nodes_)
      if (!node.state.empty()) messages.push_back(message(live_tree, node_text(path)));
  if (const auto last = last_.find(static_cast<LiveChannel>(channel)); last != last_.end())
    messages.push_back(message(last->first, last->second));
  return messages;
}

}  // namespace cairn
