// Poses and what was measured between them: the graph by which a map is bent.
//
// An edge states T_from_to with an information matrix over (x, y, theta) in the frame of `from`'s measurement, as g2o
// writes it. Its error is e = (R_z' (R_from' (t_to - t_from) - t_z), wrap(theta_to - theta_from - theta_z)), its chi2
// e' I e. A heading is a compass reading of a node in the map.
//
// Wheels that count too much and a compass that is off are errors of the sensors; where the graph expects some of them,
// they are found together with the poses. Of a step of odometry the counted length and turn are (1 + ratio) times the
// true ones, and the noise is that of what was counted: so that a smaller map is no better map. A compass reads the
// heading, a bias of the whole run, and one that changes along the way (a first-order Gauss-Markov process).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/pose_graph/sensor_errors.hpp"

namespace cairn {

struct PoseEdge {
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 T_from_to;
  Eigen::Matrix3d information = Eigen::Matrix3d::Identity();  // 1/m2, 1/(m rad), 1/rad2; symmetric, not negative
  bool is_odometry = false;  // counted by the wheels, less than half a turn: their errors apply
};

struct HeadingPrior {
  static constexpr std::size_t kTrue = std::numeric_limits<std::size_t>::max();

  std::size_t node = 0;
  double heading_rad = 0.0;
  double information = 1.0;   // 1/rad2
  std::size_t group = kTrue;  // of readings with one local bias, numbered along the way; kTrue: no bias at all
  double limit_sigmas = 0.0;  // a reading further off than that counts less the further it is off; 0: all alike

  [[nodiscard]] bool is_biased() const { return group != kTrue; }
};

struct PoseGraph {
  std::vector<Pose2> T_map_node;  // as believed so far
  std::vector<PoseEdge> edges;
  std::vector<HeadingPrior> headings;
  ExpectedErrors expected{};
  SensorErrors errors{};  // as believed so far
};

// Turns a vector by the angle.
[[nodiscard]] Eigen::Matrix2d rotation(double angle_rad);
// (x_m, y_m, theta_rad) of the error above.
[[nodiscard]] Eigen::Vector3d error_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to);
// The same by what the sensors say too much.
[[nodiscard]] Eigen::Vector3d error_of(const PoseEdge& edge, const Pose2& T_map_from, const Pose2& T_map_to,
                                       const SensorErrors& errors);
[[nodiscard]] double chi2_of(const PoseEdge& edge, std::span<const Pose2> T_map_node, const SensorErrors& errors = {});
// Of all edges and headings, and of the sensors' errors themselves.
[[nodiscard]] double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node, const SensorErrors& errors,
                             bool is_convex = false);
// By the errors that the graph believes so far.
[[nodiscard]] double chi2_of(const PoseGraph& graph, std::span<const Pose2> T_map_node);

// How many groups its headings have.
[[nodiscard]] std::size_t groups_of(const PoseGraph& graph);
// What the compass reads too much in a group.
[[nodiscard]] double bias_of(const HeadingPrior& prior, const SensorErrors& errors);
// How far off a heading is, and what that counts for. Beyond the limit c of standard deviations e the loss is
// 3 c^2 - 2 c^3 / e, which is bounded: steel beside the way turns a compass by any angle. Convex: 2 c e - c^2 (Huber).
struct HeadingLoss {
  double error_rad = 0.0;
  double chi2 = 0.0;
  double information = 0.0;  // by which the error pulls
};
[[nodiscard]] HeadingLoss loss_of(const HeadingPrior& prior, double theta_rad, const SensorErrors& errors,
                                  bool is_convex = false);

}  // namespace cairn
