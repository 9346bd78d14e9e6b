#include "maps/pose_graph/left_out_fits.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "maps/pose_graph/normal_equations.hpp"

namespace cairn {
namespace {

constexpr double kLeastArea_m2 = 1.0;

using Solver = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

Eigen::Matrix3d symmetric(const Eigen::Matrix3d& matrix) {
  return 0.5 * (matrix + matrix.transpose());
}

double area_of(std::span<const Pose2> T_map_node) {
  Eigen::AlignedBox2d box;
  for (const Pose2& pose : T_map_node) box.extend(pose.position());
  return std::max(kLeastArea_m2, box.volume());
}

// Of the edge's error, as the graph that the solver holds knows it.
Eigen::Matrix3d covariance_of(const PoseEdge& edge, const ErrorJacobians& jacobians, const Solver& solver) {
  const auto from = static_cast<Eigen::Index>(3 * edge.from);
  const auto to = static_cast<Eigen::Index>(3 * edge.to);
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(solver.rows(), 3);
  right.middleRows<3>(from) = jacobians.by_from.transpose();
  right.middleRows<3>(to) = jacobians.by_to.transpose();
  const Eigen::MatrixXd solved = solver.solve(right);
  return symmetric(jacobians.by_from * solved.middleRows<3>(from) + jacobians.by_to * solved.middleRows<3>(to));
}

LeftOutFit fit_of(const PoseEdge& edge, bool is_part, const Solver& solver, std::span<const Pose2> T_map_node,
                  double area_m2) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  const Pose2& T_map_from = T_map_node[edge.from];
  const Pose2& T_map_to = T_map_node[edge.to];
  Eigen::Vector3d error = error_of(edge, T_map_from, T_map_to);
  Eigen::Matrix3d rest = covariance_of(edge, jacobians_of(edge, T_map_from, T_map_to), solver);
  if (is_part) {
    // The edge taken out again: both its pull and its information.
    const Eigen::Matrix3d back = (Eigen::Matrix3d::Identity() - rest * edge.information).inverse();
    error = back * error;
    rest = symmetric(back * rest);
  }
  const Eigen::Matrix3d covariance = edge.information.inverse() + rest;
  const double determinant = covariance.determinant();
  LeftOutFit fit;
  fit.chi2 = error.dot(covariance.inverse() * error);
  fit.log_odds = std::log(kTurn * area_m2) - 0.5 * (fit.chi2 + std::log(kTurn * kTurn * kTurn * determinant));
  if (!(determinant > 0.0) || !std::isfinite(fit.chi2) || fit.chi2 < 0.0)
    fit = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  return fit;
}

}  // namespace

std::vector<LeftOutFit> left_out_fits(const PoseGraph& graph, std::span<const PoseEdge> edges,
                                      const std::vector<bool>& is_part, const std::vector<bool>& is_asked,
                                      const std::vector<Pose2>& T_map_node) {
  PoseGraph whole{T_map_node, graph.edges, graph.headings, graph.expected, graph.errors};
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (is_part[i]) whole.edges.push_back(edges[i]);
  NormalEquations equations(whole);
  equations.fill(T_map_node, graph.errors);
  const Solver solver(equations.hessian());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<LeftOutFit> fits(edges.size(), {kInfinity, -kInfinity});
  if (solver.info() != Eigen::Success) return fits;
  const double area_m2 = area_of(T_map_node);
  for (std::size_t i = 0; i < edges.size(); ++i)
    if (is_asked[i]) fits[i] = fit_of(edges[i], is_part[i], solver, T_map_node, area_m2);
  return fits;
}

}  // namespace cairn
