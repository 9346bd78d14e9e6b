#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

Eigen::Matrix2d rotation(double angle_rad) {
  const Point axis = unit_vector(angle_rad);
  Eigen::Matrix2d R;
  R << axis, to_left(axis);
  return R;
}

Eigen::Vector3d error_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to) {
  const Pose2 difference = inverse(edge.T_from_to) * (inverse(T_map_from) * T_map_to);
  return {difference.x_m, difference.y_m, difference.theta_rad};
}

double chi2_of(const PoseEdge& edge, std::span<const Pose2> T_map_node) {
  const Eigen::Vector3d error = error_of(edge, T_map_node[edge.from], T_map_node[edge.to]);
  return error.dot(edge.information * error);
}

double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node) {
  double chi2 = 0.0;
  for (const PoseEdge& edge : graph.edges) chi2 += chi2_of(edge, T_map_node);
  for (const HeadingPrior& prior : graph.headings) {
    const double error = wrap_angle(T_map_node[prior.node].theta_rad - prior.heading_rad);
    chi2 += prior.information * error * error;
  }
  return chi2;
}

}  // namespace cairn
