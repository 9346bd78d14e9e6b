// The sub-symbolic half of a plan: a path over the grid along the landmarks (docs/method.md 10.4).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "planners/hybrid/ground.hpp"
#include "planners/hybrid/symbolic_path.hpp"

namespace cairn {

struct LegRules {
  double radius_m = 0.22;     // of the request, to which the path planner adds its margin
  double disc_m = 0.22;       // radius of the disc that has to fit: with the margin, and a hair more
  double detour_ratio = 1.3;  // a leg planned anew may be this much longer than its stored cost
  std::uint64_t seed = 1;
  double speed_mps = 0.0;             // of the request
  double straight_clearance_m = 0.0;  // on top of disc_m, without which a straight leg is left to the path planner
};

struct Walk {
  std::vector<PartedPoint> route;  // from StartPlace::leave_from to the goal
  std::vector<PathSegment> parts;  // of the route, without their lengths
  double cost_m = 0.0;             // stored costs, or lengths where there was none to use
  int stored_legs = 0;
  int planned_legs = 0;
  std::optional<RouteId> blocked;      // the route that is not passable today; the walk ends there
  bool access_leg_failed = false;      // no path to the first or from the last landmark
  std::optional<PlanOutcome> stopped;  // cancelled or out_of_budget

  [[nodiscard]] bool complete() const { return !blocked && !access_leg_failed && !stopped; }
  void add_part(PathSegment::Origin origin, RouteId of) { parts.push_back({origin, of, 0.0}); }
  void go_on_to(const Point& to) { route.push_back({to, static_cast<int>(parts.size()) - 1}); }
};

// Walks a symbolic path: stored trajectories where the disc still fits along them, otherwise legs planned on the
// ground.
class Walker {
 public:
  Walker(const PlanningGround& ground, const LegRules& rules, const Budget& budget)
      : ground_(ground), rules_(rules), budget_(budget) {}

  [[nodiscard]] Walk walk(const Point& from, const SymbolicPath& path, const Pose2& goal) const;
  // One leg by itself, from the approach pose of its first landmark.
  [[nodiscard]] Walk walk_alone(const Route& leg) const;

 private:
  enum class Step { done, failed, stopped };

  [[nodiscard]] Step go_to(const Point& to, RouteId leg, Walk& walk, double at_most_m) const;
  [[nodiscard]] bool is_passable(const std::vector<Pose2>& trajectory) const;
  void take_leg(const Route& leg, Walk& walk) const;
  void take_access_leg(const Point& to, Walk& walk) const;
  [[nodiscard]] std::optional<Pose2> approach(LandmarkId id) const {
    return ground_.approach(*ground_.world().graph.find(id));
  }
  [[nodiscard]] std::optional<PlanOutcome> stopped() const;

  const PlanningGround& ground_;
  const LegRules& rules_;
  const Budget& budget_;
};

}  // namespace cairn
