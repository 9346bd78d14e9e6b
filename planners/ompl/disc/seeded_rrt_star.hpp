// OMPL's InformedRRTstar, begun from a solution that is already known, and with nothing from OMPL's
// process-wide seeds: what it draws comes from the problem's own samplers. So it improves a route, never
// answers worse, gives the same for the same problem, and searches of several threads need not wait in line.
#pragma once

#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>

#include <functional>
#include <vector>

namespace cairn {

class SeededRrtStar : public ompl::geometric::InformedRRTstar {
 public:
  explicit SeededRrtStar(const ompl::base::SpaceInformationPtr& space) : InformedRRTstar(space) {
    nn_ = std::make_shared<ompl::NearestNeighborsLinear<Motion*>>();  // OMPL's trees of neighbours draw pivots by the
                                                                      // seeds
    rng_.setLocalSeed(1);
  }

  // Neighbours are chosen by this instead of the space's own distance, where that is slow to find.
  void choose_neighbours_by(std::function<double(const ompl::base::State*, const ompl::base::State*)> apart) {
    apart_ = std::move(apart);
  }

  void setup() override {
    InformedRRTstar::setup();
    if (apart_)
      nn_->setDistanceFunction([this](const Motion* a, const Motion* b) { return apart_(a->state, b->state); });
  }

  // From the start to the goal, each motion between two of them valid; borrowed until solve() returns.
  void begin_with(std::vector<const ompl::base::State*> solution) { solution_ = std::move(solution); }

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& enough) override {
    checkValidity();
    if (!solution_.empty()) grow_solution();
    return RRTstar::solve(enough);
  }

 private:
  // As if the tree had grown along the solution: RRT* goes on from trees that it finds.
  void grow_solution() {
    while (pis_.haveMoreStartStates()) (void)pis_.nextStart();
    Motion* last = nullptr;
    for (const ompl::base::State* const state : solution_) {
      auto* const motion = new Motion(si_);  // RRT* frees what is in its tree
      si_->copyState(motion->state, state);
      motion->parent = last;
      motion->incCost = last != nullptr ? opt_->motionCost(last->state, motion->state) : opt_->identityCost();
      motion->cost = last != nullptr ? opt_->combineCosts(last->cost, motion->incCost) : opt_->identityCost();
      if (last != nullptr)
        last->children.push_back(motion);
      else
        startMotions_.push_back(motion);
      nn_->add(motion);
      last = motion;
    }
    last->inGoal = true;
    goalMotions_.push_back(last);
    bestGoalMotion_ = last;
    bestCost_ = last->cost;
    solution_.clear();
  }

  std::vector<const ompl::base::State*> solution_;
  std::function<double(const ompl::base::State*, const ompl::base::State*)> apart_;
};

}  // namespace cairn
