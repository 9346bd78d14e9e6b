// Shows the mission on topics, and takes goals from one. Nothing is made or sent that nobody reads.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/optional/mission_display.hpp"
#include "plugins/ros2_robot/config.hpp"
#include "plugins/ros2_robot/dds/endpoints.hpp"
#include "plugins/ros2_robot/shown_messages.hpp"

namespace cairn::ros2_robot {

class DisplayTopics final : public MissionDisplay {
 public:
  // Both must outlive it. goal: a topic; empty: none.
  DisplayTopics(const ShownTopics& shown, const std::string& goal) : shown_(shown), goal_(goal) {}

  void open(const Participant& participant);
  // The odometry that the next snapshot is made of.
  void observed(const Header& header, const Pose2& T_odom_robot);

  void show(const MissionSnapshot& snapshot) override;
  [[nodiscard]] std::optional<DisplayOrder> next_order() override;

 private:
  struct LandmarkMark {
    LandmarkId id;
    Pose2 T_map_landmark;
    std::string name;
    bool operator==(const LandmarkMark&) const = default;
  };

  void show_map(const WorldView& world);
  void show_plan(const std::vector<Pose2>& path);
  void show_landmarks(const LandmarkGraph& landmarks);
  void show_diagnostics(const MissionSnapshot& snapshot);
  void show_transform(const Pose2& T_map_robot);

  const ShownTopics& shown_;
  const std::string& goal_;
  Entity map_;
  Entity pose_;
  Entity plan_;
  Entity landmarks_;
  Entity diagnostics_;
  Entity transforms_;
  Entity goals_;
  ShownHeader header_;
  std::string odom_frame_;
  Pose2 T_odom_robot_{};
  std::vector<DisplayOrder> given_;
  // What was shown last, and when by a clock that does not step:
  std::optional<double> map_s_;
  std::uint64_t map_version_ = 0;
  std::optional<double> diagnostics_s_;
  std::optional<double> landmarks_s_;
  std::optional<std::vector<Pose2>> path_;
  std::optional<std::vector<LandmarkMark>> marks_;
};

}  // namespace cairn::ros2_robot
