#include "framework/program/mission/clusters_json.hpp"

namespace cairn {

nlohmann::ordered_json json_of(const std::vector<ListedCluster>& clusters) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ListedCluster& one : clusters)
    list.push_back({{"id", one.cluster.id},
                    {"level", one.cluster.level},
                    {"parent", one.cluster.parent},
                    {"label", one.label},
                    {"anchor", one.cluster.anchor},
                    {"landmarks", one.landmarks}});
  return list;
}

}  // namespace cairn
