#include "maps/edit/merge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "maps/base/source_text.hpp"
#include "maps/base/text.hpp"
#include "maps/grid/grid_overlay.hpp"
#include "maps/hierarchy/hierarchy.hpp"
#include "maps/landmarks/landmark_pairs.hpp"

namespace cairn {
namespace {

Landmark laid_over(Landmark landmark, const Pose2& T_a_b) {
  landmark.T_map_landmark = T_a_b * landmark.T_map_landmark;
  if (landmark.access) landmark.access = T_a_b * *landmark.access;
  for (TemplateDegree& degree : landmark.templates)
    degree.orientation_rad = wrap_angle(degree.orientation_rad + T_a_b.theta_rad);
  return landmark;
}

int counted_together(int a, int b) {
  return a > std::numeric_limits<int>::max() - b ? std::numeric_limits<int>::max() : a + b;
}

void add_evidence(std::vector<CategoryEvidence>& all, const CategoryEvidence& more) {
  const auto found = std::ranges::find(all, more.category, &CategoryEvidence::category);
  if (found == all.end()) {
    all.push_back(more);
    std::ranges::sort(all, {}, &CategoryEvidence::category);
    return;
  }
  const int matchings = counted_together(found->matchings, more.matchings);
  if (matchings > 0)
    found->mean_degree = (found->matchings * found->mean_degree + more.matchings * more.mean_degree) /
                         (static_cast<double>(found->matchings) + more.matchings);
  found->matchings = matchings;
  found->best_degree = std::max(found->best_degree, more.best_degree);
}

class Merger {
 public:
  Merger(const SavedMap& a, const SavedMap& b, const MergeOptions& options)
      : a_(a), b_(b), options_(options), merged_{a, 0, 0, {}} {}

  MergedMap merge() {
    merged_.map.grid = with_evidence_of(a_.grid, b_.grid, options_.T_a_b);
    take_landmarks();
    take_routes();
    take_retired();
    take_rest();
    const ClusterSizes sizes;
    merged_.map.clusters =
        cluster_landmarks(graph(), {}, {sizes, passages_in(merged_.map.grid, graph(), sizes.narrow_below_m)});
    warn();
    return std::move(merged_);
  }

 private:
  LandmarkGraph& graph() { return merged_.map.graph; }

  void take_landmarks() {
    for (const auto& [id, landmark] : a_.graph.landmarks()) names_of_a_.insert(landmark.name);
    names_ = names_of_a_;
    for (const auto& [id, landmark] : b_.graph.landmarks()) names_.insert(landmark.name);
    for (const LandmarkPair& pair : near_pairs(a_.graph, b_.graph, options_.T_a_b, options_.near_m))
      if (a_.graph.find(pair.a)->marker == b_.graph.find(pair.b)->marker) of_b_[pair.b] = pair.a;
    // There is one tag of a number, however far off a map has it.
    for (const auto& [id, landmark] : b_.graph.landmarks())
      if (const Landmark* same = landmark.marker ? a_.graph.find_marker(*landmark.marker) : nullptr)
        of_b_[id] = same->id;
    merged_.joined_landmarks = of_b_.size();
    for (const auto& [id, landmark] : b_.graph.landmarks()) {
      Landmark moved = laid_over(landmark, options_.T_a_b);
      if (const auto joined = of_b_.find(id); joined != of_b_.end()) {
        join(*graph().find(joined->second), moved);
        continue;
      }
      moved.id = 0;
      moved.name = free_name(moved.name);
      of_b_[id] = graph().add(std::move(moved));
    }
  }

  void join(Landmark& mine, const Landmark& more) {
    if (more.degree > mine.degree) {
      mine.degree = more.degree;
      mine.templates = more.templates;
    }
    for (const CategoryEvidence& evidence : more.evidence) add_evidence(mine.evidence, evidence);
    if (!mine.access) mine.access = more.access;
    mine.sightings = counted_together(mine.sightings, more.sightings);
    if (mine.name.empty())
      mine.name = free_name(more.name);
    else
      names_lost_ += !more.name.empty() && more.name != mine.name;
    if (mine.annotations.empty())
      mine.annotations = more.annotations;
    else
      annotations_lost_ += !more.annotations.empty() && more.annotations != mine.annotations;
  }

  // The name of a landmark of b, or with a suffix when a landmark of a has it.
  std::string free_name(const std::string& name) {
    if (name.empty() || !names_of_a_.contains(name)) return name;
    for (int number = 2;; ++number)
      if (std::string other = fmt::format("{}_{}", name, number); names_.insert(other).second) {
        ++renamed_;
        return other;
      }
  }

  void take_routes() {
    for (const auto& [id, route] : b_.graph.routes()) {
      Route moved = route;
      moved.id = 0;
      moved.from = of_b_.at(route.from);
      moved.to = of_b_.at(route.to);
      for (Pose2& pose : moved.trajectory) pose = options_.T_a_b * pose;
      if (const Route* same = route_of_a_like(moved); same != nullptr) {
        ++merged_.joined_routes;
        closed_lost_ += same->closed != moved.closed;
        continue;
      }
      if (!moved.trajectory.empty() &&
          !(ends_at(moved.trajectory.front(), moved.from) && ends_at(moved.trajectory.back(), moved.to))) {
        moved.trajectory.clear();
        ++trajectories_lost_;
      }
      graph().add_route(std::move(moved));
    }
  }

  [[nodiscard]] const Route* route_of_a_like(const Route& route) const {
    for (const RouteId id : a_.graph.routes_from(route.from)) {
      const Route& other = *a_.graph.find_route(id);
      if (other.to == route.to && other.level == route.level &&
          std::abs(other.cost_m - route.cost_m) <= 2.0 * options_.near_m + 1e-9)
        return &other;
    }
    return nullptr;
  }
  // At a joined landmark no farther than a cell from where a robot stands there: what lies between is the same ground.
  [[nodiscard]] bool ends_at(const Pose2& end, LandmarkId id) const {
    const Landmark* joined = a_.graph.find(id);
    return joined == nullptr ||
           (end.position() - joined->approach_pose().position()).norm() <= merged_.map.grid.cell_m();
  }

  void take_retired() {
    for (const auto& [id, retired] : b_.graph.retired()) {
      RetiredLandmark moved{laid_over(retired.landmark, options_.T_a_b), retired.reason};
      moved.landmark.id = graph().next_landmark_id();
      graph().add_retired(std::move(moved));
    }
  }

  void take_rest() {
    merged_.map.progress.reset();
    for (const LandmarkShape& shape : b_.shapes)
      if (std::ranges::find(merged_.map.shapes, shape.category, &LandmarkShape::category) == merged_.map.shapes.end())
        merged_.map.shapes.push_back(shape);
    static const std::string kRadius = "robot_radius_m";
    const auto radius_of = [&](const SavedMap& map) {
      const auto found = map.properties.find(kRadius);
      return found == map.properties.end() ? -1.0 : number_from<double>(found->second).value_or(-1.0);
    };
    if (radius_of(b_) > radius_of(a_)) merged_.map.properties[kRadius] = b_.properties.at(kRadius);
  }

  void warn() {
    const auto report = [&](std::size_t count, const char* noun, const char* sentence) {
      exchange::warn_of(count, noun, sentence, merged_.warnings);
    };
    report(renamed_, "landmark", "the name is taken, so it got a suffix");
    report(names_lost_, "landmark", "one with a landmark of another name, which it keeps");
    report(annotations_lost_, "landmark", "what other tools keep with it is not taken over");
    report(closed_lost_, "route", "closed in one of the maps only; the first map counts");
    report(trajectories_lost_, "route",
           "the trajectory ends elsewhere than where a robot stands at the joined landmark, so only the cost is kept");
    report(a_.progress || b_.progress ? 1 : 0, "mission", "none can resume from a merged map: its progress is dropped");
    report(b_.driven_path.empty() ? 0 : 1, "driven path", "the second map's is not taken over");
    report(b_.submaps.submaps.size(), "submap", "the second map's are not taken over");
    const auto named = [](const SavedMap& map) {
      return static_cast<std::size_t>(
          std::ranges::count_if(map.clusters.clusters, [](const auto& entry) { return !entry.second.name.empty(); }));
    };
    report(named(a_) + named(b_), "cluster", "made anew, the name is lost");
  }

  const SavedMap& a_;
  const SavedMap& b_;
  const MergeOptions& options_;
  MergedMap merged_;
  std::map<LandmarkId, LandmarkId> of_b_;  // b's landmarks as they are called in the merged map
  std::set<std::string> names_of_a_;
  std::set<std::string> names_;  // of both, and those given here
  std::size_t renamed_ = 0;
  std::size_t names_lost_ = 0;
  std::size_t annotations_lost_ = 0;
  std::size_t closed_lost_ = 0;
  std::size_t trajectories_lost_ = 0;
};

}  // namespace

MergedMap merge_maps(const SavedMap& a, const SavedMap& b, const MergeOptions& options) {
  return Merger(a, b, options).merge();
}

}  // namespace cairn
