#include "planners/ompl/disc/disc_states.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/base/spaces/RealVectorStateProjections.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "maps/base/portable_random.hpp"
#include "maps/geometry/segments.hpp"
#include "planners/common/disc_space/field_box.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {
namespace {

namespace ob = ompl::base;

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
class CellDraw {
 public:
  CellDraw(const SampledCells& samples, std::uint64_t seed) : samples_(&samples), generator_(seed) {}

  [[nodiscard]] Point point() {
    const NumberedCells& cells = samples_->cells;
    const auto index = static_cast<std::size_t>(unit() * static_cast<double>(cells.size()));
    const Point offset{unit() - 0.5, unit() - 0.5};
    return samples_->lattice->field().centre_of(cells[std::min(index, cells.size() - 1)]) +
           offset * samples_->lattice->cell_m();
  }
  [[nodiscard]] double unit() { return static_cast<double>(generator_() >> 11) * 0x1.0p-53; }  // [0, 1)

 private:
  const SampledCells* samples_;
  std::mt19937_64 generator_;
};

class CellSampler : public ob::StateSampler {
 public:
  CellSampler(const ob::StateSpace* plane, const SampledCells& samples, std::uint64_t seed)
      : StateSampler(plane), draw_(samples, seed) {}

  void sampleUniform(ob::State* state) override { set_point(state, draw_.point()); }
  void sampleUniformNear(ob::State* state, const ob::State* near, double distance_m) override {
    const Point offset{2.0 * draw_.unit() - 1.0, 2.0 * draw_.unit() - 1.0};
    set_point(state, point_of(near) + distance_m * offset);
    space_->enforceBounds(state);
  }
  void sampleGaussian(ob::State* state, const ob::State* mean, double deviation_m) override {
    const double angle_rad = 2.0 * std::numbers::pi * draw_.unit();
    const double away_m = deviation_m * std::sqrt(-2.0 * std::log(1.0 - draw_.unit()));
    set_point(state, point_of(mean) + away_m * Point(std::cos(angle_rad), std::sin(angle_rad)));
    space_->enforceBounds(state);
  }

 private:
  CellDraw draw_;
};

// Even along a route, and up to its width beside it.
class GuideDraw {
 public:
  explicit GuideDraw(const Guide& guide) : guide_(guide), length_m_(length_of(guide.route)) {}

  [[nodiscard]] Point point(CellDraw& draw) const {
    double left_m = draw.unit() * length_m_;
    std::size_t i = 1;
    while (i + 1 < guide_.route.size() && left_m > (guide_.route[i] - guide_.route[i - 1]).norm())
      left_m -= (guide_.route[i] - guide_.route[i - 1]).norm(), ++i;
    const Point along = guide_.route[i] - guide_.route[i - 1];
    const double share = std::min(1.0, left_m / std::max(along.norm(), 1e-9));
    const Point off{2.0 * draw.unit() - 1.0, 2.0 * draw.unit() - 1.0};
    return guide_.route[i - 1] + share * along + guide_.width_m * off;
  }

 private:
  const Guide& guide_;
  double length_m_;
};

// Points that a cheaper route may pass: the route to them and on, at the least cost a metre, is below the bound.
class InformedCellSampler : public ob::InformedSampler {
 public:
  static constexpr unsigned kTries = 200;
  static constexpr std::size_t kMaxCounted = 100'000;  // cells, for a measure: of more, every so many

  InformedCellSampler(const ob::ProblemDefinitionPtr& definition, const DiscProblem& problem, std::uint64_t seed)
      : InformedSampler(definition, kTries), problem_(problem), draw_(problem.samples, seed), guide_(problem.guide) {}

  bool sampleUniform(ob::State* state, const ob::Cost& below) override {
    return sampleUniform(state, ob::Cost(0.0), below);
  }
  bool sampleUniform(ob::State* state, const ob::Cost& from, const ob::Cost& below) override {
    for (unsigned i = 0; i < kTries; ++i) {
      const bool is_guided = problem_.guide.share > 0.0 && draw_.unit() < problem_.guide.share;
      const Point p = is_guided ? guide_.point(draw_) : draw_.point();
      const double least = min_through(p);
      if (least < from.value() || least >= below.value()) continue;
      set_point(state, p);
      return true;
    }
    return false;
  }
  [[nodiscard]] bool hasInformedMeasure() const override { return true; }
  [[nodiscard]] double getInformedMeasure(const ob::Cost& below) const override {
    const SampledCells& samples = problem_.samples;
    const std::size_t stride = 1 + samples.cells.size() / kMaxCounted;
    std::size_t inside = 0;
    for (std::size_t i = 0; i < samples.cells.size(); i += stride)
      inside += min_through(samples.lattice->field().centre_of(samples.cells[i])) < below.value() ? 1U : 0U;
    const double cell_m = samples.lattice->cell_m();
    return static_cast<double>(inside * stride) * cell_m * cell_m;
  }

 private:
  [[nodiscard]] double min_through(const Point& p) const {
    return problem_.cost.min_per_m() * ((p - problem_.from).norm() + (problem_.to - p).norm());
  }

  const DiscProblem& problem_;
  CellDraw draw_;
  GuideDraw guide_;
};

class TravelObjective : public ob::OptimizationObjective {
 public:
  TravelObjective(const ob::SpaceInformationPtr& info, const DiscProblem& problem)
      : OptimizationObjective(info), problem_(problem) {
    description_ = "travel cost";
    setCostToGoHeuristic([&problem](const ob::State* state, const ob::Goal*) {
      return ob::Cost(problem.cost.min_per_m() * (problem.to - point_of(state)).norm());
    });
  }

  [[nodiscard]] ob::Cost stateCost(const ob::State*) const override { return identityCost(); }
  [[nodiscard]] ob::Cost motionCost(const ob::State* from, const ob::State* to) const override {
    return ob::Cost(problem_.cost.between_or_blocked(point_of(from), point_of(to)));
  }
  [[nodiscard]] ob::Cost motionCostHeuristic(const ob::State* from, const ob::State* to) const override {
    return ob::Cost(problem_.cost.min_per_m() * (point_of(to) - point_of(from)).norm());
  }
  [[nodiscard]] ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& definition,
                                                                 unsigned) const override {
    return std::make_shared<InformedCellSampler>(definition, problem_,
                                                 mixed_seed(mixed_seed(problem_.seed) + kInformedStream));
  }

 private:
  const DiscProblem& problem_;
};

}  // namespace

Point point_of(const ob::State* state) {
  const double* const values = state->as<PlaneSpace::StateType>()->values;
  return {values[0], values[1]};
}

void set_point(ob::State* state, const Point& p) {
  double* const values = state->as<PlaneSpace::StateType>()->values;
  values[0] = p.x();
  values[1] = p.y();
}

ob::RealVectorBounds bounds_of(const DistanceField& field) {
  const auto [low, high] = box_of(field, field.box());
  ob::RealVectorBounds bounds(2);
  bounds.low = {low.x(), low.y()};
  bounds.high = {high.x(), high.y()};
  return bounds;
}

ob::SpaceInformationPtr space_information(const DiscProblem& problem) {
  const DistanceField& field = problem.space.field();
  auto space = std::make_shared<PlaneSpace>(2);
  space->setBounds(bounds_of(field));
  auto samplers = std::make_shared<std::uint64_t>(0);
  space->setStateSamplerAllocator([&problem, samplers](const ob::StateSpace* plane) {
    return std::make_shared<CellSampler>(plane, problem.samples, mixed_seed(mixed_seed(problem.seed) + ++*samplers));
  });
  auto info = std::make_shared<ob::SpaceInformation>(space);
  info->setStateValidityChecker(
      [&problem](const ob::State* state) { return problem.space.fits(point_of(state), problem.radius_m); });
  info->setMotionValidator(std::make_shared<SegmentValidator>(info, problem.space, problem.radius_m));
  // For what still counts in steps: half a cell.
  info->setStateValidityCheckingResolution(0.5 * field.cell_m() / space->getMaximumExtent());
  info->setup();
  // The identity projection that 1.5.2 has just registered by itself aborts on use.
  auto projection = std::make_shared<ob::RealVectorOrthogonalProjectionEvaluator>(space, std::vector<unsigned>{0, 1});
  projection->setup();
  space->registerDefaultProjection(projection);
  return info;
}

ob::ProblemDefinitionPtr definition_of(const DiscProblem& problem, const ob::SpaceInformationPtr& info) {
  auto definition = std::make_shared<ob::ProblemDefinition>(info);
  ob::ScopedState<PlaneSpace> from(info);
  ob::ScopedState<PlaneSpace> to(info);
  set_point(from.get(), problem.from);
  set_point(to.get(), problem.to);
  definition->setStartAndGoalStates(from, to);
  definition->setOptimizationObjective(std::make_shared<TravelObjective>(info, problem));
  return definition;
}

void add_route(KnownStates& states, const std::vector<Point>& route) {
  constexpr double kMaxSteps = 40.0;
  const double length_m = length_of(route);
  for (std::size_t i = 0; i < route.size(); ++i) {
    const Point& before = route[i == 0 ? 0 : i - 1];
    const int steps =
        std::max(1, static_cast<int>(std::ceil((route[i] - before).norm() / std::max(length_m / kMaxSteps, 1e-9))));
    for (int k = i == 0 ? steps : 1; k <= steps; ++k) {
      set_point(states.add(), k == steps ? route[i] : Point(before + (route[i] - before) * k / steps));
    }
  }
}

}  // namespace cairn
