// The mission's planner, as behaviours and the landmark graph use it. The robot stands while it plans.
#pragma once

#include "framework/landmarks/tracker.hpp"
#include "framework/mission/loop/staged_modules.hpp"
#include "framework/planning/clusters_config.hpp"
#include "framework/safety/collision_monitor.hpp"
#include "maps/hierarchy/hierarchies.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// The clusters of a map that is gone on from; none for null. Where the mission divides otherwise than the one that
// saved them they are made anew, and names go to the clusters that hold the landmarks which the named ones were called
// after.
[[nodiscard]] ClusterTree clusters_to_begin_with(const ClustersConfig& config, const SavedMap* resume);

class Planning {
 public:
  // All must outlive it. clusters: of the graph as an earlier run has left them.
  Planning(const Mission& mission, const StagedModules& modules, const LandmarkGraph& graph, ClusterTree clusters,
           CollisionMonitor& monitor, const Budget& budget);

  [[nodiscard]] bool has_planner() const { return static_cast<bool>(modules_.planner); }
  // There must be a planner. Throws ModuleFault.
  [[nodiscard]] PlanResult plan(const PlanRequest& request, WorldView world);
  // Joins the landmarks by routes and brings the clusters in line; nothing without a planner. Throws ModuleFault.
  void connect(LandmarkTracker& tracker, WorldView world);

  // Brings the hierarchies in line with the graph; the clusters that come of it.
  [[nodiscard]] ClusterTree clusters(const OccupancyGrid& grid);
  // As they were last brought in line. When that is decides which ids the clusters get, so that what must change
  // nothing asks for these.
  [[nodiscard]] ClusterTree last_clusters() const { return hierarchies_.last_tree(); }
  // One of last_clusters().
  void name_cluster(ClusterId id, const std::string& name) { hierarchies_.name_cluster(id, name); }
  // For names of clusters; the graph may have changed since they were brought in line.
  [[nodiscard]] const Hierarchies& hierarchies() const { return hierarchies_; }

 private:
  const Mission& mission_;
  const StagedModules& modules_;
  CollisionMonitor& monitor_;
  const Budget budget_;
  const OccupancyGrid* grid_ = nullptr;  // that passages are seen in
  Hierarchies hierarchies_;
};

}  // namespace cairn
