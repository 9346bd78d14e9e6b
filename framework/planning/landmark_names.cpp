#include "framework/planning/landmark_names.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

#include "framework/planning/place.hpp"
#include "maps/base/printable.hpp"
#include "maps/base/source_text.hpp"
#include "maps/base/spelling.hpp"

namespace cairn {
namespace {

constexpr std::size_t kLongestName = 200;

// Something of a map that can be named.
struct Named {
  std::string id;  // "L17", "C1:L17": what finds it whatever its name
  std::string* name = nullptr;
};

Named find_named(SavedMap& map, const std::string& what) {
  if (const Landmark* landmark = map.graph.find_by_name(what))
    return {fmt::format("L{}", landmark->id), &map.graph.find(landmark->id)->name};
  if (const Cluster* cluster = find_cluster(map.clusters, map.graph, what))
    return {fmt::format("C{}:L{}", cluster->level, cluster->anchor), &map.clusters.clusters.at(cluster->id).name};
  std::vector<std::string> known;
  for (const auto& [id, landmark] : map.graph.landmarks()) known.push_back(label_of(landmark));
  for (const auto& [id, cluster] : map.clusters.clusters) known.push_back(label_of(cluster, map.graph));
  throw std::runtime_error("there is no landmark and no cluster " + in_quotes(what) + did_you_mean(what, known) +
                           ": give a landmark's id or name (L17), or a cluster's (C1:L17)");
}

void check_name(const SavedMap& map, const Named& named, const std::string& name) {
  if (const std::string refusal = refusal_of_name(name, map.graph, map.clusters, named.name); !refusal.empty())
    throw std::runtime_error("the name " + in_quotes(name) + " cannot be given: " + refusal);
}

}  // namespace

std::string refusal_of_name(const std::string& name, const LandmarkGraph& graph, const ClusterTree& clusters,
                            const std::string* own) {
  if (name.empty()) return "it is empty";
  if (name.size() > kLongestName) return fmt::format("it is longer than {} bytes", kLongestName);
  if (exchange::first_not_utf8(name) != std::string::npos) return "it is not UTF-8 text";
  if (first_unprintable(name) != std::string::npos) return "it holds a control character";
  if (name.front() == ' ' || name.back() == ' ') return "it begins or ends with a blank";
  if (looks_like_id(name)) return "it looks like an id";
  if (marker_name_in(name)) return "it reads as a printed tag's number";
  if (reads_as_place(name)) return "it reads as a place: x,y or nearest CATEGORY";
  for (const auto& [id, landmark] : graph.landmarks())
    if (&landmark.name != own && landmark.name == name) return fmt::format("landmark L{} has it", id);
  for (const auto& [id, cluster] : clusters.clusters)
    if (&cluster.name != own && cluster.name == name)
      return fmt::format("cluster C{}:L{} has it", cluster.level, cluster.anchor);
  return "";
}

std::string give_name(SavedMap& map, const std::string& what, const std::string& name) {
  const Named named = find_named(map, what);
  if (!name.empty()) check_name(map, named, name);
  *named.name = name;
  return named.id;
}

}  // namespace cairn
