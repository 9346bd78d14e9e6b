#include "framework/landmarks/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/landmarks/evidence.hpp"
#include "framework/landmarks/matching_parts.hpp"

namespace cairn {
namespace {

constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();  // a part is of one place already

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
  if (landmark.name.empty()) landmark.name = other.name;
  add_evidence(landmark, other);
}

}  // namespace

LandmarkTracker::LandmarkTracker(const LandmarksConfig& config, const RobotModel& robot,
                                 std::vector<LandmarkShape> shapes, std::size_t max_path_poses)
    : config_(config),
      shapes_(std::move(shapes)),
      association_(config, shapes_),
      driven_(max_path_poses),
      connector_(config, robot) {}

void LandmarkTracker::restore(LandmarkGraph graph, LandmarkGraph candidates, std::vector<Pose2> driven_path) {
  graph_ = std::move(graph);
  candidates_ = std::move(candidates);
  driven_ = DrivenPath(std::move(driven_path), driven_.max_poses());
}

void LandmarkTracker::correct_path(const std::vector<Pose2>& T_map_robot) {
  driven_ = DrivenPath(driven_.max_poses());
  for (const Pose2& pose : T_map_robot) driven_.record(pose);
}

bool LandmarkTracker::name(LandmarkId id, const std::string& name) {
  Landmark* const landmark = graph_.find(id);
  if (landmark != nullptr) landmark->name = name;
  return landmark != nullptr;
}

void LandmarkTracker::record_pose(const PoseEstimate& pose) {
  driven_.record(pose.T_map_robot);
  association_.record_pose(pose);
}

std::vector<LandmarkTracker::Change> LandmarkTracker::update(const Matching& matching) {
  const std::vector<LandmarkId> changed =
      config_.association == AssociationRule::distance ? add_by_distance(matching) : add_by_template_sets(matching);
  std::vector<LandmarkId> confirmed;
  for (const auto& [id, candidate] : candidates_.landmarks())
    if (candidate.sightings >= config_.confirm_sightings) confirmed.push_back(id);
  std::vector<Change> changes;
  for (const LandmarkId id : changed) merge_beside(id, changes);
  for (const LandmarkId id : confirmed) confirm(id, changes);
  return changes;
}

std::vector<LandmarkId> LandmarkTracker::add_by_distance(const Matching& matching) {
  if (matching.detection) see(*matching.detection);
  std::vector<LandmarkId> changed;
  for (const auto& [id, landmark] : graph_.landmarks())
    if (add_evidence(*graph_.find(id), matching, config_.merge_m)) changed.push_back(id);
  for (const auto& [id, candidate] : candidates_.landmarks())
    add_evidence(*candidates_.find(id), matching, config_.merge_m);
  return changed;
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

std::vector<LandmarkId> LandmarkTracker::add_by_template_sets(const Matching& matching) {
  std::vector<LandmarkId> changed;
  const std::vector<Matching> parts = parts_of(matching, association_.split_m());
  if (parts.empty()) return changed;
  std::vector<LandmarkAssociation::Known> known;
  for (const auto& [id, landmark] : graph_.landmarks()) known.push_back({{id, false}, &landmark});
  for (const auto& [id, candidate] : candidates_.landmarks()) known.push_back({{id, true}, &candidate});
  const std::vector<LandmarkAssociation::Answer> answers = association_.associate(parts, known);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (const auto id = add_part(parts[i], answers[i])) changed.push_back(*id);
  return changed;
}

std::optional<LandmarkId> LandmarkTracker::add_part(const Matching& part, const LandmarkAssociation::Answer& answer) {
  LandmarkRef ref{0, true};
  if (answer.landmark) {
    ref = *answer.landmark;
  } else {
    if (!part.detection) return std::nullopt;
    ref.id = candidates_.add(first_seen(*part.detection));
    association_.found(ref);
  }
  Landmark& landmark = *(ref.is_candidate ? candidates_ : graph_).find(ref.id);
  landmark.sightings += part.detection ? 1 : 0;
  if (!answer.is_sure) {
    count_evidence(landmark, part, kAnywhere_m);
    return std::nullopt;
  }
  const Pose2 before = landmark.T_map_landmark;
  const bool is_changed = add_evidence(landmark, part, kAnywhere_m);
  if (answer.landmark && landmark.T_map_landmark != before) association_.placed(ref);
  return is_changed && !ref.is_candidate ? std::optional(ref.id) : std::nullopt;
}

// As its view has completed it may have come to lie where a landmark is.
void LandmarkTracker::confirm(LandmarkId candidate, std::vector<Change>& changes) {
  Landmark landmark = *candidates_.find(candidate);
  const LandmarkRef ref{candidate, true};
  const std::optional<LandmarkId> known = known_as(landmark);
  candidates_.remove(candidate);
  if (known) {
    absorb(*graph_.find(*known), landmark);
    association_.forget(ref);
    merge_beside(*known, changes);
  } else {
    landmark.id = 0;
    changes.push_back({graph_.add(std::move(landmark)), ChangeKind::found});
    association_.renamed(ref, {changes.back().landmark, false});
  }
}

std::optional<LandmarkId> LandmarkTracker::known_as(const Landmark& candidate) const {
  if (config_.association == AssociationRule::distance) {
    const Landmark* known = graph_.nearest(candidate.T_map_landmark.position(), config_.merge_m);
    return known == nullptr ? std::nullopt : std::optional(known->id);
  }
  std::optional<LandmarkId> best;
  double best_ratio = 0.0;
  for (const auto& [id, landmark] : graph_.landmarks()) {
    const double ratio = association_.log_ratio({{id, false}, &landmark}, {{candidate.id, true}, &candidate});
    if (ratio <= best_ratio) continue;
    best = id;
    best_ratio = ratio;
  }
  return best;
}

bool LandmarkTracker::are_one(const Landmark& a, const Landmark& b) const {
  if (config_.association == AssociationRule::distance)
    return (a.T_map_landmark.position() - b.T_map_landmark.position()).norm() <= config_.merge_m;
  return association_.log_ratio({{a.id, false}, &a}, {{b.id, false}, &b}) > 0.0;
}

// A view that completes moves a landmark; two that prove to be one were one from the beginning. The older stays.
void LandmarkTracker::merge_beside(LandmarkId id, std::vector<Change>& changes) {
  const Landmark* landmark = graph_.find(id);
  if (landmark == nullptr) return;  // merged already
  std::vector<LandmarkId> same;
  for (const auto& [other, there] : graph_.landmarks())
    if (other == id || are_one(there, *landmark)) same.push_back(other);
  const LandmarkId kept = same.front();
  for (std::size_t i = 1; i < same.size(); ++i) {
    Landmark& older = *graph_.find(kept);
    const Landmark younger = *graph_.find(same[i]);
    absorb(older, younger);
    graph_.retire(younger.id, "is " + label_of(older));
    association_.forget({younger.id, false});
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
  for (const Change& change : changes) {
    graph_.retire(change.landmark, "its place has been seen free");
    association_.forget({change.landmark, false});
  }
  std::vector<LandmarkId> forgotten;
  for (const auto& [id, candidate] : candidates_.landmarks())
    if (is_freed(candidate)) forgotten.push_back(id);
  for (const LandmarkId id : forgotten) {
    candidates_.remove(id);
    association_.forget({id, true});
  }
  return changes;
}

}  // namespace cairn
