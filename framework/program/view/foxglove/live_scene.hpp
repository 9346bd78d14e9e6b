// A run's stream (docs/view.md, "The stream of a run") as messages of Foxglove's protocol.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "framework/program/view/foxglove/frames.hpp"
#include "maps/geometry/pose.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

struct LiveMessage {
  std::uint32_t channel = 0;
  std::uint64_t time_ns = 0;
  std::string data;
};

enum LiveChannel : std::uint32_t {
  live_map = 1,
  live_transform,
  live_pose,
  live_truth,
  live_landmarks,
  live_driven,
  live_plan,
  live_tree,
  live_log,
  live_ranges,
  live_status,
};

class LiveScene {
 public:
  [[nodiscard]] static std::vector<foxglove_protocol::Channel> channels();

  // What a line of the stream tells, but for map and driven path, which are large: they are only noted as changed.
  // Throws std::exception when it is no such line.
  [[nodiscard]] std::vector<LiveMessage> take(const nlohmann::json& line);
  // How things stand, for one who subscribes now: of a channel of what happens, nothing.
  [[nodiscard]] std::vector<LiveMessage> standing(std::uint32_t channel) const;

  [[nodiscard]] std::uint64_t time_ns() const { return time_ns_; }
  // Whether standing() of the map or the driven path has changed since the last call.
  [[nodiscard]] bool has_changed(LiveChannel channel) { return std::exchange(changed_[channel], false); }

 private:
  void take_map(const nlohmann::json& line, std::vector<LiveMessage>& messages);
  void take_pose(const nlohmann::json& line, std::vector<LiveMessage>& messages);
  void take_state(const nlohmann::json& line, std::vector<LiveMessage>& messages);
  void drive_to(const Pose2& T_map_robot);
  [[nodiscard]] std::string map_text() const;
  [[nodiscard]] std::string node_text(const std::string& path) const;
  [[nodiscard]] LiveMessage message(LiveChannel channel, std::string data) const {
    return {channel, time_ns_, std::move(data)};
  }

  struct Node {
    std::string name;
    std::string kind;
    std::string state;
    std::string reason;
  };
  void name_nodes(const nlohmann::json& tree);

  std::uint64_t time_ns_ = 0;
  double cell_m_ = 0.0;
  Point origin_m_{0.0, 0.0};
  nlohmann::json box_;
  std::map<std::pair<int, int>, std::vector<std::uint8_t>> tiles_;
  std::map<LandmarkId, Landmark> landmarks_;
  std::vector<Pose2> driven_;
  std::map<std::string, Node> nodes_;
  std::map<LiveChannel, std::string> last_;  // of channels whose last message is how things stand
  std::map<LiveChannel, bool> changed_;
};

}  // namespace cairn
