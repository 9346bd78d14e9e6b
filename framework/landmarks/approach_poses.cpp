#include "framework/landmarks/approach_poses.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "maps/grid/swept_disc.hpp"

namespace cairn {
namespace {

constexpr double kStay_m = 0.1;  // farther than the best place
constexpr double kFacing_rad = radians(5.0);

struct StandingPlace {
  Cell cell;
  double distance_m = 0.0;  // from the landmark
  bool keeps_margin = false;

  // A place that keeps the margin is better than one that does not; then the nearer one is.
  [[nodiscard]] bool is_better_than(const StandingPlace& other) const {
    return keeps_margin != other.keeps_margin ? keeps_margin : distance_m < other.distance_m;
  }
};
using PlacesByPart = std::map<std::int32_t, StandingPlace>;

// What is printed is seen from its front only, and behind it may be another room.
bool is_in_front(const Point& at, const Landmark& landmark) {
  const Pose2& T_map_landmark = landmark.T_map_landmark;
  return !landmark.marker || (at - T_map_landmark.position()).dot(unit_vector(T_map_landmark.theta_rad)) > 0.0;
}

// The best place near the landmark in each part of the lattice.
PlacesByPart places_near(const Landmark& of, const StandingGround& ground) {
  const Point landmark = of.T_map_landmark.position();
  const DistanceField& space = ground.space;
  const int reach = static_cast<int>(std::ceil(kApproachReach_m / space.cell_m()));
  const Cell centre = space.cell_at(landmark);
  const CellBox near = intersected(space.box(), CellBox{centre, centre + Cell{1, 1}}.grown(reach));
  PlacesByPart places;
  for (int y = near.min.y; y < near.max.y; ++y)
    for (int x = near.min.x; x < near.max.x; ++x) {
      const std::int32_t part = ground.lattice.part_of({x, y});
      if (part == 0) continue;
      const StandingPlace place{{x, y}, (space.centre_of({x, y}) - landmark).norm(), ground.keeps_margin({x, y})};
      if (place.distance_m >= kApproachReach_m || !is_in_front(space.centre_of({x, y}), of)) continue;
      const auto [best, is_new] = places.emplace(part, place);
      if (!is_new && place.is_better_than(best->second)) best->second = place;
    }
  return places;
}

// The parts that the robot has been in. Where it stands too near to something, those of the cells beside it count.
std::set<std::int32_t> driven_parts(const StandingGround& ground, const DrivenPath& driven, const Pose2& T_map_robot) {
  std::set<std::int32_t> parts;
  const auto touch = [&](const Pose2& pose) {
    const Cell at = ground.space.cell_at(pose.position());
    if (const std::int32_t part = ground.lattice.part_of(at); part != 0) {
      parts.insert(part);
      return;
    }
    for (const Cell step : DiscLattice::kSteps)
      if (const std::int32_t part = ground.lattice.part_of(at + step); part != 0) parts.insert(part);
  };
  for (const Pose2& pose : driven.poses()) touch(pose);
  touch(T_map_robot);
  return parts;
}

Pose2 facing(const Point& at, const Point& landmark) {
  return {at.x(), at.y(), std::atan2(landmark.y() - at.y(), landmark.x() - at.x())};
}

// The part in which the approach pose so far lies; 0 without one, or where the robot would not get from it to the
// centre of its cell.
std::int32_t part_of_access(const Landmark& landmark, const StandingGround& ground) {
  if (!landmark.access) return 0;
  const Point at = landmark.access->position();
  const Cell cell = ground.space.cell_at(at);
  const std::int32_t part = ground.lattice.part_of(cell);
  const Point centre = ground.space.centre_of(cell);
  if (part == 0 || (at - centre).norm() <= kMaxRounding_m) return part;
  const Lattice squares{ground.space.origin_m(), ground.space.cell_m()};
  const auto is_blocked = [&](Cell c) { return ground.space.is_blocked(c); };
  return sweep_touches(squares, at, centre, ground.lattice.radius_m(), is_blocked) ? 0 : part;
}

bool may_stay(const Pose2& access, const StandingPlace& best, const Point& landmark, const StandingGround& ground) {
  const double distance_m = (access.position() - landmark).norm();
  if (distance_m > kApproachReach_m || distance_m > best.distance_m + kStay_m) return false;
  if (best.keeps_margin && !ground.keeps_margin(ground.space.cell_at(access.position()))) return false;
  const double off_rad = wrap_angle(facing(access.position(), landmark).theta_rad - access.theta_rad);
  return std::abs(off_rad) <= kFacing_rad;
}

}  // namespace

void find_approach_poses(LandmarkGraph& graph, const StandingGround& ground, const DrivenPath& driven,
                         const Pose2& T_map_robot) {
  const std::set<std::int32_t> been_in = driven_parts(ground, driven, T_map_robot);
  std::map<LandmarkId, PlacesByPart> places;
  std::map<std::int32_t, int> landmarks_near;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (landmark.level != 0) continue;
    places[id] = places_near(landmark, ground);
    for (const auto& [part, place] : places[id]) ++landmarks_near[part];
  }
  for (const auto& [id, by_part] : places) {
    Landmark& landmark = *graph.find(id);
    const std::int32_t part_so_far = part_of_access(landmark, ground);
    const auto rank = [&](const PlacesByPart::value_type& one) {
      const auto& [part, place] = one;
      return std::tuple(been_in.contains(part), place.keeps_margin, landmarks_near.at(part), part == part_so_far,
                        -place.distance_m);
    };
    const auto best = std::ranges::max_element(by_part, {}, rank);
    if (best == by_part.end()) {
      landmark.access.reset();
      continue;
    }
    const auto& [part, place] = *best;
    const Point at = landmark.T_map_landmark.position();
    if (part == part_so_far && may_stay(*landmark.access, place, at, ground)) continue;
    landmark.access = facing(ground.space.centre_of(place.cell), at);
  }
}

}  // namespace cairn
