// A piece of the way with what was seen on it, in the frame of its first node: rigid, and moved as a whole when the
// pose graph is solved.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "maps/submaps/correlative_search.hpp"
#include "maps/submaps/surface_map.hpp"

namespace cairn {

class Submap {
 public:
  Submap(std::size_t anchor, double surface_cell_m) : anchor_(anchor), surfaces_(surface_cell_m) {}

  // A node's scan, as seen from the node.
  void add(std::size_t node, const Pose2& T_anchor_node, std::span<const Point> points_m);

  [[nodiscard]] std::size_t anchor() const { return anchor_; }
  [[nodiscard]] const std::vector<std::size_t>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Pose2>& T_anchor_nodes() const { return T_anchor_nodes_; }
  [[nodiscard]] const std::vector<Point>& points_m() const { return points_m_; }
  [[nodiscard]] const SurfaceMap& surfaces() const { return surfaces_; }
  // What scans are searched in. Built anew at each call: O(points + cells).
  [[nodiscard]] FieldPyramid pyramid(double cell_m, double sigma_m, int levels) const;

 private:
  std::size_t anchor_;
  std::vector<std::size_t> nodes_;
  std::vector<Pose2> T_anchor_nodes_;  // of the nodes, as they were laid here
  std::vector<Point> points_m_;        // of all scans
  SurfaceMap surfaces_;
};

}  // namespace cairn
