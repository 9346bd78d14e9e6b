// Forms the clusters of a small network: places that are near by way, divided where passages are narrow. Private to the
// hierarchy.
//
// Routes with a passage that is not narrow join landmarks; what they join is a cluster, divided by METIS where it is
// too large. Where no passage is known at all METIS divides by the costs of routes alone. The result depends on
// landmarks and routes only, not on the order in which they came, save for ids, anchors and names: a cluster takes
// those of the former cluster that it shares most landmarks with, a named one first. Each named cluster keeps its name
// as long as one of its landmarks is left: where two of them would become one, they are divided between their anchors.
#pragma once

#include <map>
#include <vector>

#include "maps/clustering/cluster_builder.hpp"

namespace cairn {

class ClusterFormer {
 public:
  ClusterFormer(Clustering& clustering, const Network& network, const Proposal& propose, const PassageWidths& widths);

  // In place of the present clusters, of which there need not be any.
  void form();
  // Into a clustering without levels. As saved where that fits the network, else formed anew out of what is saved.
  void restore(const ClusterTree& saved);

 private:
  using Group = std::vector<VertexIndex>;
  struct Former {  // cluster
    ClusterId id = 0;
    LandmarkId anchor = 0;
    std::string name;
    Group vertices;  // that are left
  };

  [[nodiscard]] std::vector<Former> former_clusters() const;
  [[nodiscard]] bool is_wanted(const std::vector<Former>& former) const;
  [[nodiscard]] std::vector<Group> groups() const;
  [[nodiscard]] std::vector<Group> joined_by_wide_passages(const std::map<RouteId, double>& widths) const;
  void divide_between_names(std::vector<Group>& groups, const std::vector<Former>& former) const;
  void replace(const std::vector<Group>& groups, const std::vector<Former>& former);
  void add(const Group& group, const Former& as);

  Clustering& clustering_;
  const Network& network_;
  const Proposal& propose_;
  const PassageWidths& widths_;
  std::vector<VertexIndex> vertices_;  // by rising landmark
};

}  // namespace cairn
