#include "framework/landmarks/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/landmarks/evidence.hpp"

namespace cairn {
namespace {

// Without evidence: add_evidence() adds what the matching says.
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

LandmarkTracker::LandmarkTracker(const LandmarksConfig& config, const RobotModel& robot,
                                 std::vector<LandmarkShape> shapes, std::size_t max_path_poses)
    : config_(config), shapes_(std::move(shapes)), driven_(max_path_poses), connector_(config, robot) {}

void LandmarkTracker::restore(LandmarkGraph graph, LandmarkGraph candidates, std::vector<Pose2> driven_path) {
  graph_ = std::move(graph);
  candidates_ = std::move(candidates);
  driven_ = DrivenPath(std::move(driven_path), driven_.max_poses());
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

}  // namespace cairn
