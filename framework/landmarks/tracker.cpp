#include "framework/landmarks/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/landmarks/evidence.hpp"
#include "maps/geometry/segments.hpp"
#include "maps/grid/distance_field.hpp"
#include "maps/grid/travel_field.hpp"

namespace cairn {
namespace {

constexpr double kThinning_m = 0.05;
constexpr double kVisit_m = 0.25;       // this near to a standing place counts as having been there
constexpr double kAccessReach_m = 1.5;  // a standing place lies no further from the landmark's centre

std::vector<Pose2> reversed(std::vector<Pose2> path) {
  std::reverse(path.begin(), path.end());
  for (Pose2& pose : path) pose.theta_rad = wrap_angle(pose.theta_rad + std::numbers::pi);
  return path;
}

// The reachable cell nearest to the landmark, looking at it.
std::optional<Pose2> approach_pose(const DistanceField& space, const TravelField& reach, const Point& landmark) {
  const int radius = static_cast<int>(std::ceil(kAccessReach_m / space.cell_m()));
  const Cell centre = space.cell_at(landmark);
  std::optional<Cell> best;
  double best_distance = kAccessReach_m;
  for (int y = centre.y - radius; y <= centre.y + radius; ++y)
    for (int x = centre.x - radius; x <= centre.x + radius; ++x) {
      if (!reach.reaches({x, y})) continue;
      const double distance = (space.centre_of({x, y}) - landmark).norm();
      if (distance < best_distance) {
        best_distance = distance;
        best = Cell{x, y};
      }
    }
  if (!best) return std::nullopt;
  const Point at = space.centre_of(*best);
  return Pose2{at.x(), at.y(), std::atan2(landmark.y() - at.y(), landmark.x() - at.x())};
}

// Not heard yet: hear() adds what the matching says.
Landmark first_seen(const Detection& detection) {
  Landmark landmark;
  landmark.category = detection.category;
  landmark.T_map_landmark = detection.T_map_landmark;
  return landmark;
}

// The other one was this one from the beginning.
void absorb(Landmark& landmark, const Landmark& other) {
  if (other.degree > landmark.degree) {
    landmark.category = other.category;
    landmark.T_map_landmark = other.T_map_landmark;
    landmark.degree = other.degree;
    landmark.templates = other.templates;
  }
  add_evidence(landmark, other);
}

}  // namespace

void LandmarkTrackerConfig::describe(Fields<LandmarkTrackerConfig>& fields) {
  using C = LandmarkTrackerConfig;
  fields.number("merge_m", &C::merge_m, {0.01, 10.0}, "m", "a detection this near to a landmark is that landmark");
  fields.integer("confirm_sightings", &C::confirm_sightings, {1.0, 1000.0},
                 "matchings that must find it before it counts as a landmark");
  fields.number("freed_ratio", &C::freed_ratio, {0.5, 1.0}, "",
                "a landmark is retired once this share of the cells inside its outline is seen free");
  fields.integer("routes_per_landmark", &C::routes_per_landmark, {0.0, 100.0}, "joined to this many nearest others");
  fields.number("driven_detour_ratio", &C::driven_detour_ratio, {1.0, 100.0}, "",
                "a driven way is kept when it is at most this much longer than the planned one");
  fields.flag("correct_pose", &C::correct_pose, "landmarks that are seen again are told to the localizer");
  fields.number("access_margin_m", &C::access_margin_m, {0.0, 1.0}, "m",
                "free space kept round the robot that stands beside a landmark");
}

LandmarkTracker::LandmarkTracker(const LandmarkTrackerConfig& config, const RobotModel& robot,
                                 std::vector<LandmarkShape> shapes)
    : config_(config), robot_(robot), shapes_(std::move(shapes)) {}

void LandmarkTracker::restore(LandmarkGraph graph, LandmarkGraph candidates, std::vector<Pose2> driven_path) {
  graph_ = std::move(graph);
  candidates_ = std::move(candidates);
  driven_path_ = std::move(driven_path);
}

std::vector<LandmarkTracker::Change> LandmarkTracker::update(const Matching& matching) {
  if (matching.detection) see(*matching.detection);
  std::vector<LandmarkId> changed;
  for (const auto& [id, landmark] : graph_.landmarks())
    if (add_evidence(*graph_.find(id), matching, config_.merge_m)) changed.push_back(id);
  std::vector<LandmarkId> confirmed;
  for (const auto& [id, candidate] : candidates_.landmarks()) {
    add_evidence(*candidates_.find(id), matching, config_.merge_m);
    if (candidate.sightings >= config_.confirm_sightings) confirmed.push_back(id);
  }
  std::vector<Change> changes;
  for (const LandmarkId id : changed) merge_beside(id, changes);
  for (const LandmarkId id : confirmed) {
    Landmark landmark = *candidates_.find(id);
    candidates_.remove(id);
    // As its view has completed it may have come to lie where a landmark is.
    if (const Landmark* known = graph_.nearest(landmark.T_map_landmark.position(), config_.merge_m)) {
      absorb(*graph_.find(known->id), landmark);
      merge_beside(known->id, changes);
    } else {
      landmark.id = 0;
      changes.push_back({graph_.add(std::move(landmark)), ChangeKind::found});
    }
  }
  return changes;
}

void LandmarkTracker::see(const Detection& detection) {
  const Point at_m = detection.T_map_landmark.position();
  if (const Landmark* known = graph_.nearest(at_m, config_.merge_m)) {
    ++graph_.find(known->id)->sightings;
    return;
  }
  const Landmark* candidate = candidates_.nearest(at_m, config_.merge_m);
  const LandmarkId id = candidate != nullptr ? candidate->id : candidates_.add(first_seen(detection));
  ++candidates_.find(id)->sightings;
}

// A view that completes moves a landmark; two that come this near were one from the beginning. The older stays.
void LandmarkTracker::merge_beside(LandmarkId id, std::vector<Change>& changes) {
  const Landmark* landmark = graph_.find(id);
  if (landmark == nullptr) return;  // merged already
  std::vector<LandmarkId> same;
  for (const auto& [other, there] : graph_.landmarks())
    if ((there.T_map_landmark.position() - landmark->T_map_landmark.position()).norm() <= config_.merge_m)
      same.push_back(other);
  const LandmarkId kept = same.front();
  for (std::size_t i = 1; i < same.size(); ++i) {
    Landmark& older = *graph_.find(kept);
    const Landmark younger = *graph_.find(same[i]);
    graph_.retire(younger.id, "is " + label_of(older));
    absorb(older, younger);
    std::erase_if(changes, [&](const Change& change) { return change.landmark == younger.id; });
    changes.push_back({younger.id, ChangeKind::retired});
  }
  if (std::ranges::find(changes, kept, &Change::landmark) == changes.end())
    changes.push_back({kept, ChangeKind::changed});
}

std::vector<LandmarkTracker::Change> LandmarkTracker::retire_freed(const OccupancyGrid& grid) {
  const auto is_freed = [&](const Landmark& landmark) {
    const auto shape = std::ranges::find(shapes_, landmark.category, &LandmarkShape::category);
    return shape != shapes_.end() && freed_ratio(grid, shape->contour, landmark.T_map_landmark) >= config_.freed_ratio;
  };
  std::vector<Change> changes;
  for (const auto& [id, landmark] : graph_.landmarks())
    if (is_freed(landmark)) changes.push_back({id, ChangeKind::retired});
  for (const Change& change : changes) graph_.retire(change.landmark, "its place has been seen free");
  std::vector<LandmarkId> forgotten;
  for (const auto& [id, candidate] : candidates_.landmarks())
    if (is_freed(candidate)) forgotten.push_back(id);
  for (const LandmarkId id : forgotten) candidates_.remove(id);
  return changes;
}

void LandmarkTracker::record_pose(const Pose2& T_map_robot) {
  if (driven_path_.empty() || (driven_path_.back().position() - T_map_robot.position()).norm() >= kThinning_m)
    driven_path_.push_back(T_map_robot);
}

void LandmarkTracker::find_access(const WorldView& world) {
  const DistanceField space(world.grid, UnknownPolicy::avoid);
  // Distances run between cell centres: half a diagonal on either side makes the disc fit.
  const double clearance = robot_.radius_m + config_.access_margin_m + std::numbers::sqrt2 * world.grid.cell_m() / 2;
  const TravelField reach(space, world.pose.T_map_robot.position(), clearance);
  for (const auto& [id, landmark] : graph_.landmarks())
    graph_.find(id)->access = approach_pose(space, reach, landmark.T_map_landmark.position());
}

void LandmarkTracker::connect(const WorldView& world, const Plan& plan, std::uint64_t seed) {
  while (!graph_.routes().empty()) graph_.remove_route(graph_.routes().begin()->first);
  find_access(world);
  for (const auto& [id, landmark] : graph_.landmarks()) {
    std::vector<std::pair<double, LandmarkId>> others;
    for (const auto& [other_id, other] : graph_.landmarks())
      if (other_id != id)
        others.emplace_back((other.T_map_landmark.position() - landmark.T_map_landmark.position()).norm(), other_id);
    std::sort(others.begin(), others.end());
    if (others.size() > static_cast<std::size_t>(config_.routes_per_landmark))
      others.resize(static_cast<std::size_t>(config_.routes_per_landmark));
    for (const auto& [distance, other] : others)
      if (graph_.route_between(id, other) == nullptr) join(landmark, *graph_.find(other), plan, seed);
  }
}

void LandmarkTracker::join(const Landmark& from, const Landmark& to, const Plan& plan, std::uint64_t seed) {
  if (!from.access || !to.access) return;
  PlanRequest request;
  request.from.pose = from.access;
  request.to.pose = to.access;
  request.radius_m = robot_.radius_m + kMaxRounding_m;
  request.seed = seed;
  const PlanResult planned = plan(request);
  if (planned.outcome != PlanOutcome::solved) return;
  const std::vector<Pose2> driven = driven_between(*from.access, *to.access);
  Route route;
  route.from = from.id;
  route.to = to.id;
  route.driven = !driven.empty() && length_of(driven) <= config_.driven_detour_ratio * planned.length_m;
  route.trajectory = in_whole_steps(route.driven ? driven : planned.path);
  route.cost_m = length_of(route.trajectory);
  Route back = route;
  std::swap(back.from, back.to);
  back.trajectory = in_whole_steps(reversed(back.trajectory));
  graph_.add_route(std::move(route));
  graph_.add_route(std::move(back));
}

// The shortest stretch of the driven path between the two places, in the direction from -> to; ends
// are replaced by the places themselves. Empty when the robot has not been at both.
std::vector<Pose2> LandmarkTracker::driven_between(const Pose2& from, const Pose2& to) const {
  const auto near = [](const Pose2& a, const Pose2& b) { return (a.position() - b.position()).norm() <= kVisit_m; };
  std::optional<std::size_t> last_from;
  std::optional<std::size_t> last_to;
  std::size_t best_begin = 0;
  std::size_t best_end = 0;
  bool backwards = false;
  std::size_t best_steps = driven_path_.size() + 1;
  for (std::size_t i = 0; i < driven_path_.size(); ++i) {
    if (near(driven_path_[i], from)) last_from = i;
    if (near(driven_path_[i], to)) last_to = i;
    if (!last_from || !last_to) continue;
    const std::size_t begin = std::min(*last_from, *last_to);
    const std::size_t end = std::max(*last_from, *last_to);
    if (end - begin < best_steps) {
      best_steps = end - begin;
      best_begin = begin;
      best_end = end;
      backwards = *last_to < *last_from;
    }
  }
  if (best_steps > driven_path_.size()) return {};
  const auto at = [&](std::size_t i) { return driven_path_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<Pose2> stretch(at(best_begin), at(best_end) + 1);
  if (backwards) stretch = reversed(std::move(stretch));
  stretch.insert(stretch.begin(), from);
  stretch.push_back(to);
  return stretch;
}

}  // namespace cairn
