// Joins the landmarks of a graph by routes, and keeps these up to date while map and landmarks change.
//
// Each landmark gets an approach pose (where a robot stands to be at it) and routes to and from its nearest others.
// A pair that stays joined keeps its route ids. It is planned again only when one of its approach poses has moved or
// when the grid has changed where a path no longer than the known one could pass; for a planner that finds shortest
// paths this gives the routes that planning everything again would give.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/landmarks/config.hpp"
#include "framework/landmarks/driven_path.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class LandmarkConnector {
 public:
  LandmarkConnector(const LandmarksConfig& config, const RobotModel& robot) : config_(config), robot_(robot) {}

  using Plan = std::function<PlanResult(const PlanRequest&)>;
  // A route is the path that the robot drove between the two where there is one, a planned one elsewhere. Whenever
  // plan is called the graph is whole, so that a call which never returns costs the routes to come and nothing else.
  void connect(LandmarkGraph& graph, const DrivenPath& driven, const WorldView& world, const Plan& plan,
               std::uint64_t seed);

 private:
  using Pair = std::pair<LandmarkId, LandmarkId>;  // the lower id first
  // What a pair was planned with, and the answer.
  struct Link {
    Pose2 from;
    Pose2 to;
    std::optional<std::vector<Pose2>> path;  // none: there was no route
    double length_m = 0.0;
  };

  void find_access(LandmarkGraph& graph, const WorldView& world) const;
  [[nodiscard]] std::vector<Pair> wanted_pairs(const LandmarkGraph& graph) const;
  [[nodiscard]] bool is_current(const Link& link, const Landmark& from, const Landmark& to,
                                const std::vector<Point>& changed_m) const;
  [[nodiscard]] Link planned(const Landmark& from, const Landmark& to, const Plan& plan, std::uint64_t seed) const;
  void store(LandmarkGraph& graph, const Pair& pair, const Link& link, const DrivenPath& driven) const;

  LandmarksConfig config_;
  RobotModel robot_;
  std::map<Pair, Link> links_;
  std::optional<OccupancyGrid> planned_on_;  // the grid of the last connect()
};

}  // namespace cairn
