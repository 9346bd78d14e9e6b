// How landmarks, candidates, routes and the driven path move with a map that was drawn anew.

#include <algorithm>
#include <utility>

#include "framework/landmarks/tracker.hpp"

namespace cairn {
namespace {

double length_m(const std::vector<Pose2>& trajectory) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    length_m += (trajectory[i].position() - trajectory[i - 1].position()).norm();
  return length_m;
}

void join_to(Pose2& end, const std::optional<Pose2>& access) {
  if (access && (end.position() - access->position()).norm() <= kMaxBend_m)
    end = {access->x_m, access->y_m, end.theta_rad};
}

}  // namespace

std::vector<LandmarkTracker::Change> LandmarkTracker::move(const MapMove& move) {
  driven_ = DrivenPath(driven_before_, driven_.max_poses());
  for (const Pose2& pose : move.after()) driven_.record(pose);
  poses_ = move.poses();
  std::vector<Change> changes;
  move_landmarks(move, changes);
  markers_.correct(move.after());
  for (const MarkerId& marker : markers_.markers()) move_marker(marker, changes);
  move_routes(move);
  connector_.move(move, graph_, [this](LandmarkId id) { return is_of_this_run(id); });
  association_.forget_places();
  return changes;
}

// After each change of landmarks. A candidate that has become a landmark was placed when the candidate was.
void LandmarkTracker::note_places() {
  std::map<LandmarkRef, Placed> placed;
  const auto now = poses_ == 0 ? std::nullopt : std::optional(poses_ - 1);
  const auto note = [&](LandmarkRef ref, const Pose2& T_map_landmark) {
    const auto is_there = [&](const auto& known) { return known.second.T_map_landmark == T_map_landmark; };
    auto known = placed_.find(ref);
    if (known == placed_.end() || !is_there(*known)) known = std::ranges::find_if(placed_, is_there);
    placed[ref] = known != placed_.end() ? known->second : Placed{T_map_landmark, now};
  };
  for (const auto& [id, landmark] : graph_.landmarks())
    if (!landmark.marker) note({id, false}, landmark.T_map_landmark);
  for (const auto& [id, candidate] : candidates_.landmarks()) note({id, true}, candidate.T_map_landmark);
  placed_ = std::move(placed);
}

void LandmarkTracker::move_landmarks(const MapMove& move, std::vector<Change>& changes) {
  for (auto& [ref, placed] : placed_) {
    Landmark* const landmark = (ref.is_candidate ? candidates_ : graph_).find(ref.id);
    if (landmark == nullptr || !placed.pose_number || *placed.pose_number >= move.poses()) continue;
    const Pose2 T = move.of_pose(*placed.pose_number);
    if (T == Pose2{}) continue;
    landmark->T_map_landmark = T * landmark->T_map_landmark;
    if (landmark->access) landmark->access = T * *landmark->access;
    placed.T_map_landmark = landmark->T_map_landmark;
    if (!ref.is_candidate) changes.push_back({ref.id, ChangeKind::changed});
  }
}

// The approach pose comes along, as that of every landmark.
void LandmarkTracker::move_marker(const MarkerId& marker, std::vector<Change>& changes) {
  const Landmark* const before = graph_.find_marker(marker);
  const std::optional<Pose2> T_map_before = before ? std::optional(before->T_map_landmark) : std::nullopt;
  place_marker(marker, changes);
  if (!T_map_before) return;
  Landmark& landmark = *graph_.find(graph_.find_marker(marker)->id);
  if (landmark.access) landmark.access = landmark.T_map_landmark * inverse(*T_map_before) * *landmark.access;
}

// Whether it was placed, or a marker confirmed, from a pose of this run: it moves with the map.
bool LandmarkTracker::is_of_this_run(LandmarkId id) const {
  const Landmark* const landmark = graph_.find(id);
  if (landmark == nullptr) return false;
  if (landmark->marker) {
    const std::optional<MarkerTracker::Estimate> estimate = markers_.estimate(*landmark->marker);
    return estimate && is_confirmed(*estimate);
  }
  const auto placed = placed_.find({id, false});
  return placed != placed_.end() && placed->second.pose_number.has_value();
}

// They keep their ids, and end at the approach poses of their landmarks. Where one is blocked now, or was bent, it is
// planned again when landmarks are joined next.
void LandmarkTracker::move_routes(const MapMove& move) {
  const std::map<RouteId, Route> routes = graph_.routes();
  for (const auto& [id, route] : routes) {
    if (route.trajectory.empty() || !is_of_this_run(route.from) || !is_of_this_run(route.to)) continue;
    Route moved = route;
    for (Pose2& pose : moved.trajectory) pose = move.near(pose.position()) * pose;
    join_to(moved.trajectory.front(), graph_.find(route.from)->access);
    join_to(moved.trajectory.back(), graph_.find(route.to)->access);
    moved.trajectory = in_whole_steps(std::move(moved.trajectory));
    const double before_m = length_m(route.trajectory);
    if (before_m > 0.0) moved.cost_m *= length_m(moved.trajectory) / before_m;
    graph_.remove_route(id);
    graph_.add_route(std::move(moved));
  }
}

}  // namespace cairn
