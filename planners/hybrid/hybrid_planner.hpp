// From a place to a place over both levels (docs/method.md 10.4): landmarks first, then the path between them.
#pragma once

#include <memory>

#include "framework/config/fields.hpp"
#include "framework/contracts/path_planner.hpp"
#include "framework/contracts/planner.hpp"
#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/space_cache.hpp"
#include "planners/hybrid/windows/windows.hpp"

namespace cairn {

struct HybridConfig {
  PluginChoice route = {"ompl", default_of("route")};
  PluginChoice graph = {"landmark_search", default_of("graph")};
  double detour_ratio = 1.3;
  double shortened_ratio = 1.1;
  double start_tolerance_m = 0.3;
  bool shortcut = true;

  static void describe(Fields<HybridConfig>& fields) {
    fields.plugin(
        "route", &HybridConfig::route, "path_planner",
        "planner of paths on the grid; its `unknown` and `margin_m` hold for stored routes and cut corners too");
    fields.plugin("graph", &HybridConfig::graph, "route_planner", "planner of routes over the landmark graph");
    fields.number("detour_ratio", &HybridConfig::detour_ratio, {1.0, 100.0}, "",
                  "a path over landmarks is taken when it is at most this much longer than the direct one, and a "
                  "leg planned anew likewise against its stored cost");
    fields.number(
        "shortened_ratio", &HybridConfig::shortened_ratio, {1.0, 100.0}, "",
        "one that costs more, up to 3 times the direct one, is taken when it leads from cluster to cluster and is at "
        "most this much longer than the direct one once its corners are cut");
    fields.number("start_tolerance_m", &HybridConfig::start_tolerance_m, {0.0, 1.0}, "m",
                  "how far a start that is too near to something may be left with what clearance it has");
    fields.flag("shortcut", &HybridConfig::shortcut, "cut corners of the joined path where the ground is free");
  }

 private:
  static ConfigValue default_of(const std::string& key) {
    ConfigValue value;
    value.kind = ConfigValue::Kind::map;
    value.place.file = "hybrid, its default " + key;
    return value;
  }
};

// What is kept of a grid from request to request.
struct HybridGround {
  SpaceCache spaces;
  DiscRoutesCache routes;
};

// Landmarks are passed by stored trajectories that are still free, other legs are planned; a leg that is
// blocked closes its route for this query and the landmarks are searched again. Without a landmark in
// between when the direct path is hardly longer; when landmarks are avoided or routes closed, only where no
// path over landmarks is left. At an avoided landmark, the place of a robot is an obstacle to the whole
// path (avoided.hpp), whatever its shape; a closed route matters on the graph only. Alternatives are routes that are
// open today. On a large grid with routes all this is done in windows of it (local_query.hpp), and the whole of it is
// searched only where that finds no path, or where landmarks are avoided. cost_m is that of the graph search (stored
// costs, lengths where there are none); the path, with its corners cut, may be shorter; its segments say what came from
// where. On a map without a grid the route planner's answer is the answer. Every solved path has been re-checked cell
// by cell. Thread-safe if both planners are.
class HybridPlanner : public Planner {
 public:
  // Throws std::invalid_argument when one of the two is missing.
  HybridPlanner(HybridConfig config, std::shared_ptr<const PathPlanner> path_planner,
                std::shared_ptr<const RoutePlanner> route_planner);

  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;
  // Nothing of a large grid, of which most questions do not need the whole.
  void prepare(const WorldView& world, double radius_m) const override;
  [[nodiscard]] bool requires_cells() const override { return is_for_discs(); }

 private:
  // Landmark legs are joined and smoothed for a disc that turns on the spot.
  [[nodiscard]] bool is_for_discs() const {
    return traits_.kinematics == PlannerTraits::Kinematics::holonomic && traits_.shape == PlannerTraits::Shape::disc;
  }
  [[nodiscard]] PlanResult plan_without_landmarks(const PlanRequest& request, const WorldView& world,
                                                  const Budget& budget) const;

  HybridConfig config_;
  std::shared_ptr<const PathPlanner> path_planner_;
  std::shared_ptr<const RoutePlanner> route_planner_;
  PlannerTraits traits_;  // of the path planner
  HybridGround usual_;
  HybridGround avoiding_;  // of grids with obstacles at avoided landmarks
  WindowCache windows_;    // of large grids
};

}  // namespace cairn
