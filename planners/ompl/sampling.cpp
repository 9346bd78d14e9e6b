#include "planners/ompl/sampling.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/SpaceInformation.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateProjections.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <random>

#include "planners/ompl/algorithm_factory.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Space = ob::RealVectorStateSpace;

constexpr int kShortcutRounds = 5;

Point point_of(const ob::State* state) {
  const double* const values = state->as<Space::StateType>()->values;
  return {values[0], values[1]};
}

void set_point(ob::State* state, const Point& p) {
  double* const values = state->as<Space::StateType>()->values;
  values[0] = p.x();
  values[1] = p.y();
}

std::uint64_t mixed(std::uint64_t seed) {  // splitmix64: neighbouring seeds give unrelated streams
  seed += 0x9e3779b97f4a7c15U;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebU;
  return seed ^ (seed >> 31);
}

// Whole segments, exactly; OMPL's own validator samples them.
class SegmentValidator : public ob::MotionValidator {
 public:
  SegmentValidator(const ob::SpaceInformationPtr& info, const DiscSpace& space, double radius_m)
      : MotionValidator(info), space_(&space), radius_m_(radius_m) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return space_->fits_along(point_of(from), point_of(to), radius_m_);
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(from, to)) return true;
    const Point a = point_of(from);
    const Point b = point_of(to);
    last_valid.second = space_->share_that_fits(a, b, radius_m_);
    if (last_valid.first != nullptr) set_point(last_valid.first, a + last_valid.second * (b - a));
    return false;
  }

 private:
  const DiscSpace* space_;
  double radius_m_;
};

// Even over the given cells, from its own generator.
class CellSampler : public ob::StateSampler {
 public:
  CellSampler(const ob::StateSpace* ompl_space, const DiscSpace& space, const std::vector<Cell>& cells,
              std::uint64_t seed)
      : StateSampler(ompl_space), space_disc_(&space), cells_(&cells), generator_(seed) {}

  void sampleUniform(ob::State* state) override {
    const auto index = static_cast<std::size_t>(unit() * static_cast<double>(cells_->size()));
    const Cell cell = (*cells_)[std::min(index, cells_->size() - 1)];
    const Point offset{unit() - 0.5, unit() - 0.5};
    set_point(state, space_disc_->field().centre_of(cell) + offset * space_disc_->cell_m());
  }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance_m) override {
    set_point(state, point_of(near) + distance_m * Point(2.0 * unit() - 1.0, 2.0 * unit() - 1.0));
    space_->enforceBounds(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation_m) override {
    const double angle_rad = radians(360.0 * unit());
    const double away_m = deviation_m * std::sqrt(-2.0 * std::log(1.0 - unit()));
    set_point(state, point_of(mean) + away_m * Point(std::cos(angle_rad), std::sin(angle_rad)));
    space_->enforceBounds(state);
  }

 private:
  double unit() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }  // [0, 1)

  const DiscSpace* space_disc_;
  const std::vector<Cell>* cells_;
  std::mt19937_64 generator_;
};

// One holder at a time in the process, because the seeds of all of OMPL's generators come from one place.
// Not a timed mutex: thread sanitizers of this compiler do not know those.
class OmplTurn {
 public:
  // Waits for its turn until the budget is exhausted.
  explicit OmplTurn(const Budget& budget) {
    std::unique_lock lock(gate().mutex);
    while (gate().taken && !budget.exhausted()) gate().freed.wait_for(lock, std::chrono::milliseconds(2));
    is_mine_ = !gate().taken;
    gate().taken = true;
  }
  ~OmplTurn() {
    if (!is_mine_) return;
    {
      const std::lock_guard lock(gate().mutex);
      gate().taken = false;
    }
    gate().freed.notify_one();
  }
  OmplTurn(const OmplTurn&) = delete;
  OmplTurn& operator=(const OmplTurn&) = delete;

  [[nodiscard]] bool is_mine() const { return is_mine_; }

 private:
  struct Gate {
    std::mutex mutex;
    std::condition_variable freed;
    bool taken = false;
  };
  static Gate& gate() {
    static Gate gate;
    return gate;
  }

  bool is_mine_ = false;
};

ob::SpaceInformationPtr space_information(const SamplingTask& task) {
  const DistanceField& field = task.space.field();
  const CellBox box = field.box();
  const double half_m = 0.5 * field.cell_m();
  const Point low = field.centre_of(box.min) - Point(half_m, half_m);
  const Point high = field.centre_of({box.max.x - 1, box.max.y - 1}) + Point(half_m, half_m);
  auto space = std::make_shared<Space>(2);
  ob::RealVectorBounds bounds(2);
  for (int axis = 0; axis < 2; ++axis) {
    bounds.setLow(static_cast<unsigned>(axis), low[axis]);
    bounds.setHigh(static_cast<unsigned>(axis), high[axis]);
  }
  space->setBounds(bounds);
  auto samplers = std::make_shared<std::uint64_t>(0);
  space->setStateSamplerAllocator([&task, samplers](const ob::StateSpace* ompl_space) {
    return std::make_shared<CellSampler>(ompl_space, task.space, task.cells, mixed(mixed(task.seed) + ++*samplers));
  });
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker(
      [&task](const ob::State* state) { return task.space.fits(point_of(state), task.radius_m); });
  info->setMotionValidator(std::make_shared<SegmentValidator>(info, task.space, task.radius_m));
  // For what still counts in steps: half a cell.
  info->setStateValidityCheckingResolution(half_m / space->getMaximumExtent());
  info->setup();
  // The identity projection that 1.5.2 has just registered by itself aborts on use.
  auto projection = std::make_shared<ob::RealVectorOrthogonalProjectionEvaluator>(space, std::vector<unsigned>{0, 1});
  projection->setup();
  space->registerDefaultProjection(projection);
  return info;
}

ob::ProblemDefinitionPtr problem_of(const SamplingTask& task, const ob::SpaceInformationPtr& info) {
  auto problem = std::make_shared<ob::ProblemDefinition>(info);
  ob::ScopedState<Space> from(info);
  ob::ScopedState<Space> to(info);
  set_point(from.get(), task.from);
  set_point(to.get(), task.to);
  problem->setStartAndGoalStates(from, to);
  problem->setOptimizationObjective(std::make_shared<ob::PathLengthOptimizationObjective>(info));
  return problem;
}

// SimpleSetup of 1.5.2 builds its simplifier without the objective; here it is given.
void simplify(og::PathGeometric& path, const ob::SpaceInformationPtr& info, const ob::ProblemDefinitionPtr& problem,
              const Budget& budget) {
  og::PathSimplifier simplifier(info, ob::GoalPtr(), problem->getOptimizationObjective());
  simplifier.reduceVertices(path);
  simplifier.collapseCloseVertices(path);
  for (int round = 0; round < kShortcutRounds && !budget.exhausted(); ++round)
    if (!simplifier.shortcutPath(path)) break;
  simplifier.reduceVertices(path);
}

bool takes(ob::Planner& planner, const std::string& name, const std::string& value) {
  try {
    return planner.params().setParam(name, value);
  } catch (const std::exception&) {  // a number that is none, or one the algorithm refuses
    return false;
  }
}

SamplingAnswer search(const SamplingTask& task, const Budget& budget) {
  ompl::msg::noOutputHandler();
  ompl::RNG::setSeed(1 + mixed(task.seed) % 1'000'000'000U);
  const ob::SpaceInformationPtr info = space_information(task);
  const ob::ProblemDefinitionPtr problem = problem_of(task, info);
  const ob::PlannerPtr planner = make_algorithm(task.algorithm, info);
  for (const auto& [name, value] : task.parameters) planner->params().setParam(name, value);
  planner->setProblemDefinition(problem);
  planner->setup();

  SamplingAnswer answer;
  std::int64_t asked = 0;
  const ob::PlannerTerminationCondition enough([&] {
    answer.interrupted = answer.interrupted || budget.exhausted();
    return answer.interrupted || ++asked > task.iterations;
  });
  planner->solve(enough);
  const ob::PathPtr found = problem->getSolutionPath();
  if (!found) return answer;
  answer.exact = problem->hasExactSolution();
  auto& path = static_cast<og::PathGeometric&>(*found);
  if (task.simplify) simplify(path, info, problem, budget);
  for (const ob::State* state : path.getStates()) answer.route.push_back(point_of(state));
  return answer;
}

}  // namespace

AlgorithmParameters checked_parameters(Algorithm algorithm, const ConfigValue& parameters) {
  if (parameters.kind == ConfigValue::Kind::null) return {};
  if (parameters.kind != ConfigValue::Kind::map)
    throw ConfigError(parameters.place,
                      "parameters must be a map of OMPL's parameter names, not " + parameters.kind_name());
  const OmplTurn turn{Budget{}};
  ompl::msg::noOutputHandler();
  auto space = std::make_shared<Space>(2);
  space->setBounds(0.0, 1.0);
  const ob::PlannerPtr planner = make_algorithm(algorithm, std::make_shared<ob::SpaceInformation>(space));
  std::vector<std::string> names;
  planner->params().getParamNames(names);
  AlgorithmParameters checked;
  for (const ConfigValue::Entry& entry : parameters.entries) {
    if (!planner->params().hasParam(entry.key))
      throw ConfigError(entry.key_place, planner->getName() + " has no parameter \"" + entry.key + "\"" +
                                             did_you_mean(entry.key, names));
    if (entry.value.kind != ConfigValue::Kind::scalar || !takes(*planner, entry.key, entry.value.scalar))
      throw ConfigError(entry.value.place, "parameter " + entry.key + " of " + planner->getName() +
                                               " does not take \"" + entry.value.scalar + "\"");
    checked.emplace_back(entry.key, entry.value.scalar);
  }
  return checked;
}

SamplingAnswer search_by_sampling(const SamplingTask& task, const Budget& budget) {
  const OmplTurn turn(budget);
  if (!turn.is_mine()) return {{}, false, true};
  return search(task, budget);
}

}  // namespace cairn
