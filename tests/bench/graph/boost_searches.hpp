// The searches of Boost.Graph that the hierarchical one is measured against, called as who knows them would: on the
// compressed graph, with space that is used again, and stopped at the goal.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class BoostSearches {
 public:
  // Positions are taken in three dimensions, floors being `floor_m` apart. Keeps nothing of the graph.
  BoostSearches(const LandmarkGraph& graph, double floor_m);
  ~BoostSearches();

  // Infinite: there is no way. settled() is of the last search, way() leads from goal to start.
  double dijkstra(LandmarkId from, LandmarkId to);
  // With the straight line to the goal, which no route may be shorter than.
  double astar(LandmarkId from, LandmarkId to);
  [[nodiscard]] std::int64_t settled() const { return settled_; }
  [[nodiscard]] const std::vector<std::size_t>& way() const { return way_; }

  // Costs to all landmarks, by rising id.
  const std::vector<double>& dijkstra_tree(LandmarkId from);

 private:
  struct Model;
  template <class Search>
  double stopped_at(std::size_t goal, Search search);

  std::unique_ptr<Model> model_;
  std::int64_t settled_ = 0;
  std::vector<std::size_t> way_;
};

}  // namespace cairn
