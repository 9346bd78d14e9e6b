#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "framework/planning/landmark_names.hpp"
#include "framework/program/common/commands.hpp"
#include "framework/program/common/print.hpp"
#include "maps/base/spelling.hpp"
#include "maps/clustering/cluster_tree.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {
namespace {

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

int map_name(const NameCommand& command, const CommonOptions& common) {
  SavedMap map = load_map(command.map);
  const Named named = find_named(map, command.what);
  if (!command.name.empty()) check_name(map, named, command.name);
  *named.name = command.name;
  save_map(command.map, map);
  print({{"map", command.map.string()}, {"id", named.id}, {"name", command.name}},
        named.id + (command.name.empty() ? " has no name any more" : " is " + command.name) + "\n", common);
  return kExitDone;
}

}  // namespace cairn
