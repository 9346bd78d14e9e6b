// Planners that break their contracts.
#include "tests/conformance/faulty/faulty_modules.hpp"
#include "tests/conformance/path_planner.hpp"
#include "tests/conformance/planner.hpp"
#include "tests/conformance/route_planner.hpp"

namespace cairn::conformance {
namespace {

class WrappedPlanner : public Planner {
 public:
  explicit WrappedPlanner(std::shared_ptr<Planner> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    return inner_->plan(request, world, budget);
  }

 protected:
  std::shared_ptr<Planner> inner_;
};

class StubbornPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world, const Budget&) const override {
    return inner_->plan(request, world, Budget{});
  }
};

class ThinPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    PlanRequest thin = request;
    thin.radius_m = 0.0;
    return inner_->plan(thin, world, budget);
  }
};

// Straight through everything.
class BlindPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    PlanResult result = inner_->plan(request, world, budget);
    if (!request.from.pose || !request.to.pose || budget.exhausted()) return result;
    result.outcome = PlanOutcome::solved;
    result.path = {*request.from.pose, *request.to.pose};
    result.length_m = length_of(result.path);
    return result;
  }
};

// Remembers an answer under its two ends, whatever has become of the map.
class ForgetfulPlanner : public WrappedPlanner {
 public:
  using WrappedPlanner::WrappedPlanner;
  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    if (!request.from.pose || !request.to.pose) return inner_->plan(request, world, budget);
    const std::string key = text_of(*request.from.pose) + text_of(*request.to.pose);
    const std::lock_guard lock(mutex_);
    const auto known = answers_.find(key);
    if (known != answers_.end()) return known->second;
    return answers_[key] = inner_->plan(request, world, budget);
  }

 private:
  mutable std::mutex mutex_;
  mutable std::map<std::string, PlanResult> answers_;
};

Subject<Planner> shipped_planner() {
  return module<Planner>(kModules, "ompl", "{iterations: 300}");
}
INSTANTIATE_TEST_SUITE_P(Faulty, PlannerConformance,
                         testing::Values(wrapped<Planner, StubbornPlanner>("ignores cancel", shipped_planner()),
                                         wrapped<Planner, ThinPlanner>("forgets the radius", shipped_planner()),
                                         wrapped<Planner, BlindPlanner>("sees no walls", shipped_planner()),
                                         wrapped<Planner, ForgetfulPlanner>("keeps old answers", shipped_planner())));

class WrappedPathPlanner : public PathPlanner {
 public:
  explicit WrappedPathPlanner(std::shared_ptr<PathPlanner> inner) : inner_(std::move(inner)) {}
  [[nodiscard]] PlannerTraits traits() const override { return inner_->traits(); }
  [[nodiscard]] PathResult plan(const PathRequest& request, const WorldView& world,
                                const Budget& budget) const override {
    return inner_->plan(request, world, budget);
  }

 protected:
  std::shared_ptr<PathPlanner> inner_;
};

// Says that it keeps a margin, and that it stays on known ground.
class PretendingPathPlanner : public WrappedPathPlanner {
 public:
  using WrappedPathPlanner::WrappedPathPlanner;
  [[nodiscard]] PlannerTraits traits() const override { return {.margin_m = 0.1}; }
};

class MoodyPathPlanner : public WrappedPathPlanner {
 public:
  using WrappedPathPlanner::WrappedPathPlanner;
  [[nodiscard]] PlannerTraits traits() const override { return {.margin_m = 0.001 * ++asked_}; }

 private:
  mutable int asked_ = 0;
};

INSTANTIATE_TEST_SUITE_P(
    Faulty, PathPlannerConformance,
    testing::Values(
        wrapped<PathPlanner, PretendingPathPlanner>("promises what it does not keep",
                                                    module<PathPlanner>(kModules, "ompl", "{unknown: allow}")),
        wrapped<PathPlanner, MoodyPathPlanner>("changes its traits", module<PathPlanner>(kModules, "ompl"))));

class WrappedRoutePlanner : public RoutePlanner {
 public:
  explicit WrappedRoutePlanner(std::shared_ptr<RoutePlanner> inner) : inner_(std::move(inner)) {}

 protected:
  std::shared_ptr<RoutePlanner> inner_;
};

// Forgets everything of a request but its landmarks.
class ForgetfulRoutePlanner : public WrappedRoutePlanner {
 public:
  using WrappedRoutePlanner::WrappedRoutePlanner;
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override {
    RouteRequest ends;
    for (const RouteEnd& end : request.from) ends.from.push_back({end.landmark, 0.0});
    for (const RouteEnd& end : request.to) ends.to.push_back({end.landmark, 0.0});
    return inner_->plan(ends, world, budget);
  }
};

// Leaves the last route out.
class ShortRoutePlanner : public WrappedRoutePlanner {
 public:
  using WrappedRoutePlanner::WrappedRoutePlanner;
  [[nodiscard]] RouteResult plan(const RouteRequest& request, const WorldView& world,
                                 const Budget& budget) const override {
    RouteResult result = inner_->plan(request, world, budget);
    if (!result.routes.empty()) result.routes.pop_back();
    return result;
  }
};

Subject<RoutePlanner> shipped_route_planner() {
  return module<RoutePlanner>(kModules, "landmark_search");
}
INSTANTIATE_TEST_SUITE_P(
    Faulty, RoutePlannerConformance,
    testing::Values(wrapped<RoutePlanner, ForgetfulRoutePlanner>("forgets what is closed", shipped_route_planner()),
                    wrapped<RoutePlanner, ShortRoutePlanner>("leaves a route out", shipped_route_planner())));

}  // namespace
}  // namespace cairn::conformance
