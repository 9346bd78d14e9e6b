// Copies of the map and of what is known in it, from some metres ago: what a robot goes back to that was carried.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// What a landmark tracker can be restored to.
struct KnownLandmarks {
  LandmarkGraph graph;
  LandmarkGraph candidates;
  std::vector<Pose2> driven_path;
};

struct MapSnapshot {
  OccupancyGrid grid;
  KnownLandmarks landmarks;
  Pose2 T_map_robot;  // then
};

class MapSnapshots {
 public:
  static constexpr double kEvery_m = 3.0;  // driven
  static constexpr std::size_t kKept = 3;
  static constexpr std::size_t kMaxBytes = std::size_t{64} << 20;  // of a grid: a larger one is not copied

  // At every tick. Whether the robot has driven so far that a copy is to be added.
  [[nodiscard]] bool drive(const Pose2& T_map_robot);
  void add(std::shared_ptr<const MapSnapshot> snapshot);
  // The oldest; none: there is none.
  [[nodiscard]] std::shared_ptr<const MapSnapshot> oldest() const { return kept_.empty() ? nullptr : kept_.front(); }
  // What has been driven meanwhile does not count: the next copy is due after kEvery_m from here.
  void begin_distance();
  void clear();

 private:
  std::deque<std::shared_ptr<const MapSnapshot>> kept_;
  std::optional<Pose2> T_map_robot_;
  double driven_m_ = 0.0;  // since the last one
};

}  // namespace cairn
