#include "plugins/ros2_robot/display_topics.hpp"

#include <utility>

#include "framework/live/steady_time.hpp"

namespace cairn::ros2_robot {
namespace {

constexpr double kEvery_s = 1.0;  // diagnostics, and landmarks that have changed
constexpr std::size_t kMaxGoals = 8;

bool is_due(std::optional<double>& last_s, double every_s) {
  const double now_s = live::now_s();
  if (last_s && now_s - *last_s < every_s) return false;
  last_s = now_s;
  return true;
}

}  // namespace

void DisplayTopics::open(const Participant& participant) {
  header_.frame = shown_.map_frame;
  const auto writer = [&](const std::string& topic, const dds_topic_descriptor_t& type, Writing writing) {
    return topic.empty() ? Entity() : participant.writer(topic, type, writing);
  };
  map_ = writer(shown_.map, nav_msgs_msg_dds__OccupancyGrid__desc, Writing::latched);
  pose_ = writer(shown_.pose, geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, Writing::passing);
  plan_ = writer(shown_.plan, nav_msgs_msg_dds__Path__desc, Writing::latched);
  landmarks_ = writer(shown_.landmarks, visualization_msgs_msg_dds__MarkerArray__desc, Writing::latched);
  diagnostics_ = writer(shown_.diagnostics, diagnostic_msgs_msg_dds__DiagnosticArray__desc, Writing::passing);
  transforms_ = writer(shown_.tf ? "/tf" : "", tf2_msgs_msg_dds__TFMessage__desc, Writing::passing);
  if (!goal_.empty()) goals_ = participant.reader(goal_, geometry_msgs_msg_dds__PoseStamped__desc, Reading::reliable);
}

void DisplayTopics::observed(const Header& header, const Pose2& T_odom_robot) {
  header_.stamp = header.stamp;
  odom_frame_ = header.frame_id;
  T_odom_robot_ = T_odom_robot;
}

void DisplayTopics::show(const MissionSnapshot& snapshot) {
  const WorldView& world = snapshot.world;
  if (is_read(diagnostics_)) show_diagnostics(snapshot);
  if (world.pose.trust == PoseTrust::lost) return;  // its pose and its map are in no frame that others know
  if (is_read(pose_)) {
    const PoseMessage pose(header_, world.pose);
    (void)dds_write(pose_.get(), &pose.message());
  }
  if (is_read(transforms_)) show_transform(world.pose.T_map_robot);
  if (is_read(plan_)) show_plan(snapshot.path);
  if (is_read(landmarks_)) show_landmarks(world.graph);
  if (is_read(map_)) show_map(world);
}

void DisplayTopics::show_map(const WorldView& world) {
  const bool is_same = map_s_ && world.grid_version != 0 && world.grid_version == map_version_;
  if (is_same || !is_due(map_s_, shown_.map_every_s)) return;
  map_version_ = world.grid_version;
  const MapMessage map(header_, world.grid);
  (void)dds_write(map_.get(), &map.message());
}

void DisplayTopics::show_plan(const std::vector<Pose2>& path) {
  if (path_ == path) return;
  path_ = path;
  const PathMessage plan(header_, path);
  (void)dds_write(plan_.get(), &plan.message());
}

void DisplayTopics::show_landmarks(const LandmarkGraph& landmarks) {
  if (!is_due(landmarks_s_, kEvery_s)) return;
  std::vector<LandmarkMark> marks;
  for (const auto& [id, landmark] : landmarks.landmarks())
    marks.push_back({id, landmark.T_map_landmark, landmark.name + " " + landmark.category});
  if (marks_ == marks) return;
  marks_ = std::move(marks);
  const LandmarksMessage markers(header_, landmarks);
  (void)dds_write(landmarks_.get(), &markers.message());
}

void DisplayTopics::show_diagnostics(const MissionSnapshot& snapshot) {
  if (!is_due(diagnostics_s_, kEvery_s)) return;
  const DiagnosticsMessage diagnostics(header_, snapshot);
  (void)dds_write(diagnostics_.get(), &diagnostics.message());
}

void DisplayTopics::show_transform(const Pose2& T_map_robot) {
  const TransformMessage transform(header_, odom_frame_, T_map_robot * inverse(T_odom_robot_));
  (void)dds_write(transforms_.get(), &transform.message());
}

std::optional<DisplayOrder> DisplayTopics::next_order() {
  if (!goals_) return std::nullopt;
  if (given_.empty())
    take_all<PoseStamped>(goals_.get(), [this](const PoseStamped& goal) {
      if (given_.size() < kMaxGoals) given_.push_back(order_of(goal, goal_, shown_.map_frame));
    });
  if (given_.empty()) return std::nullopt;
  DisplayOrder next = std::move(given_.front());
  given_.erase(given_.begin());
  return next;
}

}  // namespace cairn::ros2_robot
