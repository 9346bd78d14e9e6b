#include "planners/ompl/pose/pose_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "maps/geometry/segments.hpp"
#include "planners/common/pose_space/pose_recheck.hpp"

namespace cairn {
namespace {

constexpr double kPathStep_m = 0.1;             // between the poses of an answer
constexpr double kPathStep_rad = radians(5.0);  // 5 degrees

// Least distance of the outline's rim, or the disc's edge, to anything blocked.
double clearance_of(const DiscSpace& space, const Footprint& footprint, const std::vector<Pose2>& path) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const Pose2& pose : path) {
    if (footprint.is_disc()) {
      const double away_m = space.distance_m(pose.position(), pose.position());
      nearest_m = std::min(nearest_m, away_m - footprint.circumscribed_m());
      continue;
    }
    const std::vector<Point>& corners = footprint.corners_m();
    for (std::size_t i = 0; i < corners.size(); ++i)
      nearest_m = std::min(nearest_m, space.distance_m(pose * corners[i], pose * corners[(i + 1) % corners.size()]));
  }
  return std::max(nearest_m, 0.0);
}

std::vector<Pose2> path_along(const std::vector<Motion>& motions, const Pose2& only) {
  std::vector<Pose2> path;
  for (const Motion& motion : motions)
    for (const Pose2& pose : motion.sampled(kPathStep_m, kPathStep_rad))
      if (path.empty() || !are_alike(path.back(), pose, 1e-9)) path.push_back(pose);
  if (path.empty()) path.push_back(only);
  return path;
}

}  // namespace

PathResult result_of(const PoseProblem& problem, const PoseSetup& setup, const WorldView& world,
                     const StartPlace& start, const GoalPlace& goal, const FoundPath& found, const Budget& budget) {
  const auto space = make_kinematic_space(setup.kinematics, start.space->field());
  const std::vector<Motion> motions = motions_of(*space, found.states);
  int reversals = 0;
  for (const Motion& motion : motions) {
    if (budget.cancelled()) return refused<PathResult>(stopped(stop_outcome(budget)));
    const auto touch = first_touch(start.grid_of(world), setup.ends.ground, setup.footprint, motion,
                                   recheck_slack_m(start.space->cell_m()));
    if (touch)
      throw std::logic_error(fmt::format("ompl: the re-check refused a motion at {}, outline of radius {:f}",
                                         text_of(touch->pose.position()), setup.footprint.circumscribed_m()));
    reversals += motion.reversals();
  }
  PathResult result;
  result.outcome = PlanOutcome::solved;
  result.path = path_along(motions, start.pose);
  result.length_m = length_of(result.path);
  result.cost_m = result.length_m;
  if (!problem.cost.is_length() && problem.cost.is_in_metres()) {
    result.cost_m = 0.0;
    for (const Motion& motion : motions) result.cost_m += cost_of(problem, motion);
  }
  if (problem.cost.driving()) {
    std::vector<Point> points;
    for (const Pose2& pose : result.path) points.push_back(pose.position());
    result.driving_time_s = driving_time_s(start.space->field(), points, *problem.cost.driving());
  }
  result.clearance_m = clearance_of(*start.space, setup.footprint, result.path);
  result.from_landmark = start.landmark;
  result.to_landmark = goal.landmark;
  result.reason = found.how + goal.note;
  if (reversals == 1) result.reason += "; it turns back once";
  if (reversals > 1) result.reason += "; it turns back " + std::to_string(reversals) + " times";
  if (found.interrupted) result.reason += "; the budget ended the search for a shorter one";
  return result;
}

}  // namespace cairn
