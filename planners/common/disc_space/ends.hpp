// The two ends of a request as points on the grid: where the robot starts and where it may arrive.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planners/common/disc_space/places.hpp"
#include "planners/common/disc_space/space_cache.hpp"

namespace cairn {

// Why there is no end, as an outcome.
struct Refusal {
  PlanOutcome outcome = PlanOutcome::unknown_place;
  std::string reason;
};

// As the result of a planner: a PathResult or PlanResult.
template <class Result>
[[nodiscard]] Result refused(const Refusal& refusal) {
  Result result;
  result.outcome = refusal.outcome;
  result.reason = refusal.reason;
  return result;
}
// Of a call that its budget ended: `cancelled` or `out_of_budget`.
[[nodiscard]] PlanOutcome stop_outcome(const Budget& budget);
[[nodiscard]] Refusal stopped(PlanOutcome stop_outcome);
// Throws std::invalid_argument, with the planner's name, unless it is finite and not negative.
void check_radius(const std::string& planner, double radius_m);

// The robot at the start. The grid is the world's, with the unknown ground under the robot made free
// when it stands there now.
struct StartPlace {
  std::optional<OccupancyGrid> patched_grid;
  std::shared_ptr<const DiscSpace> space;
  Pose2 pose;
  LandmarkId landmark = 0;       // when the start is one
  std::optional<Escape> escape;  // when it is left with less clearance than the radius
  Point leave_from{0.0, 0.0};    // the escape's end, else the pose

  [[nodiscard]] const OccupancyGrid& grid_of(const WorldView& world) const {
    return patched_grid ? *patched_grid : world.grid;
  }
};

// For the end of a reason, when the start is left by an escape.
[[nodiscard]] std::string escape_text(const StartPlace& start);

struct GoalPlace {
  Pose2 pose;
  std::optional<double> heading_rad;  // when it matters
  LandmarkId landmark = 0;
  std::string note;  // for people, when it is not the usual approach pose of the landmark
};

// What a robot that stands at a pose covers of the grid.
struct Covering {
  double reach_m = 0.0;  // no further from the pose
  std::function<bool(const Pose2&, Cell)> covers;
};

struct EndRules {
  GroundRules ground;
  double radius_m = 0.22;
  double start_tolerance_m = 0.3;
  std::optional<Covering> covering;  // none: the disc
};

// Such a disc fits nowhere, and checking every cell under it would take for ever.
[[nodiscard]] bool is_larger_than(const OccupancyGrid& grid, double radius_m);
// Landmarks of a place that the graph lacks, non-finite numbers, a place that names nothing.
[[nodiscard]] std::optional<Refusal> refusal_of_place(const Place& place, const LandmarkGraph& graph,
                                                      const std::string& end);
// Of several landmarks, the first one that has an approach pose.
[[nodiscard]] std::variant<StartPlace, Refusal> start_of(const Place& place, const WorldView& world,
                                                         const EndRules& rules, const SpaceCache& spaces);
// That the path is too narrow for the robot, for people.
[[nodiscard]] Refusal too_narrow(const Place& goal, const LandmarkGraph& graph, double radius_m);
// Whether a disc that leaves the start may get to a point; false is certain.
using MayReach = std::function<bool(const Point&)>;
// Every place that the request would accept, landmarks by their approach poses that may be reached; one
// that cannot be is left out. At least one, or a refusal that says why.
[[nodiscard]] std::variant<std::vector<GoalPlace>, Refusal> goals_of(const Place& place, const WorldView& world,
                                                                     const EndRules& rules, const StartPlace& start,
                                                                     const MayReach& may_reach);

}  // namespace cairn
