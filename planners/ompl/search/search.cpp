#include "planners/ompl/search/search.hpp"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "maps/base/portable_random.hpp"
#include "planners/ompl/disc/seeded_rrt_star.hpp"
#include "planners/ompl/search/algorithm_factory.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr int kShortcutRounds = 5;
constexpr std::size_t kMaxCollapsed = 64;  // states: OMPL measures between all pairs first, and nothing ends that

// One holder at a time in the process, because the seeds of all of OMPL's generators come from one place.
// Not a timed mutex: thread sanitizers of this compiler do not know those.
class OmplTurn {
 public:
  // Waits for its turn until the budget is exhausted.
  explicit OmplTurn(const Budget& budget) {
    std::unique_lock lock(slot().mutex);
    while (slot().taken && !budget.exhausted()) slot().freed.wait_for(lock, std::chrono::milliseconds(2));
    is_mine_ = !slot().taken;
    slot().taken = true;
  }
  ~OmplTurn() {
    if (!is_mine_) return;
    {
      const std::lock_guard lock(slot().mutex);
      slot().taken = false;
    }
    slot().freed.notify_one();
  }
  OmplTurn(const OmplTurn&) = delete;
  OmplTurn& operator=(const OmplTurn&) = delete;

  [[nodiscard]] bool is_mine() const { return is_mine_; }

 private:
  struct Slot {
    std::mutex mutex;
    std::condition_variable freed;
    bool taken = false;
  };
  static Slot& slot() {
    static Slot slot;
    return slot;
  }

  bool is_mine_ = false;
};

// SimpleSetup of 1.5.2 builds its simplifier without the objective; here it is given, and its own seed.
class Simplifier : public og::PathSimplifier {
 public:
  Simplifier(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem, std::uint64_t seed)
      : PathSimplifier(space, ob::GoalPtr(), problem->getOptimizationObjective()) {
    rng_.setLocalSeed(static_cast<std::uint_fast32_t>(1 + mixed_seed(seed) % 1'000'000'000U));
  }

  void simplify_within(og::PathGeometric& path, const Budget& budget) {
    if (!budget.exhausted()) reduceVertices(path);
    if (!budget.exhausted() && path.getStateCount() <= kMaxCollapsed) collapseCloseVertices(path);
    for (int round = 0; round < kShortcutRounds && !budget.exhausted(); ++round)
      if (!shortcutPath(path)) break;
    if (!budget.exhausted()) reduceVertices(path);
  }
};

}  // namespace

SearchAnswer search_by(ob::Planner& planner, const ob::ProblemDefinitionPtr& problem, const SearchRules& rules,
                       const Budget& budget) {
  ompl::msg::noOutputHandler();
  for (const auto& [name, value] : rules.parameters) planner.params().setParam(name, value);
  planner.setProblemDefinition(problem);
  planner.setup();
  SearchAnswer answer;
  std::int64_t asked = 0;
  const ob::PlannerTerminationCondition enough([&] {
    answer.interrupted = answer.interrupted || budget.exhausted();
    return answer.interrupted || ++asked > rules.iterations;
  });
  planner.solve(enough);
  const ob::PathPtr found = problem->getSolutionPath();
  if (!found) return answer;
  answer.exact = problem->hasExactSolution();
  answer.path = std::static_pointer_cast<og::PathGeometric>(found);
  if (rules.simplify)
    Simplifier(planner.getSpaceInformation(), problem, rules.seed).simplify_within(*answer.path, budget);
  return answer;
}

SearchAnswer search(const ob::SpaceInformationPtr& space, const ob::ProblemDefinitionPtr& problem,
                    const SearchRules& rules, const Budget& budget, const std::vector<const ob::State*>& known) {
  ompl::msg::noOutputHandler();
  if (rules.algorithm == Algorithm::any_angle_rrt_star) {
    SeededRrtStar planner(space);
    planner.begin_with(known);
    if (const auto* const poses = dynamic_cast<const ob::SE2StateSpace*>(space->getStateSpace().get()))
      planner.choose_neighbours_by([poses](const ob::State* a, const ob::State* b) {
        return poses->ob::SE2StateSpace::distance(a, b);  // of kinematic spaces too: place and heading
      });
    return search_by(planner, problem, rules, budget);
  }
  const OmplTurn turn(budget);
  if (!turn.is_mine()) return {nullptr, false, true};
  ompl::RNG::setSeed(1 + mixed_seed(rules.seed) % 1'000'000'000U);
  return search_by(*make_algorithm(rules.algorithm, space), problem, rules, budget);
}

}  // namespace cairn
