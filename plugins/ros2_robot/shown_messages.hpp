// What people see of a mission, as messages. Each keeps what its message points to, so it is not copied.
#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "framework/contracts/optional/mission_display.hpp"
#include "plugins/ros2_robot/messages.hpp"

namespace cairn::ros2_robot {

// Of what is shown at one moment.
struct ShownHeader {
  Time stamp{};
  std::string frame;
};

[[nodiscard]] bool is_in_frame(const Header& header, const std::string& frame);
// {"goto": {"at_m": [x, y], "angle_deg": a}}, or why it is no order.
[[nodiscard]] DisplayOrder order_of(const PoseStamped& goal, const std::string& topic, const std::string& map_frame);

class MapMessage {
 public:
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 24;

  // Unknown cells are -1, the others their probability in per cent. An empty message when there are more than
  // kMaxCells.
  MapMessage(const ShownHeader& header, const OccupancyGrid& grid);
  MapMessage(const MapMessage&) = delete;
  MapMessage& operator=(const MapMessage&) = delete;
  [[nodiscard]] const OccupancyGridMessage& message() const { return message_; }

 private:
  std::string frame_;
  std::vector<std::uint8_t> cells_;
  OccupancyGridMessage message_{};
};

class PoseMessage {
 public:
  PoseMessage(const ShownHeader& header, const PoseEstimate& pose);
  PoseMessage(const PoseMessage&) = delete;
  PoseMessage& operator=(const PoseMessage&) = delete;
  [[nodiscard]] const PoseWithCovarianceStamped& message() const { return message_; }

 private:
  std::string frame_;
  PoseWithCovarianceStamped message_{};
};

class PathMessage {
 public:
  PathMessage(const ShownHeader& header, const std::vector<Pose2>& path);
  PathMessage(const PathMessage&) = delete;
  PathMessage& operator=(const PathMessage&) = delete;
  [[nodiscard]] const Path& message() const { return message_; }

 private:
  std::string frame_;
  std::vector<PoseStamped> poses_;
  Path message_{};
};

// A ball and a name each, after one that takes the earlier ones away.
class LandmarksMessage {
 public:
  LandmarksMessage(const ShownHeader& header, const LandmarkGraph& landmarks);
  LandmarksMessage(const LandmarksMessage&) = delete;
  LandmarksMessage& operator=(const LandmarksMessage&) = delete;
  [[nodiscard]] const MarkerArray& message() const { return message_; }

 private:
  std::string frame_;
  std::deque<std::string> texts_;
  std::vector<Marker> markers_;
  MarkerArray message_{};
};

// One status, "cairn: mission": a warning while the robot is lost or held back by the collision monitor.
class DiagnosticsMessage {
 public:
  DiagnosticsMessage(const ShownHeader& header, const MissionSnapshot& snapshot);
  DiagnosticsMessage(const DiagnosticsMessage&) = delete;
  DiagnosticsMessage& operator=(const DiagnosticsMessage&) = delete;
  [[nodiscard]] const DiagnosticArray& message() const { return message_; }

 private:
  std::string frame_;
  std::string doing_;
  std::vector<std::pair<std::string, std::string>> texts_;
  std::vector<diagnostic_msgs_msg_dds__KeyValue_> values_;
  diagnostic_msgs_msg_dds__DiagnosticStatus_ status_{};
  DiagnosticArray message_{};
};

class TransformMessage {
 public:
  TransformMessage(const ShownHeader& header, const std::string& child_frame, const Pose2& T_frame_child);
  TransformMessage(const TransformMessage&) = delete;
  TransformMessage& operator=(const TransformMessage&) = delete;
  [[nodiscard]] const TFMessage& message() const { return message_; }

 private:
  std::string frame_;
  std::string child_frame_;
  geometry_msgs_msg_dds__TransformStamped_ transform_{};
  TFMessage message_{};
};

}  // namespace cairn::ros2_robot
