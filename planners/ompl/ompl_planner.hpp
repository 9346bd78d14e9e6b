// Routes on OG1 (docs/method.md 10.2, 10.3) for a disc or an outline: the shortest over the grid, improved by OMPL, or
// any of OMPL's planners.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/path_planner.hpp"
#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/common/disc_space/space_cache.hpp"
#include "planners/ompl/pose/motion_kind.hpp"
#include "planners/ompl/search/algorithm_parameters.hpp"
#include "planners/ompl/search/travel_cost.hpp"

namespace cairn {

enum class UnknownGround : std::uint8_t { avoid, allow, cost };

struct OmplConfig {
  Algorithm algorithm = Algorithm::any_angle_rrt_star;
  std::int64_t iterations = 3000;
  std::int64_t improve_iterations = 100;
  double good_enough_ratio = 1.01;
  Objective objective = Objective::as_driven;
  double length_weight = 1.0;
  double time_weight = 1.0;
  double clearance_weight = 1.0;
  UnknownGround unknown = UnknownGround::avoid;
  double unknown_weight = 3.0;
  MotionKind kinematics = MotionKind::holonomic;
  PlannerTraits::Shape footprint = PlannerTraits::Shape::disc;
  double turning_radius_m = 0.0;
  bool reverse = false;
  double spot_turn_m = 0.1;
  double margin_m = 0.0;
  double start_tolerance_m = 0.3;
  bool simplify = true;
  bool fall_back_to_grid = true;
  ConfigValue parameters;

  static void describe(Fields<OmplConfig>& fields);
};

// What is kept from request to request.
struct OmplCaches {
  SpaceCache spaces;
  DiscRoutesCache routes;
  DiscRoutesCache outer_routes;  // of the disc that holds an outline
};

// Every route that is called solved has been re-checked against the grid, cell by cell. That a goal
// cannot be reached is proven before any search. A landmark as an end is its approach pose.
// Thread-safe; searches by OMPL's own planners run one at a time in a process, because OMPL's seeds are
// process-wide; the default algorithm's run side by side.
class OmplPlanner : public PathPlanner {
 public:
  // Throws ConfigError on a parameter that the algorithm does not have, and on settings that do not go together
  // or ask for what the robot's file does not say.
  explicit OmplPlanner(OmplConfig config, const RobotModel& robot = {});

  [[nodiscard]] PlannerTraits traits() const override;
  [[nodiscard]] PathResult plan(const PathRequest& request, const WorldView& world,
                                const Budget& budget) const override;
  // For requests of the same radius on the same grid; builds all that the first of them would wait for.
  void prepare(const WorldView& world, double radius_m) const override;
  [[nodiscard]] const OmplCaches& caches() const { return caches_; }

 private:
  OmplConfig config_;
  AlgorithmParameters parameters_;
  OmplCaches caches_;
};

}  // namespace cairn
