#include "maps/pose_graph/linear_start.hpp"

#include <Eigen/SparseCholesky>

namespace cairn {
namespace {

constexpr double kAnchor = 1e6;  // of node 0 to where it is; the others have no place of their own

// Adds information (v - u - step)' (v - u - step), or with a turn (v - turn u)' (v - turn u), to a system of two rows a
// node: both are blocks of 2 x 2.
class TwoRowSystem {
 public:
  explicit TwoRowSystem(std::size_t nodes) : right_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(2 * nodes))) {}

  void add_block(std::size_t a, std::size_t b, const Eigen::Matrix2d& block) {
    if (a < b) return add_block(b, a, block.transpose());
    for (int row = 0; row < 2; ++row)
      for (int column = 0; column < (a == b ? row + 1 : 2); ++column)
        triplets_.emplace_back(static_cast<int>(2 * a) + row, static_cast<int>(2 * b) + column, block(row, column));
  }
  void add_right(std::size_t a, const Point& pull) { right_.segment<2>(static_cast<Eigen::Index>(2 * a)) += pull; }
  void tie(std::size_t a, const Point& to, double information) {
    add_block(a, a, information * Eigen::Matrix2d::Identity());
    add_right(a, information * to);
  }
  [[nodiscard]] std::optional<Eigen::VectorXd> solved() const {
    Eigen::SparseMatrix<double> matrix(right_.size(), right_.size());
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    if (solver.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd solution = solver.solve(right_);
    return solution.allFinite() ? std::optional(std::move(solution)) : std::nullopt;
  }

 private:
  std::vector<Eigen::Triplet<double>> triplets_;  // of the lower half
  Eigen::VectorXd right_;
};

// The step of an edge, by what the sensors say too much.
Pose2 step_of(const PoseEdge& edge, const SensorErrors& errors) {
  if (!edge.is_odometry) return edge.T_from_to;
  const double length = 1.0 + errors.length_ratio;
  return {edge.T_from_to.x_m / length, edge.T_from_to.y_m / length,
          edge.T_from_to.theta_rad / (1.0 + errors.turn_ratio)};
}

// Each heading as a free vector (cosine, sine), of which only the direction is taken in the end.
std::optional<std::vector<double>> headings_of(const PoseGraph& graph) {
  TwoRowSystem system(graph.T_map_node.size());
  for (const PoseEdge& edge : graph.edges) {
    const double information = edge.information(2, 2);
    system.add_block(edge.from, edge.from, information * Eigen::Matrix2d::Identity());
    system.add_block(edge.to, edge.to, information * Eigen::Matrix2d::Identity());
    system.add_block(edge.to, edge.from, -information * rotation(step_of(edge, graph.errors).theta_rad));
  }
  for (const HeadingPrior& prior : graph.headings)
    system.tie(prior.node, unit_vector(prior.heading_rad - bias_of(prior, graph.errors)), prior.information);
  if (graph.headings.empty()) system.tie(0, graph.T_map_node[0].direction(), kAnchor);
  const auto vectors = system.solved();
  if (!vectors) return std::nullopt;
  std::vector<double> heading_rad(graph.T_map_node.size());
  for (std::size_t i = 0; i < heading_rad.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    heading_rad[i] = std::atan2((*vectors)[row + 1], (*vectors)[row]);
  }
  return heading_rad;
}

// With the headings as they are.
std::optional<Eigen::VectorXd> positions_of(const PoseGraph& graph, const std::vector<double>& heading_rad) {
  TwoRowSystem system(graph.T_map_node.size());
  for (const PoseEdge& edge : graph.edges) {
    const Point step = rotation(heading_rad[edge.from]) * step_of(edge, graph.errors).position();
    const Eigen::Matrix2d R_map_z = rotation(heading_rad[edge.from] + edge.T_from_to.theta_rad);
    const Eigen::Matrix2d information = R_map_z * edge.information.topLeftCorner<2, 2>() * R_map_z.transpose();
    system.add_block(edge.from, edge.from, information);
    system.add_block(edge.to, edge.to, information);
    system.add_block(edge.to, edge.from, -information);
    system.add_right(edge.from, -information * step);
    system.add_right(edge.to, information * step);
  }
  system.tie(0, graph.T_map_node[0].position(), kAnchor);
  return system.solved();
}

}  // namespace

std::optional<std::vector<Pose2>> linear_start(const PoseGraph& graph) {
  const auto heading_rad = headings_of(graph);
  if (!heading_rad) return std::nullopt;
  const auto position_m = positions_of(graph, *heading_rad);
  if (!position_m) return std::nullopt;
  std::vector<Pose2> T_map_node(graph.T_map_node.size());
  for (std::size_t i = 0; i < T_map_node.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(2 * i);
    T_map_node[i] = {(*position_m)[row], (*position_m)[row + 1], wrap_angle((*heading_rad)[i])};
  }
  return T_map_node;
}

}  // namespace cairn
