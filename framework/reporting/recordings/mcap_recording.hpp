// A run as an MCAP file for the viewers of Foxglove, Rerun and ROS 2 (docs/recordings.md).
//
// Nothing in it depends on the wall clock: the same mission, seed and build write the same bytes.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "framework/mission/events.hpp"
#include "maps/base/output_file.hpp"
#include "maps/exchange/recordings/mcap_writer.hpp"

namespace cairn {

class McapRecording : public Listener {
 public:
  // Throws std::runtime_error when the file cannot be written.
  explicit McapRecording(const std::filesystem::path& file);

  // Writes what has happened. Throws std::runtime_error when the disk takes no more.
  void on(const Event& event, const MissionView& view) override;
  // A file of the run beside the messages.
  void attach(std::string_view name, std::string_view media_type, std::string_view data);
  // The last state of the grid (null: there is none), and the index of the whole. Throws like on().
  void close(const OccupancyGrid* grid);

 private:
  using Ids = exchange::McapWriter::Ids;
  struct Topics {
    Ids pose, transform, truth, ranges, scan, map, landmarks, plan, plan_result, tree, log;
    Ids ros_pose, ros_tf, ros_map;
    Ids ros_odometry, ros_range, ros_scan, ros_compass, ros_static;
  };

  [[nodiscard]] Topics add_topics();
  void write_tick(const MissionView& view);
  void write_ranges(const Observation& observation);
  void write_for_ros(const Observation& observation);
  [[nodiscard]] std::string frame_of(const std::string& name, const Pose2& T_robot_sensor);
  void write_landmarks(const LandmarkGraph& graph);
  void write_event(const Event& event);
  void write_grid_when_due(const OccupancyGrid& grid, std::uint64_t version);
  void write_grid(const OccupancyGrid& grid);

  std::string file_name_;
  GrowingFile out_;
  exchange::McapWriter writer_;
  const Topics topics_;
  std::uint64_t now_ns_ = 0;  // of the last observation
  std::optional<std::uint64_t> next_grid_ns_;
  std::optional<std::uint64_t> grid_version_;
  bool has_landmarks_ = false;
  std::map<std::string, Pose2> frames_;  // of sensors, that have been written
};

}  // namespace cairn
