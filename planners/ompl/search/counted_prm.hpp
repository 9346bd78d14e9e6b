// PRM and PRM* in one thread and without a clock.
//
// OMPL's own solve() grows the roadmap in slices of wall-clock time while a second thread looks for a
// route, so that its answer differs from run to run. The parts are sound; only solve() is replaced.
#pragma once

#include <ompl/geometric/planners/prm/PRM.h>

namespace cairn {

class CountedPrm : public ompl::geometric::PRM {
 public:
  enum class Stop { at_first_route, when_told };

  CountedPrm(const ompl::base::SpaceInformationPtr& space, Stop stop)
      : PRM(space, stop == Stop::when_told), stop_(stop) {}

  ompl::base::PlannerStatus solve(const ompl::base::PlannerTerminationCondition& enough) override {
    using ompl::base::PlannerStatus;
    checkValidity();
    while (const ompl::base::State* state = pis_.nextStart()) startM_.push_back(addMilestone(si_->cloneState(state)));
    while (const ompl::base::State* state = pis_.nextGoal()) goalM_.push_back(addMilestone(si_->cloneState(state)));
    if (startM_.empty()) return PlannerStatus::INVALID_START;
    if (goalM_.empty()) return PlannerStatus::INVALID_GOAL;

    bestCost_ = opt_->infiniteCost();
    growRoadmap(ompl::base::PlannerTerminationCondition(
        [&] { return enough || (stop_ == Stop::at_first_route && sameComponent(startM_.front(), goalM_.front())); }));
    ompl::base::PathPtr route;
    maybeConstructSolution(startM_, goalM_, route);
    if (!route) return PlannerStatus::TIMEOUT;
    pdef_->addSolutionPath(route);
    return PlannerStatus::EXACT_SOLUTION;
  }

 private:
  Stop stop_;
};

}  // namespace cairn
