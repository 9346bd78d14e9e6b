#include "plugins/behaviours/places/place_name.hpp"

#include <algorithm>
#include <cstdio>

#include "framework/config/coordinates.hpp"
#include "framework/config/fields.hpp"
#include "framework/config/named_category.hpp"
#include "maps/base/text.hpp"
#include "maps/hierarchy/hierarchies.hpp"

namespace cairn::behaviours {
namespace {

void check_tag_is_possible(const std::string& name, const ConfigValue& value, const std::string& key) {
  if (const std::string fault = marker_name_fault(name); !fault.empty())
    throw ConfigError(value.place, key + ": " + in_quotes(name) + ": " + fault);
}

constexpr std::size_t kMaxListed = 12;
const std::string kNearest = "nearest ";

ClusterTree clusters_of(const WorldView& world) {
  return world.hierarchies == nullptr ? ClusterTree{} : world.hierarchies->last_tree();
}

std::string known_landmarks(const LandmarkGraph& graph) {
  if (graph.landmarks().empty()) return "the map holds no landmark";
  std::string list;
  std::size_t listed = 0;
  for (const auto& [id, landmark] : graph.landmarks()) {
    if (listed++ == kMaxListed) return "the map holds " + list + ", ...";
    list += (list.empty() ? "" : ", ") + described(landmark);
  }
  return "the map holds " + list;
}

// Those that people have named first.
std::string known_clusters(const ClusterTree& clusters, const LandmarkGraph& graph) {
  std::string list;
  std::size_t listed = 0;
  for (const bool named : {true, false})
    for (const auto& [id, cluster] : clusters.clusters) {
      if (cluster.name.empty() == named) continue;
      if (listed++ < kMaxListed) list += (list.empty() ? " and the clusters " : ", ") + label_of(cluster, graph);
    }
  return listed > kMaxListed ? list + ", ..." : list;
}

}  // namespace

PlaceName to_place_name(const ConfigValue& value, const std::string& key) {
  if (const std::optional<Point> at_m = point_in(value, key)) return place_name_of(*at_m);
  PlaceName name{config_detail::to_text(value, key), std::nullopt};
  if (names_nothing(name.text))
    throw ConfigError(value.place, key + ": " + in_quotes(name.text) +
                                       " is not a place; one is [x, y], a landmark's id (L3) or name, or `nearest "
                                       "CATEGORY`");
  check_tag_is_possible(name.text, value, key);
  return name;
}

std::string to_landmark_name(const ConfigValue& value, const std::string& key) {
  std::string name = config_detail::to_text(value, key);
  if (names_nothing(name))
    throw ConfigError(value.place, key + ": " + in_quotes(name) +
                                       " is not a landmark; one is an id (L3), a name, or `nearest CATEGORY`");
  if (const auto numbers = coordinates_in(name); numbers && numbers->size() > 1)
    throw ConfigError(value.place, key + ": " + in_quotes(name) +
                                       " is a place, and a landmark is wanted: an id (L3), a name, or `nearest "
                                       "CATEGORY`");
  check_tag_is_possible(name, value, key);
  return name;
}

PlaceName place_name_of(const Point& at_m) {
  return {described(at_m), at_m};
}

FoundPlace find_landmarks(const std::string& name, const LandmarkGraph& graph, const ClusterTree& clusters) {
  FoundPlace found;
  std::vector<std::string> names;
  if (name.starts_with(kNearest)) {
    const std::string category = name.substr(kNearest.size());
    found.place.landmarks = graph.of_category(category);
    if (!found.place.landmarks.empty()) return found;
    for (const auto& [id, landmark] : graph.landmarks()) names.push_back(landmark.category);
    found.unknown = "no landmark of category \"" + category + "\"" + did_you_mean(category, names);
  } else {
    if (const Landmark* landmark = graph.find_by_name(name)) return {{std::nullopt, false, {landmark->id}}, ""};
    if (const Cluster* cluster = find_cluster(clusters, graph, name)) {
      found.place.landmarks = members_of(clusters, cluster->id);
      std::erase_if(found.place.landmarks, [&](LandmarkId id) { return graph.find(id) == nullptr; });
      if (!found.place.landmarks.empty()) return found;
    }
    // A bare category is its nearest landmark, unless a landmark or a cluster is called so.
    found.place.landmarks = graph.of_category(name);
    if (!found.place.landmarks.empty()) return found;
    for (const auto& [id, landmark] : graph.landmarks()) {
      names.push_back(label_of(landmark));
      if (!landmark.category.empty()) names.push_back(landmark.category);
    }
    for (const auto& [id, cluster] : clusters.clusters) names.push_back(label_of(cluster, graph));
    found.unknown = std::string(clusters.clusters.empty() ? "no landmark \"" : "no landmark and no cluster \"") + name +
                    "\"" + did_you_mean(name, names) + "; " + known_landmarks(graph) + known_clusters(clusters, graph);
    return found;
  }
  found.unknown += "; " + known_landmarks(graph);
  return found;
}

FoundPlace find_place(const PlaceName& name, const LandmarkGraph& graph, const ClusterTree& clusters) {
  if (name.at_m) return {{Pose2{name.at_m->x(), name.at_m->y(), 0.0}, false, {}}, ""};
  return find_landmarks(name.text, graph, clusters);
}

FoundPlace find_landmarks(const std::string& name, const WorldView& world) {
  return find_landmarks(name, world.graph, clusters_of(world));
}

FoundPlace find_place(const PlaceName& name, const WorldView& world) {
  return find_place(name, world.graph, clusters_of(world));
}

bool names_cluster(const std::string& name, const WorldView& world) {
  return !name.starts_with(kNearest) && world.graph.find_by_name(name) == nullptr &&
         find_cluster(clusters_of(world), world.graph, name) != nullptr;
}

bool names_retired(const Place& goal, const LandmarkGraph& graph) {
  return std::ranges::any_of(goal.landmarks, [&](LandmarkId id) { return graph.find(id) == nullptr; });
}

std::string described(const Landmark& landmark) {
  return label_of(landmark) + (landmark.category.empty() ? "" : " (" + landmark.category + ")");
}

std::string described(const Point& at_m) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f, %.2f)", at_m.x(), at_m.y());
  return text;
}

LandmarkId cheapest_of(const std::vector<LandmarkId>& ids, const WorldView& world, BehaviourContext& context) {
  if (ids.size() == 1) return ids.front();
  PlanRequest request;
  request.from.pose = world.pose.T_map_robot;
  request.to.landmarks = ids;
  request.radius_m = world.robot.radius_m;
  const PlanResult result = context.plan(request);
  const bool is_one = !result.landmarks.empty() && std::ranges::find(ids, result.landmarks.back()) != ids.end();
  if (result.outcome == PlanOutcome::solved && is_one) return result.landmarks.back();
  const auto distance_m = [&](LandmarkId id) {
    const Landmark* const landmark = world.graph.find(id);
    return landmark == nullptr ? 1e9 : (landmark->T_map_landmark.position() - world.pose.T_map_robot.position()).norm();
  };
  return *std::ranges::min_element(ids, {}, distance_m);
}

ChosenLandmark choose_landmark(const std::string& name, const WorldView& world, BehaviourContext& context) {
  const FoundPlace found = find_landmarks(name, world);
  if (!found.unknown.empty()) return {0, found.unknown};
  return {cheapest_of(found.place.landmarks, world, context), ""};
}

std::string lost(LandmarkId id, const LandmarkGraph& graph) {
  const std::string label = "L" + std::to_string(id);
  const auto retired = graph.retired().find(id);
  return label + " is not a landmark any more" +
         (retired == graph.retired().end() ? "" : ": " + retired->second.reason);
}

}  // namespace cairn::behaviours
