#include "maps/pose_graph/normal_equations.hpp"

#include <array>
#include <utility>

namespace cairn {
namespace {

constexpr double kTie = 1.0;

}  // namespace

ErrorJacobians jacobians_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to,
                            const SensorErrors& errors) {
  const Eigen::Matrix2d R_z_map = rotation(-edge.T_from_to.theta_rad - T_map_from.theta_rad);
  const Point d = T_map_to.position() - T_map_from.position();
  ErrorJacobians jacobians;
  jacobians.by_from.topLeftCorner<2, 2>() = -R_z_map;
  // The derivative of a turn by -theta turns by another quarter clockwise.
  jacobians.by_from.topRightCorner<2, 1>() = -to_left(R_z_map * d);
  jacobians.by_from(2, 2) = -1.0;
  jacobians.by_to.topLeftCorner<2, 2>() = R_z_map;
  jacobians.by_to(2, 2) = 1.0;
  if (!edge.is_odometry) return jacobians;
  for (Eigen::Matrix3d* side : {&jacobians.by_from, &jacobians.by_to}) {
    side->topRows<2>() *= 1.0 + errors.length_ratio;
    side->row(2) *= 1.0 + errors.turn_ratio;
  }
  return jacobians;
}

NormalEquations::NormalEquations(const PoseGraph& graph)
    : graph_(graph), rows_(graph.expected, groups_of(graph), static_cast<int>(3 * graph.T_map_node.size())) {
  hessian_.resize(rows_.end, rows_.end);
  gradient_.resize(rows_.end);
  triplets_.reserve(27 * graph.edges.size() + 6 * graph.headings.size() + static_cast<std::size_t>(rows_.end));
}

void NormalEquations::add_block(std::size_t a, std::size_t b, const Eigen::Matrix3d& block) {
  if (a < b) return add_block(b, a, block.transpose());
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      if (a == b && column > row) continue;
      triplets_.emplace_back(static_cast<int>(3 * a) + row, static_cast<int>(3 * b) + column, block(row, column));
    }
}

void NormalEquations::add_edge(const PoseEdge& edge, std::span<const Pose2> T_map_node, const SensorErrors& errors) {
  const Pose2& T_map_from = T_map_node[edge.from];
  const Pose2& T_map_to = T_map_node[edge.to];
  const ErrorJacobians jacobians = jacobians_of(edge, T_map_from, T_map_to, errors);
  const Eigen::Matrix3d& information = edge.information;
  const Eigen::Vector3d pull = information * error_of(edge, T_map_from, T_map_to, errors);
  add_block(edge.from, edge.from, jacobians.by_from.transpose() * information * jacobians.by_from);
  add_block(edge.to, edge.to, jacobians.by_to.transpose() * information * jacobians.by_to);
  add_block(edge.from, edge.to, jacobians.by_from.transpose() * information * jacobians.by_to);
  gradient_.segment<3>(static_cast<Eigen::Index>(3 * edge.from)) += jacobians.by_from.transpose() * pull;
  gradient_.segment<3>(static_cast<Eigen::Index>(3 * edge.to)) += jacobians.by_to.transpose() * pull;
  if (edge.is_odometry) add_odometry(edge, inverse(T_map_from) * T_map_to, jacobians, pull);
}

// The rows of both ratios.
void NormalEquations::add_odometry(const PoseEdge& edge, const Pose2& T_from_to, const ErrorJacobians& jacobians,
                                   const Eigen::Vector3d& pull) {
  Eigen::Matrix<double, 3, 2> by_ratio = Eigen::Matrix<double, 3, 2>::Zero();
  by_ratio.topLeftCorner<2, 1>() = rotation(-edge.T_from_to.theta_rad) * T_from_to.position();
  by_ratio(2, 1) = T_from_to.theta_rad;
  const Eigen::Matrix<double, 2, 3> weighed = by_ratio.transpose() * edge.information;
  for (const auto& [at, i] : {std::pair{rows_.length, 0}, std::pair{rows_.turn, 1}}) {
    if (at < 0) continue;
    for (int column = 0; column < 3; ++column) {
      triplets_.emplace_back(at, static_cast<int>(3 * edge.from) + column,
                             weighed.row(i).dot(jacobians.by_from.col(column)));
      triplets_.emplace_back(at, static_cast<int>(3 * edge.to) + column,
                             weighed.row(i).dot(jacobians.by_to.col(column)));
    }
    triplets_.emplace_back(at, at, weighed.row(i).dot(by_ratio.col(i)));
    gradient_[at] += by_ratio.col(i).dot(pull);
  }
  if (rows_.length >= 0 && rows_.turn >= 0)
    triplets_.emplace_back(rows_.turn, rows_.length, weighed.row(1).dot(by_ratio.col(0)));
}

// The error is the heading's, the run's bias's and the group's: all by the same slope.
void NormalEquations::add_heading(const HeadingPrior& prior, const HeadingLoss& loss) {
  std::array<int, 3> row{static_cast<int>(3 * prior.node) + 2, -1, -1};
  if (prior.is_biased()) {
    row[1] = rows_.compass;
    row[2] = rows_.of_group(prior.group);
  }
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i] < 0) continue;
    gradient_[row[i]] += loss.information * loss.error_rad;
    for (std::size_t k = 0; k <= i; ++k)
      if (row[k] >= 0) triplets_.emplace_back(row[i], row[k], loss.information);
  }
}

void NormalEquations::add_value(int row, double value, double sigma) {
  if (row < 0) return;
  const double information = 1.0 / (sigma * sigma);
  triplets_.emplace_back(row, row, information);
  gradient_[row] += information * value;
}

void NormalEquations::add_expected(const SensorErrors& errors) {
  const ExpectedErrors& expected = graph_.expected;
  add_value(rows_.length, errors.length_ratio, expected.length_ratio);
  add_value(rows_.turn, errors.turn_ratio, expected.turn_ratio);
  add_value(rows_.compass, errors.compass_rad, expected.compass_rad);
  if (rows_.first_local < 0) return;
  const std::vector<double>& local_rad = errors.local_compass_rad;
  const auto bias_rad = [&](int row) {
    const auto group = static_cast<std::size_t>(row - rows_.first_local);
    return group < local_rad.size() ? local_rad[group] : 0.0;
  };
  add_value(rows_.first_local, bias_rad(rows_.first_local), expected.local_compass_rad);
  const double kept = expected.local_kept_ratio;
  const double sigma_rad = innovation_sigma_rad(expected);
  const double information = 1.0 / (sigma_rad * sigma_rad);
  for (int row = rows_.first_local + 1; row < rows_.end; ++row) {
    const double innovation_rad = bias_rad(row) - kept * bias_rad(row - 1);
    add_value(row, innovation_rad, sigma_rad);
    triplets_.emplace_back(row, row - 1, -kept * information);
    triplets_.emplace_back(row - 1, row - 1, kept * kept * information);
    gradient_[row - 1] -= kept * information * innovation_rad;
  }
}

void NormalEquations::fill(std::span<const Pose2> T_map_node, const SensorErrors& errors, bool is_convex) {
  triplets_.clear();
  gradient_.setZero();
  for (const PoseEdge& edge : graph_.edges) add_edge(edge, T_map_node, errors);
  for (const HeadingPrior& prior : graph_.headings)
    add_heading(prior, loss_of(prior, T_map_node[prior.node].theta_rad, errors, is_convex));
  add_expected(errors);
  for (int row = 0; row < (graph_.headings.empty() ? 3 : 2); ++row) triplets_.emplace_back(row, row, kTie);
  // A place of its own on the diagonal for every row, which damping needs.
  for (int row = 0; row < gradient_.size(); ++row) triplets_.emplace_back(row, row, 0.0);
  hessian_.setFromTriplets(triplets_.begin(), triplets_.end());
}

}  // namespace cairn
