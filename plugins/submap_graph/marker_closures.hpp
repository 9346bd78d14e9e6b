// Printed markers tie the places that they were seen from to each other: a loop is closed without a search.
#pragma once

#include <map>
#include <optional>

#include "framework/contracts/marker.hpp"
#include "plugins/submap_graph/tied_graph.hpp"

namespace cairn::submap_graph {

class MarkerClosures {
 public:
  // A marker seen near a node. A closure with the node that it was seen from first, when that lies some way back; at
  // most one for each new node and marker. A sighting whose picture leaves two poses open says nothing.
  [[nodiscard]] std::optional<Closure> see(const MarkerSighting& sighting, std::size_t node, const Pose2& T_node_robot);

 private:
  struct Seen {
    std::size_t node = 0;
    Pose2 T_node_marker;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  // in the node's frame
  };
  struct Track {
    Seen first;
    std::size_t last_node = 0;
  };

  std::map<MarkerId, Track> tracks_;
};

}  // namespace cairn::submap_graph
