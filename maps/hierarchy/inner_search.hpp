// Shortest ways inside one cluster, from one of its boundary vertices. Private to the hierarchy.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "maps/hierarchy/overlay.hpp"

namespace cairn {

// The inner graph of one cluster, for any number of searches. Refers to the passages of its members.
class InnerGraph {
 public:
  InnerGraph(const Network& network, const Clustering& clustering, ClusterIndex cluster, const Overlay& overlay);

  // Fills one row of Passage::cost and Passage::before (Dijkstra).
  void search(std::size_t source, std::span<double> cost, std::span<std::uint16_t> before);

 private:
  struct InnerArc {
    double cost = 0.0;
    std::uint32_t to = 0;
  };
  void relax(std::uint32_t from, std::uint32_t to, double through, std::span<double> cost,
             std::span<std::uint16_t> before);

  std::size_t nodes_ = 0;
  std::vector<std::uint32_t> begin_;  // of the arcs of each inner vertex
  std::vector<InnerArc> arcs_;
  std::vector<const Passage*> member_;       // of each inner vertex; empty on level 1
  std::vector<std::uint32_t> member_first_;  // first inner vertex of the same member
  std::vector<std::pair<double, std::uint32_t>> queue_;
};

}  // namespace cairn
