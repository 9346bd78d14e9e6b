// What a saved map keeps of laser SLAM: submaps as grids of echoes, the nodes of the pose graph, its edges.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct KeptNode {
  std::int64_t number = 0;  // rising in the order in which they were driven; some may be missing
  double stamp_s = 0.0;
  Pose2 T_map_node;
  bool operator==(const KeptNode&) const = default;
};

// Lies in the map as its anchor does, a node: cell (x, y) of the grid begins at cell_m (min_x + x, min_y + y) there.
struct KeptSubmap {
  static constexpr int kMaxSide = 2048;
  static constexpr double kMaxCell_m = 10.0;
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
  static constexpr std::int64_t kMaxNumber = 1'000'000'000;
  std::vector<KeptNode> nodes;      // by rising number
  std::vector<KeptSubmap> submaps;  // by rising anchor
  std::vector<KeptEdge> edges;
  [[nodiscard]] bool empty() const { return nodes.empty(); }
  bool operator==(const KeptSubmaps&) const = default;
};

// How large they are, and how many loops they close.
struct SubmapCounts {
  std::size_t nodes = 0;
  std::size_t submaps = 0;
  std::size_t edges = 0;
  std::size_t closures = 0;  // of the edges
  std::size_t closures_believed = 0;
  bool operator==(const SubmapCounts&) const = default;
};
[[nodiscard]] SubmapCounts counts_of(const KeptSubmaps& submaps);

// The points as echoes of a submap's grid. Those beyond the largest grid around the anchor are left out.
void set_echoes(KeptSubmap& submap, std::span<const Point> points_m);
// The centres of the grid's cells that have echoes, in the anchor's frame; one of several echoes as many times, at most
// max_times.
[[nodiscard]] std::vector<Point> echoes_of(const KeptSubmap& submap, int max_times);
// The nodes whose scans a submap holds: the anchor and those that followed it on submap_m of the way, a turn of one
// radian counted as a metre. There must be no fault. O(log nodes).
[[nodiscard]] std::span<const KeptNode> nodes_of(const KeptSubmaps& submaps, const KeptSubmap& submap, double submap_m);
// Why a run cannot go on with them: a pose beyond all maps, a number that comes twice, a grid that has other cells than
// it says, an anchor or an end of an edge that is missing. Empty: it can.
[[nodiscard]] std::string fault_of(const KeptSubmaps& submaps);
// Leaves out the oldest where there is more than a map keeps, and edges that have lost an end.
void keep_latest(KeptSubmaps& submaps);

}  // namespace cairn
