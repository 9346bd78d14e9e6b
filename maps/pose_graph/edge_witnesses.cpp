#include "maps/pose_graph/edge_witnesses.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

namespace cairn {
namespace {

// The covariance of an error that happens at a pose of the loop, in that pose's frame, as the loop's first pose sees
// its end.
Eigen::Matrix3d seen_from_first(const Eigen::Matrix3d& covariance, const Pose2& T_first_at) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Identity();
  jacobian.topLeftCorner<2, 2>() = rotation(T_first_at.theta_rad);
  jacobian(0, 2) = T_first_at.y_m;
  jacobian(1, 2) = -T_first_at.x_m;
  return jacobian * covariance * jacobian.transpose();
}

// From the node with the lower number on.
PoseEdge upward(PoseEdge edge) {
  if (edge.from < edge.to) return edge;
  edge.information = seen_from_first(edge.information.inverse(), inverse(edge.T_from_to)).inverse();
  edge.T_from_to = inverse(edge.T_from_to);
  std::swap(edge.from, edge.to);
  return edge;
}

class Way {
 public:
  Way(const PoseGraph& graph, std::span<const Pose2> T_map_node) : T_map_node_(T_map_node) {
    step_.assign(T_map_node.size(), Eigen::Matrix3d::Zero());
    std::vector<bool> is_known(T_map_node.size(), false);
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    double known = 0.0;
    for (const PoseEdge& edge : graph.edges) {
      const Eigen::Matrix3d covariance = edge.information.inverse();
      if (edge.to != edge.from + 1 || is_known[edge.from] || !covariance.allFinite()) continue;
      step_[edge.from] = covariance;
      is_known[edge.from] = true;
      sum += covariance;
      known += 1.0;
    }
    for (std::size_t i = 0; i < step_.size() && known > 0.0; ++i)
      if (!is_known[i]) step_[i] = sum / known;
  }

  // A piece of a loop, which begins at T_first_from: adds its covariance, and returns where it ends.
  Pose2 go(std::size_t from, std::size_t to, const Pose2& T_first_from, Eigen::Matrix3d& covariance) const {
    const Pose2 T_first_map = T_first_from * inverse(T_map_node_[from]);
    for (std::size_t i = std::min(from, to); i < std::max(from, to); ++i)
      covariance += seen_from_first(step_[i], T_first_map * T_map_node_[i + 1]);
    return T_first_map * T_map_node_[to];
  }

 private:
  std::span<const Pose2> T_map_node_;
  std::vector<Eigen::Matrix3d> step_;  // covariance from each node to the next
};

// a.from -> a.to -> b.to -> b.from -> a.from
double chi2_of_loop(const Way& way, const PoseEdge& a, const PoseEdge& b) {
  Eigen::Matrix3d covariance = seen_from_first(a.information.inverse(), a.T_from_to);
  const Pose2 at_b_to = way.go(a.to, b.to, a.T_from_to, covariance);
  covariance += seen_from_first(b.information.inverse(), at_b_to);
  const Pose2 end = way.go(b.from, a.from, at_b_to * inverse(b.T_from_to), covariance);
  const Eigen::Vector3d off(end.x_m, end.y_m, wrap_angle(end.theta_rad));
  return off.dot(covariance.inverse() * off);
}

std::size_t apart(std::size_t a, std::size_t b) {
  return std::max(a, b) - std::min(a, b);
}

}  // namespace

std::vector<bool> have_witnesses(std::span<const PoseEdge> edges, const PoseGraph& graph,
                                 std::span<const Pose2> T_map_node, const WitnessSettings& settings) {
  const Way way(graph, T_map_node);
  std::vector<PoseEdge> up;
  up.reserve(edges.size());
  for (const PoseEdge& edge : edges) up.push_back(upward(edge));
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return up[i].from; });
  std::vector<bool> has(edges.size(), false);
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const PoseEdge& a = up[order[i]];
      const PoseEdge& b = up[order[j]];
      if (apart(a.from, b.from) > settings.nodes_apart) break;
      if (apart(a.to, b.to) > settings.nodes_apart || (a.from == b.from && a.to == b.to)) continue;
      if (has[order[i]] && has[order[j]]) continue;
      if (chi2_of_loop(way, a, b) <= settings.chi2_limit) has[order[i]] = has[order[j]] = true;
    }
  return has;
}

}  // namespace cairn
