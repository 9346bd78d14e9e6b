#include "tests/bench/routes/stock_ompl.hpp"

#include <ompl/base/DiscreteMotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <stdexcept>

namespace cairn {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Space = ob::RealVectorStateSpace;
using Clock = std::chrono::steady_clock;

Point point_of(const ob::State* state) {
  const double* const values = state->as<Space::StateType>()->values;
  return {values[0], values[1]};
}

void set_point(ob::State* state, const Point& p) {
  double* const values = state->as<Space::StateType>()->values;
  values[0] = p.x();
  values[1] = p.y();
}

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

// Writes down what it is asked.
class ListeningValidator : public ob::DiscreteMotionValidator {
 public:
  ListeningValidator(const ob::SpaceInformationPtr& info, std::vector<StraightMotion>& heard)
      : DiscreteMotionValidator(info), heard_(&heard) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    heard_->emplace_back(point_of(from), point_of(to));
    return DiscreteMotionValidator::checkMotion(from, to);
  }
  using ob::DiscreteMotionValidator::checkMotion;

 private:
  std::vector<StraightMotion>* heard_;
};

ob::PlannerPtr planner_of(const std::string& name, const ob::SpaceInformationPtr& info) {
  if (name == "BITstar") return std::make_shared<og::BITstar>(info);
  if (name == "InformedRRTstar") return std::make_shared<og::InformedRRTstar>(info);
  if (name == "RRTstar") return std::make_shared<og::RRTstar>(info);
  if (name == "RRTConnect") return std::make_shared<og::RRTConnect>(info);
  throw std::invalid_argument("no stock planner " + name);
}

}  // namespace

struct StockOmpl::Parts {
  const DiscSpace& space;
  double radius_m;
  double step_m;
  StockValidity validity;

  [[nodiscard]] bool fits(const Point& p) const {
    if (validity == StockValidity::by_distance_field) return space.fits(p, radius_m);
    if (!space.contains(p)) return false;
    const DistanceField& field = space.field();
    const Point half(0.5 * field.cell_m(), 0.5 * field.cell_m());
    const Cell low = field.cell_at(p - Point(radius_m, radius_m));
    const Cell high = field.cell_at(p + Point(radius_m, radius_m));
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) {
        if (!space.is_blocked({x, y})) continue;
        const Point away = ((field.centre_of({x, y}) - p).cwiseAbs() - half).cwiseMax(0.0);
        if (away.squaredNorm() < radius_m * radius_m) return false;
      }
    return true;
  }

  [[nodiscard]] std::shared_ptr<Space> plane() const {
    const DistanceField& field = space.field();
    const Point half(0.5 * field.cell_m(), 0.5 * field.cell_m());
    const Point low = field.centre_of(field.box().min) - half;
    const Point high = field.centre_of(field.box().max) - half;
    auto made = std::make_shared<Space>(2);
    ob::RealVectorBounds bounds(2);
    for (unsigned axis = 0; axis < 2; ++axis) {
      bounds.setLow(axis, low[axis]);
      bounds.setHigh(axis, high[axis]);
    }
    made->setBounds(bounds);
    return made;
  }

  [[nodiscard]] std::unique_ptr<og::SimpleSetup> setup() const {
    auto made = std::make_unique<og::SimpleSetup>(plane());
    made->setStateValidityChecker([this](const ob::State* state) { return fits(point_of(state)); });
    if (step_m > 0.0)
      made->getSpaceInformation()->setStateValidityCheckingResolution(step_m /
                                                                      made->getStateSpace()->getMaximumExtent());
    return made;
  }

  [[nodiscard]] std::unique_ptr<og::SimpleSetup> setup(const std::string& planner, const StraightMotion& ends,
                                                       double enough_m) const {
    auto made = setup();
    ob::ScopedState<Space> from(made->getStateSpace());
    ob::ScopedState<Space> to(made->getStateSpace());
    set_point(from.get(), ends.first);
    set_point(to.get(), ends.second);
    made->setStartAndGoalStates(from, to);
    auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(made->getSpaceInformation());
    objective->setCostThreshold(ob::Cost(enough_m));
    made->setOptimizationObjective(objective);
    made->setPlanner(planner_of(planner, made->getSpaceInformation()));
    return made;
  }
};

StockOmpl::StockOmpl(const DiscSpace& space, double radius_m, double step_m, StockValidity validity)
    : parts_(new Parts{space, radius_m, step_m, validity}) {
  ompl::msg::noOutputHandler();
}

StockOmpl::~StockOmpl() = default;

double StockOmpl::step_m() const {
  const auto setup = parts_->setup();
  setup->getSpaceInformation()->setup();
  return setup->getStateSpace()->getLongestValidSegmentLength();
}

std::size_t StockOmpl::count_valid(const std::vector<StraightMotion>& motions) const {
  const auto setup = parts_->setup();
  const ob::SpaceInformationPtr info = setup->getSpaceInformation();
  info->setup();
  ob::ScopedState<Space> from(info);
  ob::ScopedState<Space> to(info);
  std::size_t valid = 0;
  for (const auto& [a, b] : motions) {
    set_point(from.get(), a);
    set_point(to.get(), b);
    if (info->checkMotion(from.get(), to.get())) ++valid;
  }
  return valid;
}

StockAnswer StockOmpl::solve(const std::string& planner, const StraightMotion& ends, double enough_m,
                             double limit_s) const {
  StockAnswer answer;
  const auto begin = Clock::now();
  const auto setup = parts_->setup(planner, ends, enough_m);
  const bool anytime = planner != "RRTConnect";
  for (;;) {
    setup->solve(std::max(0.0, limit_s - seconds_since(begin)));
    if (setup->haveExactSolutionPath()) {
      if (!anytime) setup->simplifySolution();
      const og::PathGeometric& path = setup->getSolutionPath();
      if (!answer.exact || path.length() < answer.length_m) {
        answer = {true, {}, path.length(), 0.0};
        for (std::size_t i = 0; i < path.getStateCount(); ++i)
          answer.path.push_back(point_of(path.getState(static_cast<unsigned>(i))));
      }
    }
    answer.took_s = seconds_since(begin);
    if (anytime || answer.took_s >= limit_s || (answer.exact && answer.length_m <= enough_m)) return answer;
    setup->clear();
  }
}

std::vector<StraightMotion> StockOmpl::motions_asked(const std::string& planner, const StraightMotion& ends,
                                                     std::size_t count, double limit_s) const {
  std::vector<StraightMotion> heard;
  const auto setup = parts_->setup(planner, ends, 0.0);
  const ob::SpaceInformationPtr info = setup->getSpaceInformation();
  info->setMotionValidator(std::make_shared<ListeningValidator>(info, heard));
  const auto begin = Clock::now();
  setup->solve(
      ob::PlannerTerminationCondition([&] { return heard.size() >= count || seconds_since(begin) >= limit_s; }));
  if (heard.size() > count) heard.resize(count);
  return heard;
}

}  // namespace cairn
