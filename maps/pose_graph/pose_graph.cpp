#include "maps/pose_graph/pose_graph.hpp"

#include <algorithm>
#include <cmath>

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

Eigen::Vector3d error_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to,
                         const SensorErrors& errors) {
  if (!edge.is_odometry) return error_of(edge, T_map_from, T_map_to);
  Pose2 counted = inverse(T_map_from) * T_map_to;
  counted.x_m *= 1.0 + errors.length_ratio;
  counted.y_m *= 1.0 + errors.length_ratio;
  counted.theta_rad *= 1.0 + errors.turn_ratio;
  const Pose2 difference = inverse(edge.T_from_to) * counted;
  return {difference.x_m, difference.y_m, difference.theta_rad};
}

double chi2_of(const PoseEdge& edge, std::span<const Pose2> T_map_node, const SensorErrors& errors) {
  const Eigen::Vector3d error = error_of(edge, T_map_node[edge.from], T_map_node[edge.to], errors);
  return error.dot(edge.information * error);
}

double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node, const SensorErrors& errors, bool is_convex) {
  double chi2 = 0.0;
  for (const PoseEdge& edge : graph.edges) chi2 += chi2_of(edge, T_map_node, errors);
  for (const HeadingPrior& prior : graph.headings)
    chi2 += loss_of(prior, T_map_node[prior.node].theta_rad, errors, is_convex).chi2;
  return chi2 + chi2_of(graph.expected, errors);
}

double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node) {
  return chi2_of(graph, T_map_node, graph.errors);
}

std::size_t groups_of(const PoseGraph& graph) {
  std::size_t groups = 0;
  for (const HeadingPrior& prior : graph.headings)
    if (prior.is_biased()) groups = std::max(groups, prior.group + 1);
  return groups;
}

double bias_of(const HeadingPrior& prior, const SensorErrors& errors) {
  if (!prior.is_biased()) return 0.0;
  const std::vector<double>& local_rad = errors.local_compass_rad;
  return errors.compass_rad + (prior.group < local_rad.size() ? local_rad[prior.group] : 0.0);
}

HeadingLoss loss_of(const HeadingPrior& prior, double theta_rad, const SensorErrors& errors, bool is_convex) {
  HeadingLoss loss;
  loss.error_rad = wrap_angle(theta_rad + bias_of(prior, errors) - prior.heading_rad);
  loss.chi2 = prior.information * loss.error_rad * loss.error_rad;
  loss.information = prior.information;
  const double limit = prior.limit_sigmas;
  if (limit <= 0.0 || loss.chi2 <= limit * limit) return loss;
  const double sigmas = std::sqrt(loss.chi2);
  const double part = limit / sigmas;
  loss.chi2 = is_convex ? limit * (2.0 * sigmas - limit) : limit * limit * (3.0 - 2.0 * part);
  loss.information *= is_convex ? part : part * part * part;
  return loss;
}

}  // namespace cairn
