// A robot's walk with noisy steps and closures, of which the truth is known.
#pragma once

#include <random>

#include "maps/pose_graph/pose_graph.hpp"

namespace cairn {

struct RandomPoseGraph {
  PoseGraph graph;  // with the poses of dead reckoning
  std::vector<Pose2> truth;
};

// noise: standard deviation of each step and closure, m and rad.
inline RandomPoseGraph random_pose_graph(std::uint64_t seed, std::size_t nodes, std::size_t closures, double noise) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto measured = [&](const Pose2& exact) {
    std::normal_distribution<double> error(0.0, 1.0);
    const double dx_m = noise * error(random);
    const double dy_m = noise * error(random);
    return exact * Pose2{dx_m, dy_m, noise * error(random)};
  };
  RandomPoseGraph made;
  const Eigen::Matrix3d information = Eigen::Matrix3d::Identity() / std::max(noise * noise, 1e-6);
  const auto join = [&](std::size_t from, std::size_t to) {
    made.graph.edges.push_back({from, to, measured(inverse(made.truth[from]) * made.truth[to]), information});
  };
  made.truth.push_back({uniform(-5.0, 5.0), uniform(-5.0, 5.0), uniform(-3.0, 3.0)});
  made.graph.T_map_node = made.truth;
  while (made.truth.size() < nodes) {
    made.truth.push_back(made.truth.back() * Pose2{uniform(0.2, 0.8), uniform(-0.1, 0.1), uniform(-0.6, 0.6)});
    join(made.truth.size() - 2, made.truth.size() - 1);
    made.graph.T_map_node.push_back(made.graph.T_map_node.back() * made.graph.edges.back().T_from_to);
  }
  for (std::size_t i = 0; i < closures; ++i) {
    const std::size_t from = random() % nodes;
    join(from, (from + 2 + random() % (nodes - 3)) % nodes);
  }
  return made;
}

}  // namespace cairn
