// Routes on OG1 for a disc (METHOD 10), by any of OMPL's geometric planners.
#pragma once

#include "framework/config/fields.hpp"
#include "framework/contracts/planner.hpp"
#include "planners/disc_space/space_cache.hpp"
#include "planners/ompl/algorithms.hpp"
#include "planners/ompl/sampling.hpp"

namespace cairn {

struct OmplConfig {
  Algorithm algorithm = Algorithm::bit_star;
  std::int64_t iterations = 3000;
  UnknownPolicy unknown = UnknownPolicy::avoid;
  double margin_m = 0.0;
  double start_tolerance_m = 0.3;
  bool simplify = true;
  bool fall_back_to_grid = true;
  ConfigValue parameters;

  static void describe(Fields<OmplConfig>& fields) {
    fields.choice("algorithm", &OmplConfig::algorithm, algorithm_names(), "planner of OMPL, by OMPL's name");
    fields.integer("iterations", &OmplConfig::iterations, {1, 1e9},
                   "how often the search may ask whether to go on; a count, so that answers do not depend on the "
                   "machine's speed");
    fields.choice("unknown", &OmplConfig::unknown, {{"avoid", UnknownPolicy::avoid}, {"allow", UnknownPolicy::allow}},
                  "whether routes may cross cells that have not been seen");
    fields.number("margin_m", &OmplConfig::margin_m, {0.0, 2.0}, "m", "added to the robot's radius");
    fields.number("start_tolerance_m", &OmplConfig::start_tolerance_m, {0.0, 1.0}, "m",
                  "how far a start that is too near to something may be left with what clearance it has");
    fields.flag("simplify", &OmplConfig::simplify, "shorten the route that was found");
    fields.flag("fall_back_to_grid", &OmplConfig::fall_back_to_grid,
                "when sampling finds nothing, take the shortest way over the grid's cells");
    fields.raw("parameters", &OmplConfig::parameters, "map", "OMPL's own parameters of the algorithm, by name");
  }
};

// Every route that is called solved has been re-checked against the grid, cell by cell. That a goal
// cannot be reached is proven before sampling begins. Landmarks as ends stand for their standing places.
// Thread-safe; searches of one process run one at a time, because OMPL's seeds are process-wide.
class OmplPlanner : public Planner {
 public:
  // Throws ConfigError on a parameter that the algorithm does not have.
  explicit OmplPlanner(OmplConfig config);

  [[nodiscard]] PlanResult plan(const PlanRequest& request, const WorldView& world,
                                const Budget& budget) const override;

 private:
  OmplConfig config_;
  AlgorithmParameters parameters_;
  SpaceCache spaces_;
};

}  // namespace cairn
