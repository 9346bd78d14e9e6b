#include "maps/submaps/submap.hpp"

namespace cairn {

void Submap::add(std::size_t node, const Pose2& T_anchor_node, std::span<const Point> points_m) {
  nodes_.push_back(node);
  T_anchor_nodes_.push_back(T_anchor_node);
  const std::size_t first = points_m_.size();
  for (const Point& point_m : points_m) points_m_.push_back(T_anchor_node * point_m);
  surfaces_.add(std::span(points_m_).subspan(first));
}

FieldPyramid Submap::pyramid(double cell_m, double sigma_m, int levels) const {
  return {LikelihoodField(points_m_, cell_m, sigma_m), levels};
}

}  // namespace cairn
