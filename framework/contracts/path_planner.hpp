// PathPlanner (plugin kind `path_planner`): a collision-free path on the occupancy grid.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/place.hpp"
#include "framework/contracts/plan_outcome.hpp"
#include "framework/contracts/world_view.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/hierarchy/route_costs.hpp"

namespace cairn {

// What a path planner plans for, as it was configured. Whoever joins its paths with others plans for the same.
struct PlannerTraits {
  enum class Shape {
    disc,     // of the request's radius
    outline,  // the robot's own footprint
  };
  enum class Kinematics {
    holonomic,     // moves in any direction
    differential,  // turns on the spot and drives straight
    dubins,        // drives forwards, no tighter than its turning radius
    reeds_shepp,   // the same, backwards too
  };
  Shape shape = Shape::disc;
  Kinematics kinematics = Kinematics::holonomic;
  double margin_m = 0.0;                         // kept free around the shape
  UnknownPolicy unknown = UnknownPolicy::avoid;  // whether paths may cross unknown cells
  bool for_driving_time = false;  // where the robot is known (WorldView::speed_law), rather than for the shortest path
};

struct PathRequest {
  Place from;  // a landmark stands for its approach pose
  Place to;
  double radius_m = 0.22;  // of the disc that must fit
  std::uint64_t seed = 1;
  CostKind cost = CostKind::length;  // what paths are compared by
  double speed_mps = 0.0;            // as fast as the path is to be driven; 0: as the robot can
};

struct PathResult {
  PlanOutcome outcome = PlanOutcome::no_route;
  std::string reason;  // a sentence for people
  double cost_m = 0.0;
  double length_m = 0.0;
  double clearance_m = 0.0;      // least distance of the robot's edge to anything not free
  LandmarkId from_landmark = 0;  // at which the path begins; 0: at none
  LandmarkId to_landmark = 0;    // at which it ends; 0: at none, or short of the goal
  std::vector<Pose2> path;
  std::optional<double> length_lower_bound_m;  // no path on this grid can be shorter
  std::optional<double> driving_time_s;        // by the speed law along the path; none where that is not known
};

class PathPlanner {
 public:
  virtual ~PathPlanner() = default;
  // The same for the whole life of the planner.
  [[nodiscard]] virtual PlannerTraits traits() const = 0;
  // Thread-safe: many calls at once on one planner. The same request, world and seed give the same
  // path as long as the budget's deadline does not cut the call short.
  [[nodiscard]] virtual PathResult plan(const PathRequest& request, const WorldView& world,
                                        const Budget& budget) const = 0;
  // What can be done before anyone waits, when paths in a world will be asked for with discs of that radius. Changes
  // no answer. Thread-safe like plan().
  virtual void prepare(const WorldView& /*world*/, double /*radius_m*/) const {}
};

template <>
struct PluginTraits<PathPlanner> {
  static constexpr PluginKind kKind = PluginKind::path_planner;
  using Context = ModuleContext;
};

}  // namespace cairn
