#include "maps/pose_graph/normal_equations.hpp"

namespace cairn {
namespace {

constexpr double kTie = 1.0;

}  // namespace

ErrorJacobians jacobians_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to) {
  const Eigen::Matrix2d R_z_map = rotation(-edge.T_from_to.theta_rad - T_map_from.theta_rad);
  const Point d = T_map_to.position() - T_map_from.position();
  ErrorJacobians jacobians;
  jacobians.by_from.topLeftCorner<2, 2>() = -R_z_map;
  // The derivative of a turn by -theta turns by another quarter clockwise.
  jacobians.by_from.topRightCorner<2, 1>() = -to_left(R_z_map * d);
  jacobians.by_from(2, 2) = -1.0;
  jacobians.by_to.topLeftCorner<2, 2>() = R_z_map;
  jacobians.by_to(2, 2) = 1.0;
  return jacobians;
}

NormalEquations::NormalEquations(const PoseGraph& graph) : graph_(graph) {
  const auto rows = static_cast<Eigen::Index>(3 * graph.T_map_node.size());
  hessian_.resize(rows, rows);
  gradient_.resize(rows);
  triplets_.reserve(27 * graph.edges.size() + graph.headings.size() + 3 * graph.T_map_node.size());
}

void NormalEquations::add_block(std::size_t a, std::size_t b, const Eigen::Matrix3d& block) {
  if (a < b) return add_block(b, a, block.transpose());
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      if (a == b && column > row) continue;
      triplets_.emplace_back(static_cast<int>(3 * a) + row, static_cast<int>(3 * b) + column, block(row, column));
    }
}

void NormalEquations::add_edge(const PoseEdge& edge, std::span<const Pose2> T_map_node) {
  const Pose2& T_map_from = T_map_node[edge.from];
  const Pose2& T_map_to = T_map_node[edge.to];
  const ErrorJacobians jacobians = jacobians_of(edge, T_map_from, T_map_to);
  const Eigen::Matrix3d& information = edge.information;
  const Eigen::Vector3d pull = information * error_of(edge, T_map_from, T_map_to);
  add_block(edge.from, edge.from, jacobians.by_from.transpose() * information * jacobians.by_from);
  add_block(edge.to, edge.to, jacobians.by_to.transpose() * information * jacobians.by_to);
  add_block(edge.from, edge.to, jacobians.by_from.transpose() * information * jacobians.by_to);
  gradient_.segment<3>(static_cast<Eigen::Index>(3 * edge.from)) += jacobians.by_from.transpose() * pull;
  gradient_.segment<3>(static_cast<Eigen::Index>(3 * edge.to)) += jacobians.by_to.transpose() * pull;
}

void NormalEquations::fill(std::span<const Pose2> T_map_node) {
  triplets_.clear();
  gradient_.setZero();
  for (const PoseEdge& edge : graph_.edges) add_edge(edge, T_map_node);
  for (const HeadingPrior& prior : graph_.headings) {
    const int row = static_cast<int>(3 * prior.node) + 2;
    triplets_.emplace_back(row, row, prior.information);
    gradient_[row] += prior.information * wrap_angle(T_map_node[prior.node].theta_rad - prior.heading_rad);
  }
  for (int row = 0; row < (graph_.headings.empty() ? 3 : 2); ++row) triplets_.emplace_back(row, row, kTie);
  // A place of its own on the diagonal for every row, which damping needs.
  for (int row = 0; row < gradient_.size(); ++row) triplets_.emplace_back(row, row, 0.0);
  hessian_.setFromTriplets(triplets_.begin(), triplets_.end());
}

}  // namespace cairn
