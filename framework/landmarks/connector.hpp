// Joins the landmarks of a graph by routes, and keeps these up to date while map and landmarks change.
//
// Each landmark gets an approach pose (approach_poses.hpp) and routes to and from its nearest others, by travel; more
// routes join what these leave apart, so that the graph has a way between two landmarks whenever the grid has one
// between their approach poses from cell centre to cell centre. The grid is that of level 0: landmarks of other levels,
// and the routes that touch them, stay as they are.
//
// A pair that stays joined keeps its route ids. It is planned again only when one of its approach poses has moved or
// when the grid has changed where a path no longer than the known one could pass; for a planner that finds shortest
// paths this gives the routes that planning everything again would give. Where the planner finds no path, the known
// route stays while it leads to the approach poses and is free on the grid.
//
// When the map has been exchanged for one that has places elsewhere, all cells have changed, but most routes only lie
// elsewhere: then a pair is planned again only when its path is not free on the new grid or was bent by more than
// kMaxBend_m.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/landmarks/association/join_candidates.hpp"
#include "framework/landmarks/config.hpp"
#include "framework/landmarks/driven_path.hpp"
#include "maps/geometry/map_move.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

class LandmarkConnector {
 public:
  // A plan may be so much longer than the shortest path, to keep room beside the robot.
  static constexpr double kMaxMarginDetour = 1.2;

  LandmarkConnector(const LandmarksConfig& config, const RobotModel& robot) : config_(config), robot_(robot) {}

  using Plan = std::function<PlanResult(const PlanRequest&)>;
  // A route is the path that the robot drove between the two where there is one that is free and keeps as much room as
  // the planned one, a planned one elsewhere.
  // Where the planner finds none, whatever its reason, and a robot that turns on the spot would not be joined
  // otherwise, it is the shortest one over cell centres. Routes that are not wanted any more go last, and none goes
  // that alone joins two landmarks and is free. Whenever plan is called the graph is whole, so that a call which never
  // returns costs the routes to come and nothing else.
  void connect(LandmarkGraph& graph, const DrivenPath& driven, const WorldView& world, const Plan& plan,
               std::uint64_t seed);
  // The map has been exchanged, and the graph's landmarks have moved: those that have_moved says.
  void move(const MapMove& move, const LandmarkGraph& graph, const std::function<bool(LandmarkId)>& has_moved);

 private:
  // What a pair was planned with, and the answer.
  struct Link {
    Pose2 from;
    Pose2 to;
    std::optional<std::vector<Pose2>> path;  // none: no route is known
    double length_m = 0.0;
    bool is_planned = false;  // the path is the planner's answer
    bool has_moved = false;   // with the map, since the last connect()
  };
  // What one connect() works on and has done so far.
  struct Round;

  // They say whether the pair is joined.
  bool join(Round& round, const RouteEnds& pair) const;
  bool store(Round& round, const RouteEnds& pair, const Link& link) const;
  void join_what_is_apart(Round& round, const JoinCandidates& candidates) const;
  void remove_unwanted(Round& round) const;
  [[nodiscard]] bool is_current(const Link& link, const Landmark& from, const Landmark& to, const Round& round) const;
  [[nodiscard]] static std::optional<Link> moved(const MapMove& move, const Link& link, const Pose2& from,
                                                 const Pose2& to);
  [[nodiscard]] Link planned(const Round& round, const Landmark& from, const Landmark& to) const;
  [[nodiscard]] Link over_cells(const Round& round, const RouteEnds& pair, const std::vector<Cell>& cells) const;
  [[nodiscard]] bool is_good(const Route& route, const Round& round) const;
  // Of the disc that paths are planned for, so that they are free for the robot when rounded.
  [[nodiscard]] double planned_radius_m() const { return robot_.radius_m + kMaxRounding_m; }
  // Where there is room.
  [[nodiscard]] double radius_with_margin_m() const { return planned_radius_m() + config_.access_margin_m; }

  LandmarksConfig config_;
  RobotModel robot_;
  std::map<RouteEnds, Link> links_;
  std::optional<OccupancyGrid> planned_on_;  // the grid of the last connect()
};

}  // namespace cairn
