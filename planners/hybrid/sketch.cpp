#include "planners/hybrid/sketch.hpp"

#include "planners/hybrid/answers.hpp"

namespace cairn {
namespace {

// Another ground, on which the path planner is not asked.
class ShortestGround : public PlanningGround {
 public:
  ShortestGround(const PlanningGround& ground, const DiscRoutes& routes) : ground_(ground), routes_(routes) {}

  [[nodiscard]] const WorldView& world() const override { return ground_.world(); }
  [[nodiscard]] bool fits_with(const Point& from, const Point& to, double added_m) const override {
    return ground_.fits_with(from, to, added_m);
  }
  [[nodiscard]] std::optional<Pose2> approach(const Landmark& landmark) const override {
    return ground_.approach(landmark);
  }
  [[nodiscard]] PathResult path(const PathRequest& request, const Budget& budget) const override {
    const DiscRoute found = routes_.coarse_route(request.from.pose->position(), request.to.pose->position(), budget);
    PathResult result;
    if (found.route.empty()) return result;
    result.outcome = PlanOutcome::solved;
    result.length_m = length_of(found.route);
    result.length_lower_bound_m = found.length_lower_bound_m;
    result.path = poses_along(found.route, request.from.pose->theta_rad, std::nullopt);
    return result;
  }
  [[nodiscard]] double clearance_m(const std::vector<Point>& route, double radius_m) const override {
    return ground_.clearance_m(route, radius_m);
  }
  [[nodiscard]] double driving_time_s(const std::vector<Point>& route, const DrivingRules& rules) const override {
    return ground_.driving_time_s(route, rules);
  }
  [[nodiscard]] ShortcutRules shortcuts(double added_m) const override { return ground_.shortcuts(added_m); }

 private:
  const PlanningGround& ground_;
  const DiscRoutes& routes_;
};

}  // namespace

std::optional<double> sketched_length_m(const PlanningGround& ground, const DiscRoutes& routes, LegRules rules,
                                        bool shortcut, const Budget& budget, const Point& from,
                                        const SymbolicPath& path, const Pose2& goal) {
  rules.straight_clearance_m = 0.0;
  const ShortestGround shortest(ground, routes);
  const Walk walk = Walker(shortest, rules, budget).walk(from, path, goal);
  if (!walk.complete()) return std::nullopt;
  return length_of(
      points_of(shortcut ? shortened_from_both_ends(ground.shortcuts(0.0), walk.route, budget) : walk.route));
}

}  // namespace cairn
