// The disc's plane as OMPL sees it: states, validity, motions, samples and objective.
#pragma once

#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <memory>
#include <vector>

#include "planners/common/any_angle/numbered_cells.hpp"
#include "planners/ompl/search/known_states.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

using PlaneSpace = ompl::base::RealVectorStateSpace;

[[nodiscard]] Point point_of(const ompl::base::State* state);
void set_point(ompl::base::State* state, const Point& p);

// The box of the distance field.
[[nodiscard]] ompl::base::RealVectorBounds bounds_of(const DistanceField& field);

// Where samples are drawn from: the cells of a lattice, evenly.
struct SampledCells {
  std::shared_ptr<const DiscSpace> lattice;
  NumberedCells cells;
};

// A route that samples are drawn about: so many of all, up to so far beside it.
struct Guide {
  std::vector<Point> route;
  double share = 0.0;
  double width_m = 0.0;
};

struct DiscProblem {
  const DiscSpace& space;
  double radius_m = 0.0;
  Point from{0.0, 0.0};
  Point to{0.0, 0.0};
  const SampledCells& samples;
  const TravelCost& cost;
  std::uint64_t seed = 1;
  Guide guide{};  // of informed samples
};

// Motions are checked whole, not at steps. What is made borrows the problem.
[[nodiscard]] ompl::base::SpaceInformationPtr space_information(const DiscProblem& problem);
// With start, goal and objective. Informed sampling draws from the samples that may lead to something better.
[[nodiscard]] ompl::base::ProblemDefinitionPtr definition_of(const DiscProblem& problem,
                                                             const ompl::base::SpaceInformationPtr& info);

// The corners of a route, with states between so that none is far from the next.
void add_route(KnownStates& states, const std::vector<Point>& route);

}  // namespace cairn
