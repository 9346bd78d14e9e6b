// The normal equations of a pose graph at given poses: H dx = -b, three rows a node, then one for each error of the
// sensors that is looked for.
#pragma once

#include <Eigen/SparseCore>
#include <span>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

// Of error_of() with the sensors' errors, by the position in the map and the heading of either end.
struct ErrorJacobians {
  Eigen::Matrix3d by_from = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d by_to = Eigen::Matrix3d::Zero();
};
[[nodiscard]] ErrorJacobians jacobians_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to,
                                          const SensorErrors& errors = {});

// The lower half of H, and b. The graph has no place of its own: node 0 is tied to
// where it is, in heading too unless there are headings; that changes no minimum.
class NormalEquations {
 public:
  explicit NormalEquations(const PoseGraph& graph);

  // is_convex: of the headings' loss.
  void fill(std::span<const Pose2> T_map_node, const SensorErrors& errors, bool is_convex = false);

  [[nodiscard]] const ErrorRows& error_rows() const { return rows_; }
  [[nodiscard]] const Eigen::SparseMatrix<double>& hessian() const { return hessian_; }
  [[nodiscard]] const Eigen::VectorXd& gradient() const { return gradient_; }

 private:
  void add_edge(const PoseEdge& edge, std::span<const Pose2> T_map_node, const SensorErrors& errors);
  void add_odometry(const PoseEdge& edge, const Pose2& T_from_to, const ErrorJacobians& jacobians,
                    const Eigen::Vector3d& pull);
  void add_heading(const HeadingPrior& prior, const HeadingLoss& loss);
  void add_expected(const SensorErrors& errors);
  // Of one number: its value, and how sharply it is known to be 0.
  void add_value(int row, double value, double sigma);
  // Of rows (3 a, ...) and columns (3 b, ...); of a block above the diagonal its transpose is added below.
  void add_block(std::size_t a, std::size_t b, const Eigen::Matrix3d& block);

  const PoseGraph& graph_;
  ErrorRows rows_;
  std::vector<Eigen::Triplet<double>> triplets_;
  Eigen::SparseMatrix<double> hessian_;
  Eigen::VectorXd gradient_;
};

}  // namespace cairn
