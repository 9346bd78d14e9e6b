#include "framework/landmarks/tracker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "framework/landmarks/evidence.hpp"
#include "framework/landmarks/matching_parts.hpp"

namespace cairn {
namespace {

constexpr int kUndecidedMarker = 4;  // times the sightings, after which the likelier of its two poses will do
constexpr double kMarkerMoved_m = 0.03;
constexpr double kMarkerMoved_rad = radians(2.0);
constexpr double kAnywhere_m = std::numeric_limits<double>::infinity();  // a part is of one place already

// Without evidence: add_evidence() adds what the matching says.
Landmark first_seen(const Detection& detection) {
  Landmark landmark;
  landmark.category = detection.category;
  landmark.T_map_landmark = detection.T_map_landmark;
  return landmark;
}

// As LandmarkGraph::nearest, of those that are no printed markers.
const Landmark* nearest_shape(const LandmarkGraph& graph, const Point& p_map, double within_m) {
  const Landmark* best = nullptr;
  double best_m = within_m;
  for (const auto& [id, landmark] : graph.landmarks()) {
    const double distance_m = (landmark.T_map_landmark.position() - p_map).norm();
    if (landmark.marker || (best == nullptr ? distance_m > best_m : distance_m >= best_m)) continue;
    best = &landmark;
    best_m = distance_m;
  }
  return best;
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
  driven_before_ = driven_path;
  driven_ = DrivenPath(std::move(driven_path), driven_.max_poses());
  association_ = LandmarkAssociation(config_, shapes_);
  markers_ = {};
  poses_ = 0;
  placed_.clear();
  for (const auto& [id, landmark] : graph_.landmarks())
    if (!landmark.marker) placed_[{id, false}] = {landmark.T_map_landmark, std::nullopt};
  for (const auto& [id, candidate] : candidates_.landmarks())
    placed_[{id, true}] = {candidate.T_map_landmark, std::nullopt};
  name_marker_categories();
}

void LandmarkTracker::expect_markers(std::map<int, std::string> categories, int confirm_sightings) {
  marker_categories_ = std::move(categories);
  confirm_marker_sightings_ = confirm_sightings;
  name_marker_categories();
}

// Of a map that was saved, too: what a marker is for is the mission's to say.
void LandmarkTracker::name_marker_categories() {
  for (const auto& [id, landmark] : graph_.landmarks()) {
    if (!landmark.marker) continue;
    const auto category = marker_categories_.find(landmark.marker->number);
    if (category != marker_categories_.end()) graph_.find(id)->category = category->second;
  }
}

std::vector<LandmarkTracker::Change> LandmarkTracker::update(std::span<const MarkerSighting> sightings) {
  std::vector<Change> changes;
  if (sightings.empty()) return changes;
  for (const MarkerId& marker : markers_.update(sightings, pose_, poses_ - 1)) place_marker(marker, changes);
  return changes;
}

bool LandmarkTracker::is_confirmed(const MarkerTracker::Estimate& estimate) const {
  return estimate.sightings >= confirm_marker_sightings_ &&
         (estimate.is_decided || estimate.sightings >= kUndecidedMarker * confirm_marker_sightings_);
}

void LandmarkTracker::place_marker(const MarkerId& marker, std::vector<Change>& changes) {
  const std::optional<MarkerTracker::Estimate> estimate = markers_.estimate(marker);
  if (!estimate) return;
  const Landmark* const known = graph_.find_marker(marker);
  // A marker of an earlier run stays where it was until this one has confirmed it.
  if (!is_confirmed(*estimate)) return;
  if (known == nullptr) {
    Landmark landmark;
    landmark.marker = marker;
    if (const auto category = marker_categories_.find(marker.number); category != marker_categories_.end())
      landmark.category = category->second;
    landmark.T_map_landmark = estimate->T_map_marker;
    landmark.degree = 1.0;
    landmark.sightings = estimate->sightings;
    changes.push_back({graph_.add(std::move(landmark)), ChangeKind::found});
    return;
  }
  Landmark& landmark = *graph_.find(known->id);
  landmark.sightings = std::max(landmark.sightings, estimate->sightings);
  const double moved_m = (landmark.T_map_landmark.position() - estimate->T_map_marker.position()).norm();
  const double turned_rad = std::abs(wrap_angle(landmark.T_map_landmark.theta_rad - estimate->T_map_marker.theta_rad));
  if (moved_m < kMarkerMoved_m && turned_rad < kMarkerMoved_rad) return;
  landmark.T_map_landmark = estimate->T_map_marker;
  changes.push_back({landmark.id, ChangeKind::changed});
}

bool LandmarkTracker::name(LandmarkId id, const std::string& name) {
  Landmark* const landmark = graph_.find(id);
  if (landmark != nullptr) landmark->name = name;
  return landmark != nullptr;
}

void LandmarkTracker::record_pose(const PoseEstimate& pose) {
  driven_.record(pose.T_map_robot);
  association_.record_pose(pose);
  pose_ = pose;
  ++poses_;
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
  note_places();
  return changes;
}

std::vector<LandmarkId> LandmarkTracker::add_by_distance(const Matching& matching) {
  if (matching.detection) see(*matching.detection);
  std::vector<LandmarkId> changed;
  for (const auto& [id, landmark] : graph_.landmarks())
    if (!landmark.marker && add_evidence(*graph_.find(id), matching, config_.merge_m)) changed.push_back(id);
  for (const auto& [id, candidate] : candidates_.landmarks())
    add_evidence(*candidates_.find(id), matching, config_.merge_m);
  return changed;
}

void LandmarkTracker::see(const Detection& detection) {
  const Point at_m = detection.T_map_landmark.position();
  if (const Landmark* known = nearest_shape(graph_, at_m, config_.merge_m)) {
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
  for (const auto& [id, landmark] : graph_.landmarks())
    if (!landmark.marker) known.push_back({{id, false}, &landmark});
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
    const Landmark* known = nearest_shape(graph_, candidate.T_map_landmark.position(), config_.merge_m);
    return known == nullptr ? std::nullopt : std::optional(known->id);
  }
  std::optional<LandmarkId> best;
  double best_ratio = 0.0;
  for (const auto& [id, landmark] : graph_.landmarks()) {
    if (landmark.marker) continue;
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
    if (other == id || (!there.marker && are_one(there, *landmark))) same.push_back(other);
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
    if (landmark.marker) return false;
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
