// What a saved map keeps of laser SLAM: submaps as grids of echoes, the nodes of the pose graph, its edges.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct KeptNode {
  std::int64_t number = 0;  // from 0, in the order in which they were driven
  double stamp_s = 0.0;
  Pose2 T_map_node;
  bool operator==(const KeptNode&) const = default;
};

// Lies in the map as its anchor does, a node: cell (x, y) of the grid begins at cell_m (min_x + x, min_y + y) there.
struct KeptSubmap {
  static constexpr int kMaxSide = 2048;
  std::int64_t anchor = 0;
  bool finished = false;  // the robot has left it; an open one would have grown on
  double cell_m = 0.1;
  int min_x = 0;
  int min_y = 0;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> echoes;  // row by row from below; 255: that many or more
  bool operator==(const KeptSubmap&) const = default;
};

// As PoseEdge has it (maps/pose_graph/pose_graph.hpp).
struct KeptEdge {
  std::int64_t from = 0;
  std::int64_t to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();
  bool is_closure = false;   // else from one node or submap to what followed
  bool is_believed = false;  // by the latest solution
  bool operator==(const KeptEdge&) const = default;
};

struct KeptSubmaps {
  static constexpr std::size_t kMax = 1000;
  static constexpr std::size_t kMaxNodes = 50'000;
  static constexpr std::size_t kMaxEdges = 200'000;
  std::vector<KeptNode> nodes;      // by rising number
  std::vector<KeptSubmap> submaps;  // by rising anchor
  std::vector<KeptEdge> edges;
  [[nodiscard]] bool empty() const { return nodes.empty(); }
  bool operator==(const KeptSubmaps&) const = default;
};

// The points as echoes of a submap's grid. Those beyond the largest grid around the anchor are left out.
void set_echoes(KeptSubmap& submap, std::span<const Point> points_m);
// Leaves out the oldest where there is more than a map keeps, and edges that have lost an end.
void keep_latest(KeptSubmaps& submaps);

}  // namespace cairn
