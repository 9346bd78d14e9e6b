#include "framework/planning/plan_task.hpp"

#include <array>
#include <stdexcept>

#include "framework/planning/place.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

constexpr std::array kCosts{CostKind::length, CostKind::time, CostKind::clearance};

// The landmarks that a landmark's or a cluster's name means.
std::vector<LandmarkId> landmarks_called(const std::string& name, const LandmarkGraph& graph,
                                         const ClusterTree& clusters) {
  if (graph.find_by_name(name) == nullptr)
    if (const Cluster* const cluster = find_cluster(clusters, graph, name)) return members_of(clusters, cluster->id);
  if (reads_as_place(name)) throw MalformedPlace("\"" + name + "\": only landmarks and clusters can be avoided");
  if (const Landmark* const landmark = graph.find_by_name(name)) return {landmark->id};
  std::vector<std::string> known;
  for (const auto& [id, landmark] : graph.landmarks()) known.push_back(label_of(landmark));
  for (const auto& [id, cluster] : clusters.clusters) known.push_back(label_of(cluster, graph));
  throw PlaceError("there is no landmark and no cluster \"" + name + "\" to avoid" + did_you_mean(name, known));
}

Place place_of(const std::string& name, const LandmarkGraph& graph, const ClusterTree& clusters,
               const std::optional<Pose2>& here) {
  if (!here || name != "here") return parse_place(name, graph, clusters);
  Place place;
  place.pose = here;
  return place;
}

}  // namespace

CostKind cost_kind_of(const std::string& name) {
  for (const CostKind kind : kCosts)
    if (name_of(kind) == name) return kind;
  throw std::invalid_argument("cost \"" + name + "\" is not length, time or clearance" +
                              did_you_mean(name, {"length", "time", "clearance"}));
}

void check(const PlanQuestion& question) {
  static_cast<void>(cost_kind_of(question.cost));
  if (!question.via.empty() && question.alternatives > 0)
    throw std::invalid_argument("alternatives are known from place to place, not for a tour");
}

PlanTask task_of(const PlanQuestion& question, const LandmarkGraph& graph, const ClusterTree& clusters,
                 const std::optional<Pose2>& here) {
  PlanTask task;
  task.request.from = place_of(question.from, graph, clusters, here);
  task.request.to = place_of(question.to, graph, clusters, here);
  for (const std::string& stop : question.via) task.via.push_back(place_of(stop, graph, clusters, here));
  for (const std::string& name : question.avoid) {
    const auto landmarks = landmarks_called(name, graph, clusters);
    task.request.avoid.insert(task.request.avoid.end(), landmarks.begin(), landmarks.end());
  }
  for (const std::string& route : question.closed) task.request.closed.push_back(parse_route(route, graph));
  task.request.cost = cost_kind_of(question.cost);
  task.request.alternatives = question.alternatives;
  task.request.explain = question.explain;
  return task;
}

}  // namespace cairn
