#include "framework/reporting/recordings/mcap_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/reporting/event_sentences.hpp"
#include "framework/reporting/recordings/recording_errors.hpp"
#include "framework/reporting/recordings/scan_rays.hpp"
#include "framework/reporting/recordings/topics.hpp"
#include "maps/exchange/recordings/foxglove_json.hpp"
#include "maps/exchange/recordings/foxglove_schemas.hpp"
#include "maps/exchange/recordings/ros2_messages.hpp"

namespace cairn {
namespace {

namespace foxglove = exchange::foxglove;
namespace ros2 = exchange::ros2;
using exchange::FoxgloveMessage;

constexpr std::string_view kMapFrame = "map";
constexpr std::string_view kOdometryFrame = "odom";
constexpr std::string_view kRobotFrame = "base_link";
constexpr double kNsPerS = 1e9;
constexpr int kMaxGridSide = 1024;
constexpr double kGridEvery_s = 1.0;
constexpr double kCellsPerSecond = 1e5;  // of grids, on average

constexpr std::string_view kRangesSchema =
    R"({"title":"cairn.Ranges","type":"object","properties":{"ranges":{"type":"array","items":{"type":"object",)"
    R"("properties":{"sensor":{"type":"integer"},"state":{"enum":["echo","no_echo","too_near","bad"]},)"
    R"("range_m":{"type":["number","null"]},"x_m":{"type":"number"},"y_m":{"type":"number"},)"
    R"("angle_rad":{"type":"number"},"half_beam_rad":{"type":"number"},"min_m":{"type":"number"},)"
    R"("max_m":{"type":"number"}},"required":["sensor","state","range_m"]}},"bumped":{"type":"boolean"}},)"
    R"("required":["ranges","bumped"]})";
constexpr std::string_view kPlanSchema =
    R"({"title":"cairn.PlanResult","type":"object","properties":{"outcome":{"type":"string"},)"
    R"("reason":{"type":"string"},"cost_m":{"type":"number"},"length_m":{"type":"number"},)"
    R"("clearance_m":{"type":"number"},"landmarks":{"type":"array","items":{"type":"integer"}}},)"
    R"("required":["outcome","reason"]})";
constexpr std::string_view kTreeSchema =
    R"({"title":"cairn.TreeNode","type":"object","properties":{"path":{"type":"string"},"name":{"type":"string"},)"
    R"("kind":{"type":"string"},"state":{"enum":["running","success","failure","halted"]},)"
    R"("reason":{"type":"string"}},"required":["path","name","kind","state","reason"]})";

std::string text_of(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

double finite(double value) {
  return std::isfinite(value) ? value : 0.0;
}

std::string_view state_of(double range_m) {
  if (std::isnan(range_m)) return "bad";
  if (std::isfinite(range_m)) return "echo";
  return range_m > 0.0 ? "no_echo" : "too_near";
}

std::string ranges_text(const Observation& observation) {
  std::string text = R"({"ranges":[)";
  std::string_view separator;
  for (const RangeReading& reading : observation.ranges) {
    const Pose2& pose = reading.T_robot_sensor;
    text += fmt::format(
        R"({}{{"sensor":{},"state":"{}","range_m":{},"x_m":{},"y_m":{},"angle_rad":{},"half_beam_rad":{},"min_m":{},)"
        R"("max_m":{}}})",
        separator, reading.sensor, state_of(reading.range_m),
        std::isfinite(reading.range_m) ? fmt::format("{}", reading.range_m) : "null", finite(pose.x_m),
        finite(pose.y_m), finite(pose.theta_rad), finite(reading.half_beam_rad), finite(reading.min_m),
        finite(reading.max_m));
    separator = ",";
  }
  return text + R"(],"bumped":)" + (observation.bumped ? "true}" : "false}");
}

// None: these are not one laser's rays.
std::optional<foxglove::Scan> scan_of(const std::vector<RangeReading>& ranges) {
  if (ranges.size() < 2 || rays_of_a_scan(ranges) < ranges.size()) return std::nullopt;
  const Pose2& T_robot_first = ranges[0].T_robot_sensor;
  const double step_rad = wrap_angle(ranges[1].T_robot_sensor.theta_rad - T_robot_first.theta_rad);
  foxglove::Scan scan{T_robot_first, 0.0, step_rad * static_cast<double>(ranges.size() - 1), {}};
  for (const RangeReading& ray : ranges) scan.ranges_m.push_back(ray.range_m);
  return scan;
}

struct NodeMessage {
  std::string path;
  std::string name;
  std::string_view kind;
  std::string_view state;
  std::string reason;
};

std::string_view state_of(const Status& status, bool is_halted) {
  if (is_halted) return "halted";
  return status.state == StepState::success ? "success" : "failure";
}

std::optional<NodeMessage> node_of(const Event& event) {
  if (const auto* const begun = std::get_if<StepStarted>(&event))
    return NodeMessage{std::to_string(begun->index + 1), begun->name, "step", "running", ""};
  if (const auto* const ended = std::get_if<StepEnded>(&event))
    return NodeMessage{std::to_string(ended->index + 1), ended->name, "step", state_of(ended->status, false),
                       ended->status.reason};
  if (const auto* const begun = std::get_if<NodeStarted>(&event))
    return NodeMessage{begun->path, begun->name, name_of(begun->kind), "running", ""};
  if (const auto* const ended = std::get_if<NodeEnded>(&event))
    return NodeMessage{ended->path, ended->name, name_of(ended->kind), state_of(ended->status, ended->is_halted),
                       ended->status.reason};
  return std::nullopt;
}

std::string plan_text(const PlanResult& plan) {
  return text_of({{"outcome", name_of(plan.outcome)},
                  {"reason", plan.reason},
                  {"cost_m", finite(plan.cost_m)},
                  {"length_m", finite(plan.length_m)},
                  {"clearance_m", finite(plan.clearance_m)},
                  {"landmarks", plan.landmarks}});
}

// What comes at a moment that differs from run to run.
bool is_of_the_wall_clock(const Event& event) {
  return std::holds_alternative<Autosaved>(event) || std::holds_alternative<AutosaveFailed>(event) ||
         std::holds_alternative<Stalled>(event);
}

foxglove::LogLevel level_of(const Event& event) {
  const bool is_warning = std::holds_alternative<Bumped>(event) || std::holds_alternative<RobotStopped>(event) ||
                          std::holds_alternative<WentDeaf>(event);
  return is_warning ? foxglove::LogLevel::warning : foxglove::LogLevel::info;
}

std::uint64_t ns_of(double time_s) {
  constexpr double kMax = 9e18;
  return time_s > 0.0 ? static_cast<std::uint64_t>(std::llround(std::min(kNsPerS * time_s, kMax))) : 0;
}

}  // namespace

McapRecording::McapRecording(const std::filesystem::path& file)
    : file_name_(file.string()),
      out_(in_recording(file_name_, [&] { return GrowingFile(file); })),
      writer_([this](std::string_view bytes) {  // in large pieces: a run that is killed loses its last chunk only
        out_.append(bytes);
        out_.flush();
      }),
      topics_(add_topics()) {}

McapRecording::Topics McapRecording::add_topics() {
  const auto json = [&](std::string_view topic, FoxgloveMessage message) {
    return writer_.add_channel(topic, writer_.add_schema(name_of(message), "jsonschema", schema_of(message)), "json");
  };
  const auto own = [&](std::string_view topic, std::string_view name, std::string_view schema) {
    return writer_.add_channel(topic, writer_.add_schema(name, "jsonschema", schema), "json");
  };
  const auto ros = [&](std::string_view topic, ros2::Message message) {
    return writer_.add_channel(
        topic, writer_.add_schema(ros2::name_of(message), "ros2msg", ros2::definition_of(message)), "cdr");
  };
  Topics topics{};
  topics.pose = json(topics::kPose, FoxgloveMessage::pose_in_frame);
  topics.transform = json(topics::kTransform, FoxgloveMessage::frame_transform);
  topics.truth = json(topics::kTruth, FoxgloveMessage::pose_in_frame);
  topics.ranges = own(topics::kRanges, "cairn.Ranges", kRangesSchema);
  topics.scan = json(topics::kScan, FoxgloveMessage::laser_scan);
  topics.map = json(topics::kMap, FoxgloveMessage::grid);
  topics.landmarks = json(topics::kLandmarks, FoxgloveMessage::scene_update);
  topics.plan = json(topics::kPlan, FoxgloveMessage::poses_in_frame);
  topics.plan_result = own(topics::kPlanResult, "cairn.PlanResult", kPlanSchema);
  topics.tree = own(topics::kTree, "cairn.TreeNode", kTreeSchema);
  topics.log = json(topics::kLog, FoxgloveMessage::log);
  topics.ros_pose = ros("/ros/pose", ros2::Message::pose_stamped);
  topics.ros_tf = ros("/tf", ros2::Message::tf);
  topics.ros_map = ros("/ros/map", ros2::Message::occupancy_grid);
  topics.ros_odometry = ros("/ros/odom", ros2::Message::odometry);
  topics.ros_range = ros("/ros/range", ros2::Message::range);
  topics.ros_scan = ros("/ros/scan", ros2::Message::laser_scan);
  topics.ros_compass = ros("/ros/compass", ros2::Message::imu);
  topics.ros_static = ros("/tf_static", ros2::Message::tf);
  return topics;
}

void McapRecording::on(const Event& event, const MissionView& view) {
  if (is_of_the_wall_clock(event)) return;
  in_recording(file_name_, [&] {
    if (view.world.observation != nullptr) now_ns_ = std::max(now_ns_, ns_of(view.world.observation->stamp_s));
    if (!has_landmarks_) write_landmarks(view.world.graph);
    if (std::holds_alternative<TickDone>(event))
      write_tick(view);
    else
      write_event(event);
  });
}

void McapRecording::attach(std::string_view name, std::string_view media_type, std::string_view data) {
  in_recording(file_name_, [&] { writer_.attach(name, media_type, now_ns_, data); });
}

void McapRecording::close(const OccupancyGrid* grid) {
  in_recording(file_name_, [&] {
    if (grid != nullptr) write_grid(*grid);
    writer_.close();
    out_.close();
  });
}

void McapRecording::write_tick(const MissionView& view) {
  const Pose2& T_map_robot = view.world.pose.T_map_robot;
  writer_.write(topics_.pose, now_ns_, foxglove::pose_in_frame(now_ns_, kMapFrame, T_map_robot));
  writer_.write(topics_.transform, now_ns_, foxglove::frame_transform(now_ns_, kMapFrame, kRobotFrame, T_map_robot));
  const ros2::Header header{now_ns_, kMapFrame};
  const ros2::Transform transform{std::string(kRobotFrame), T_map_robot};
  writer_.write(topics_.ros_pose, now_ns_, ros2::pose_stamped(header, T_map_robot));
  writer_.write(topics_.ros_tf, now_ns_, ros2::tf(header, {&transform, 1}));
  if (view.truth)
    writer_.write(topics_.truth, now_ns_, foxglove::pose_in_frame(now_ns_, kMapFrame, view.truth->T_map_robot));
  if (view.world.observation != nullptr) write_ranges(*view.world.observation);
  write_grid_when_due(view.world.grid, view.world.grid_version);
}

void McapRecording::write_ranges(const Observation& observation) {
  if (const auto scan = scan_of(observation.ranges))
    writer_.write(topics_.scan, now_ns_, foxglove::laser_scan(now_ns_, kRobotFrame, *scan));
  else
    writer_.write(topics_.ranges, now_ns_, ranges_text(observation));
  write_for_ros(observation);
}

// What a robot with ROS 2 would publish of it, so that its programs, and mcap_log, read the run as that of a robot.
void McapRecording::write_for_ros(const Observation& observation) {
  writer_.write(topics_.ros_odometry, now_ns_,
                ros2::odometry({now_ns_, kOdometryFrame}, kRobotFrame, observation.T_odom_robot));
  if (observation.compass_rad)
    writer_.write(topics_.ros_compass, now_ns_, ros2::imu({now_ns_, kRobotFrame}, *observation.compass_rad));
  if (const auto scan = scan_of(observation.ranges)) {
    const RangeReading& ray = observation.ranges.front();
    const std::string frame = frame_of("laser_" + std::to_string(ray.sensor), scan->T_frame_laser);
    writer_.write(topics_.ros_scan, now_ns_, ros2::laser_scan({now_ns_, frame}, *scan, ray.min_m, ray.max_m));
    return;
  }
  for (const RangeReading& reading : observation.ranges) {
    const std::string frame = frame_of("sonar_" + std::to_string(reading.sensor), reading.T_robot_sensor);
    writer_.write(
        topics_.ros_range, now_ns_,
        ros2::range({now_ns_, frame}, {reading.half_beam_rad, reading.min_m, reading.max_m, reading.range_m}));
  }
}

// That of a sensor; its place is written where it is new.
std::string McapRecording::frame_of(const std::string& name, const Pose2& T_robot_sensor) {
  const auto known = frames_.find(name);
  if (known != frames_.end() && known->second == T_robot_sensor) return name;
  frames_[name] = T_robot_sensor;
  const ros2::Transform transform{name, T_robot_sensor};
  writer_.write(topics_.ros_static, now_ns_, ros2::tf({now_ns_, kRobotFrame}, {&transform, 1}));
  return name;
}

// Those of an earlier run that this one goes on from.
void McapRecording::write_landmarks(const LandmarkGraph& graph) {
  has_landmarks_ = true;
  for (const auto& [id, landmark] : graph.landmarks())
    writer_.write(topics_.landmarks, now_ns_, foxglove::landmark(now_ns_, kMapFrame, landmark));
}

void McapRecording::write_event(const Event& event) {
  if (const auto* const change = std::get_if<LandmarkChanged>(&event))
    writer_.write(topics_.landmarks, now_ns_, foxglove::landmark(now_ns_, kMapFrame, change->landmark));
  if (const auto* const retired = std::get_if<LandmarkRetired>(&event))
    writer_.write(topics_.landmarks, now_ns_, foxglove::no_landmark(now_ns_, retired->landmark.id));
  if (const auto* const plan = std::get_if<PlanDone>(&event)) {
    writer_.write(topics_.plan, now_ns_, foxglove::poses_in_frame(now_ns_, kMapFrame, plan->result.path));
    writer_.write(topics_.plan_result, now_ns_, plan_text(plan->result));
  }
  if (const auto node = node_of(event))
    writer_.write(topics_.tree, now_ns_,
                  text_of({{"path", node->path},
                           {"name", node->name},
                           {"kind", node->kind},
                           {"state", node->state},
                           {"reason", node->reason}}));
  const std::string sentence = sentence_of(event);
  if (!sentence.empty())
    writer_.write(topics_.log, now_ns_, foxglove::log(now_ns_, level_of(event), "cairn", sentence));
}

// Once a second, large grids more seldom, and only what has changed.
void McapRecording::write_grid_when_due(const OccupancyGrid& grid, std::uint64_t version) {
  if (next_grid_ns_ && now_ns_ < *next_grid_ns_) return;
  if (version != 0 && grid_version_ == version) return;
  grid_version_ = version;
  write_grid(grid);
}

void McapRecording::write_grid(const OccupancyGrid& grid) {
  const foxglove::GridBytes bytes = foxglove::grid_bytes(grid, kMaxGridSide);
  writer_.write(topics_.map, now_ns_, foxglove::grid(now_ns_, kMapFrame, bytes));
  writer_.write(topics_.ros_map, now_ns_, ros2::occupancy_grid({now_ns_, kMapFrame}, bytes));
  const double pause_s = std::max(kGridEvery_s, static_cast<double>(bytes.ol.size()) / kCellsPerSecond);
  next_grid_ns_ = now_ns_ + ns_of(pause_s);
}

}  // namespace cairn
