// One search by an OMPL planner for a disc on a grid: from validated ends to corner points.
//
// Deterministic for a seed, from any number of threads: OMPL seeds its generators from one process-wide
// source, so one search runs at a time, with that source set anew; states are drawn by a sampler of our
// own, evenly over the cells that can be reached.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/config_value.hpp"
#include "framework/contracts/budget.hpp"
#include "planners/disc_space/disc_space.hpp"
#include "planners/ompl/algorithms.hpp"

namespace cairn {

using AlgorithmParameters = std::vector<std::pair<std::string, std::string>>;

// Checks a map of OMPL's own parameters against those of the algorithm. Throws ConfigError with the
// place and the nearest name.
[[nodiscard]] AlgorithmParameters checked_parameters(Algorithm algorithm, const ConfigValue& parameters);

struct SamplingTask {
  const DiscSpace& space;
  double radius_m = 0.0;
  Point from{0.0, 0.0};
  Point to{0.0, 0.0};
  std::vector<Cell> cells;  // to draw states from
  Algorithm algorithm = Algorithm::rrt_connect;
  const AlgorithmParameters& parameters;
  std::int64_t iterations = 0;  // how often the termination condition may be asked
  bool simplify = true;
  std::uint64_t seed = 1;
};

struct SamplingAnswer {
  std::vector<Point> route;  // empty: none found
  bool exact = false;        // otherwise it ends short of the goal
  bool interrupted = false;  // by the budget's deadline or cancel flag
};

[[nodiscard]] SamplingAnswer search_by_sampling(const SamplingTask& task, const Budget& budget);

}  // namespace cairn
