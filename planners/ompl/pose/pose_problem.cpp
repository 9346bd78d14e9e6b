#include "planners/ompl/pose/pose_problem.hpp"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/samplers/InformedStateSampler.h>

#include <algorithm>

#include "maps/base/portable_random.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;

constexpr double kTurnStep = 0.2;  // radians between the points by which an arc is counted

double min_through(const PoseProblem& problem, const Point& p) {
  const Point to = problem.goals.front().position();
  return problem.cost.min_per_m() * ((p - problem.from.position()).norm() + (to - p).norm());
}

// Poses that a cheaper path may pass.
class InformedPoseSampler : public ob::InformedSampler {
 public:
  static constexpr unsigned kTries = 200;

  InformedPoseSampler(const ob::ProblemDefinitionPtr& definition, const PoseProblem& problem)
      : InformedSampler(definition, kTries),
        problem_(problem),
        sampler_(space_.get(), problem.poses.ground().field(), problem.draw,
                 mixed_seed(mixed_seed(problem.seed) + kInformedStream)) {}

  bool sampleUniform(ob::State* state, const ob::Cost& below) override {
    return sampleUniform(state, ob::Cost(0.0), below);
  }
  bool sampleUniform(ob::State* state, const ob::Cost& from, const ob::Cost& below) override {
    for (unsigned i = 0; i < kTries; ++i) {
      sampler_.sampleUniform(state);
      const double least = min_through(problem_, pose_of(state).position());
      if (least >= from.value() && least < below.value()) return true;
    }
    return false;
  }
  [[nodiscard]] bool hasInformedMeasure() const override { return false; }
  [[nodiscard]] double getInformedMeasure(const ob::Cost& /*below*/) const override { return space_->getMeasure(); }

 private:
  const PoseProblem& problem_;
  PoseSampler sampler_;
};

class MotionObjective : public ob::OptimizationObjective {
 public:
  MotionObjective(const ob::SpaceInformationPtr& info, const PoseProblem& problem)
      : OptimizationObjective(info), problem_(problem) {
    description_ = "cost of motions";
    setCostToGoHeuristic([&problem](const ob::State* state, const ob::Goal*) {
      const Point to = problem.goals.front().position();
      return ob::Cost(problem.cost.min_per_m() * (to - pose_of(state).position()).norm());
    });
  }

  [[nodiscard]] ob::Cost stateCost(const ob::State*) const override { return identityCost(); }
  [[nodiscard]] ob::Cost motionCost(const ob::State* from, const ob::State* to) const override {
    if (problem_.cost.is_length()) return ob::Cost(si_->distance(from, to));
    return ob::Cost(cost_of(problem_, motion_between(*si_->getStateSpace(), from, to)));
  }
  [[nodiscard]] ob::Cost motionCostHeuristic(const ob::State* from, const ob::State* to) const override {
    return ob::Cost(problem_.cost.min_per_m() * (pose_of(to).position() - pose_of(from).position()).norm());
  }
  [[nodiscard]] ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& definition,
                                                                 unsigned) const override {
    return std::make_shared<InformedPoseSampler>(definition, problem_);
  }

 private:
  const PoseProblem& problem_;
};

}  // namespace

double cost_of(const PoseProblem& problem, const Motion& motion) {
  if (problem.cost.is_length()) return motion.extent_m();
  double sum =
      problem.cost.is_in_metres() ? motion.extent_m() - motion.length_m() : motion.spot_turn_rad() / problem.turn_radps;
  const std::vector<Pose2> poses = motion.sampled(10.0 * problem.poses.ground().cell_m(), kTurnStep);
  for (std::size_t i = 1; i < poses.size(); ++i)
    sum += problem.cost.between(poses[i - 1].position(), poses[i].position());
  return sum;
}

ob::ProblemDefinitionPtr definition_of(const PoseProblem& problem, const ob::SpaceInformationPtr& info) {
  auto definition = std::make_shared<ob::ProblemDefinition>(info);
  ob::ScopedState<ob::SE2StateSpace> state(info);
  set_pose(state.get(), problem.from);
  definition->addStartState(state);
  auto goals = std::make_shared<ob::GoalStates>(info);
  for (const Pose2& goal : problem.goals) {
    set_pose(state.get(), goal);
    goals->addState(state);
  }
  definition->setGoal(goals);
  definition->setOptimizationObjective(std::make_shared<MotionObjective>(info, problem));
  return definition;
}

std::vector<Motion> motions_of(const ob::StateSpace& space, const std::vector<Pose2>& poses) {
  std::vector<Motion> motions;
  for (std::size_t i = 1; i < poses.size(); ++i) motions.push_back(motion_between(space, poses[i - 1], poses[i]));
  return motions;
}

std::vector<Pose2> poses_of(const ompl::geometric::PathGeometric& path) {
  std::vector<Pose2> poses;
  for (std::size_t i = 0; i < path.getStateCount(); ++i)
    poses.push_back(pose_of(path.getState(static_cast<unsigned>(i))));
  return poses;
}

}  // namespace cairn
