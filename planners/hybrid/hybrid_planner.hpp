// From a place to a place over both levels (docs/method.md 10.5): landmarks first, then the way between them.
#pragma once

#include <memory>

#include "framework/config/fields.hpp"
#include "framework/contracts/planner.hpp"
#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/space_cache.hpp"

namespace cairn {

struct HybridConfig {
  PluginChoice route = {"ompl", default_of("route")};
  PluginChoice graph = {"landmark_search", default_of("graph")};
  double detour_ratio = 1.3;
  double start_tolerance_m = 0.3;
  bool shortcut = true;

  static void describe(Fields<HybridConfig>& fields) {
    fields.plugin(
        "route", &HybridConfig::route, "planner",
        "planner of routes on the grid; its `unknown` and `margin_m` hold for stored routes and cut corners too");
    fields.plugin("graph", &HybridConfig::graph, "planner", "planner over the landmark graph");
    fields.number("detour_ratio", &HybridConfig::detour_ratio, {1.0, 100.0}, "",
                  "a way over landmarks is taken when it is at most this much longer than the direct one, and a "
                  "leg planned anew likewise against its stored cost");
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

// Whether the route planner's settings are for a disc that turns on the spot; for others there are no landmark legs.
[[nodiscard]] bool is_for_discs(const PluginChoice& route);
// What the route planner's settings say about the ground, for the hybrid's own checks.
[[nodiscard]] UnknownPolicy unknown_policy_of(const PluginChoice& route);
[[nodiscard]] double margin_m_of(const PluginChoice& route);

// What is kept of a grid from request to request.
struct HybridGround {
  SpaceCache spaces;
  DiscRoutesCache routes;
};

// Landmarks are passed by stored trajectories that are still free, other legs are planned; a leg that is
// blocked closes its route for this query and the landmarks are searched again. Without a landmark in
// between when the direct way is hardly longer; when landmarks are avoided or routes closed, only where no
// way over landmarks is left. At an avoided landmark, where a robot would stand is an obstacle to the whole
// path (avoided.hpp), whatever its shape; a closed route matters on the graph only. Alternatives are ways that are open
// today. cost_m is that of the graph search (stored costs, lengths where there are none); the path, with its corners
// cut, may be shorter; its pieces say what came from where. On a map without a grid the graph planner's answer is the
// answer. Every solved path has been re-checked cell by cell. Thread-safe if both planners are.
class HybridPlanner : public Planner {
 public:
  HybridPlanner(HybridConfig config, std::shared_ptr<const Planner> route, std::shared_ptr<const Planner> graph);

  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;
  void prepare(const WorldView& world, double radius_m) const override;

 private:
  [[nodiscard]] PlanResult plan_without_landmarks(const PlanRequest& request, const WorldView& world,
                                                  const Budget& budget) const;

  HybridConfig config_;
  UnknownPolicy unknown_;
  double margin_m_;
  std::shared_ptr<const Planner> route_;
  std::shared_ptr<const Planner> graph_;
  HybridGround usual_;
  HybridGround avoiding_;  // of grids with obstacles at avoided landmarks
};

}  // namespace cairn
