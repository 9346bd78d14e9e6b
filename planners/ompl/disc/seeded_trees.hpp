// OMPL's RRTConnect and RRT with nothing from OMPL's process-wide seeds, for a first solution: what they draw
// comes from the problem's own samplers, so that searches of several threads need not wait in line.
#pragma once

#include <ompl/datastructures/NearestNeighborsSqrtApprox.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

namespace cairn {

class SeededRrtConnect : public ompl::geometric::RRTConnect {
 public:
  explicit SeededRrtConnect(const ompl::base::SpaceInformationPtr& space) : RRTConnect(space) {
    tStart_ = std::make_shared<ompl::NearestNeighborsSqrtApprox<Motion*>>();
    tGoal_ = std::make_shared<ompl::NearestNeighborsSqrtApprox<Motion*>>();
    rng_.setLocalSeed(1);
  }
};

class SeededRrt : public ompl::geometric::RRT {
 public:
  explicit SeededRrt(const ompl::base::SpaceInformationPtr& space) : RRT(space) {
    nn_ = std::make_shared<ompl::NearestNeighborsSqrtApprox<Motion*>>();
    rng_.setLocalSeed(1);
  }
};

}  // namespace cairn
