// Poses and what was measured between them: the graph by which a map is bent.
//
// An edge states T_from_to with an information matrix over (x, y, theta) in the frame of `from`'s measurement, as g2o
// writes it. Its error is e = (R_z' (R_from' (t_to - t_from) - t_z), wrap(theta_to - theta_from - theta_z)), its chi2
// e' I e. A heading is a compass reading of a node in the map.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

struct PoseEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  // 1/m2, 1/(m rad), 1/rad2; symmetric, not negative
};

struct HeadingPrior {
  std::size_t node = 0;
  double heading_rad = 0.0;
  double information = 1.0;  // 1/rad2
};

struct PoseGraph {
  std::vector<Pose2> T_map_node;  // as believed so far
  std::vector<PoseEdge> edges;
  std::vector<HeadingPrior> headings;
};

// Turns a vector by the angle.
[[nodiscard]] Eigen::Matrix2d rotation(double angle_rad);
// (x_m, y_m, theta_rad) of the error above.
[[nodiscard]] Eigen::Vector3d error_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to);
[[nodiscard]] double chi2_of(const PoseEdge& edge, std::span<const Pose2> T_map_node);
// Of all edges and headings.
[[nodiscard]] double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node);

}  // namespace cairn
