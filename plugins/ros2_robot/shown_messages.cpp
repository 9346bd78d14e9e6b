#include "plugins/ros2_robot/shown_messages.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace cairn::ros2_robot {
namespace {

constexpr int kSphere = 2;
constexpr int kTextFacingTheView = 9;
constexpr int kDeleteAll = 3;
constexpr double kBall_m = 0.2;
constexpr double kLetters_m = 0.25;
constexpr std::uint8_t kUnknownCell = 0xFF;  // -1
constexpr std::uint8_t kOk = 0;
constexpr std::uint8_t kWarn = 1;
char kNothing[] = "";

geometry_msgs_msg_dds__Pose_ message_of(const Pose2& pose) {
  return {{pose.x_m, pose.y_m, 0.0}, {0.0, 0.0, std::sin(0.5 * pose.theta_rad), std::cos(0.5 * pose.theta_rad)}};
}

// What is in the middle of both thresholds is unknown, as it is to planners.
std::array<std::uint8_t, 256> per_cent_of_ol() {
  std::array<std::uint8_t, 256> table{};
  const OccupancyThresholds thresholds;
  const int free_below = ol_of(thresholds.free_below);
  const int occupied_above = ol_of(thresholds.occupied_above);
  for (int ol = 0; ol < 256; ++ol)
    table[static_cast<std::size_t>(ol)] = ol >= free_below && ol <= occupied_above
                                              ? kUnknownCell
                                              : static_cast<std::uint8_t>(std::lround(100.0 * ol / 255.0));
  return table;
}

// DDS takes plain sequences; it neither keeps nor frees them.
template <class Sequence, class Element>
void point_to(Sequence& sequence, std::vector<Element>& elements) {
  sequence._maximum = sequence._length = static_cast<std::uint32_t>(elements.size());
  sequence._buffer = elements.data();
  sequence._release = false;
}

std::string name_of(const Landmark& landmark) {
  const std::string id = landmark.name.empty() ? "L" + std::to_string(landmark.id) : landmark.name;
  return landmark.category.empty() ? id : id + " " + landmark.category;
}

}  // namespace

bool is_in_frame(const Header& header, const std::string& frame) {
  const std::string said = header.frame_id == nullptr ? "" : header.frame_id;
  return said.empty() || said == frame || said == "/" + frame;
}

DisplayOrder order_of(const PoseStamped& goal, const std::string& topic, const std::string& map_frame) {
  if (!is_in_frame(goal.header, map_frame))
    return {"", fmt::format("the goal on {} is in the frame {}, and the map in {}", topic, goal.header.frame_id,
                            map_frame)};
  const std::optional<Pose2> pose = pose_of(goal.pose);
  if (!pose) return {"", fmt::format("the goal on {} is no pose", topic)};
  return {fmt::format(R"({{"goto":{{"at_m":[{:.4f},{:.4f}],"angle_deg":{:.2f}}}}})", pose->x_m, pose->y_m,
                      degrees(pose->theta_rad)),
          ""};
}

MapMessage::MapMessage(const ShownHeader& header, const OccupancyGrid& grid) : frame_(header.frame) {
  static const std::array<std::uint8_t, 256> kPerCent = per_cent_of_ol();
  message_.header = {header.stamp, frame_.data()};
  const CellBox box = grid.bounds();
  message_.info.map_load_time = header.stamp;
  message_.info.resolution = static_cast<float>(grid.cell_m());
  message_.info.origin = message_of(Pose2{});
  if (std::int64_t{box.width()} * box.height() > kMaxCells) return;
  cells_.resize(static_cast<std::size_t>(box.width()) * static_cast<std::size_t>(box.height()));
  grid.copy_ol(box, cells_);
  for (std::uint8_t& cell : cells_) cell = kPerCent[cell];
  message_.info.width = static_cast<std::uint32_t>(box.width());
  message_.info.height = static_cast<std::uint32_t>(box.height());
  message_.info.origin.position.x = grid.origin_m().x() + grid.cell_m() * box.min.x;
  message_.info.origin.position.y = grid.origin_m().y() + grid.cell_m() * box.min.y;
  point_to(message_.data, cells_);
}

PoseMessage::PoseMessage(const ShownHeader& header, const PoseEstimate& pose) : frame_(header.frame) {
  constexpr std::array<std::size_t, 3> kRows{0, 1, 5};  // x, y, yaw of x, y, z, roll, pitch, yaw
  message_.header = {header.stamp, frame_.data()};
  message_.pose.pose = message_of(pose.T_map_robot);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      message_.pose.covariance[6 * kRows[row] + kRows[column]] =
          pose.covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
}

PathMessage::PathMessage(const ShownHeader& header, const std::vector<Pose2>& path) : frame_(header.frame) {
  const Header each{header.stamp, frame_.data()};
  for (const Pose2& pose : path) poses_.push_back({each, message_of(pose)});
  message_.header = each;
  point_to(message_.poses, poses_);
}

LandmarksMessage::LandmarksMessage(const ShownHeader& header, const LandmarkGraph& landmarks) : frame_(header.frame) {
  static char balls[] = "landmarks";
  static char names[] = "names";
  Marker marker{};
  marker.header = {header.stamp, frame_.data()};
  marker.ns = marker.texture_resource = marker.text = marker.mesh_resource = kNothing;
  marker.texture.header.frame_id = marker.texture.format = marker.mesh_file.filename = kNothing;
  marker.pose = message_of(Pose2{});
  marker.action = kDeleteAll;
  markers_.push_back(marker);
  marker.action = 0;
  for (const auto& [id, landmark] : landmarks.landmarks()) {
    marker.id = static_cast<std::int32_t>(id);
    marker.pose = message_of(landmark.T_map_landmark);
    marker.ns = balls;
    marker.type = kSphere;
    marker.scale = {kBall_m, kBall_m, kBall_m};
    marker.color = {0.1F, 0.4F, 0.9F, 1.0F};
    marker.text = kNothing;
    markers_.push_back(marker);
    marker.ns = names;
    marker.type = kTextFacingTheView;
    marker.scale = {0.0, 0.0, kLetters_m};
    marker.pose.position.z = 2.0 * kBall_m;
    marker.color = {0.9F, 0.9F, 0.9F, 1.0F};
    marker.text = texts_.emplace_back(name_of(landmark)).data();
    markers_.push_back(marker);
  }
  point_to(message_.markers, markers_);
}

DiagnosticsMessage::DiagnosticsMessage(const ShownHeader& header, const MissionSnapshot& snapshot)
    : frame_(header.frame), doing_(snapshot.doing) {
  static char name[] = "cairn: mission";
  static char hardware[] = "cairn";
  const WorldView& world = snapshot.world;
  const bool is_lost = world.pose.trust == PoseTrust::lost;
  texts_ = {{"pose", is_lost ? "lost" : "tracking"},
            {"time_s", fmt::format("{:.1f}", world.time_s)},
            {"landmarks", std::to_string(world.graph.landmarks().size())},
            {"v_mps", fmt::format("{:.3f}", snapshot.commanded.v_mps)},
            {"w_radps", fmt::format("{:.3f}", snapshot.commanded.w_radps)},
            {"speed_reduction_ratio", fmt::format("{:.2f}", world.speed_reduction_ratio)}};
  if (world.observation != nullptr && world.observation->battery_ratio)
    texts_.emplace_back("battery_ratio", fmt::format("{:.2f}", *world.observation->battery_ratio));
  for (auto& [key, value] : texts_) values_.push_back({key.data(), value.data()});
  status_.level = is_lost || world.speed_reduction_ratio >= 1.0 ? kWarn : kOk;
  status_.name = name;
  status_.message = doing_.data();
  status_.hardware_id = hardware;
  point_to(status_.values, values_);
  message_.header = {header.stamp, frame_.data()};
  message_.status = {1, 1, &status_, false};
}

TransformMessage::TransformMessage(const ShownHeader& header, const std::string& child_frame,
                                   const Pose2& T_frame_child)
    : frame_(header.frame), child_frame_(child_frame) {
  const geometry_msgs_msg_dds__Pose_ pose = message_of(T_frame_child);
  transform_.header = {header.stamp, frame_.data()};
  transform_.child_frame_id = child_frame_.data();
  transform_.transform = {{pose.position.x, pose.position.y, 0.0}, pose.orientation};
  message_.transforms = {1, 1, &transform_, false};
}

}  // namespace cairn::ros2_robot
