// Drives to a place by the mission's planner and controller, past whatever turns up: what every behaviour that goes
// somewhere uses.
//
//   RouteDriver driver(settings, seed);
//   const Status status = driver.tick(goal, world, context);  // every tick until it is no longer running
//
// Plans and follows the route (RouteFollower). When the robot is blocked it tries one recovery after the other
// (RecoveryLadder): wait, back up, turn or look whether the blockage has gone, yield to whoever waits, plan again round
// it, close the stored route for a while, and in the end give up with a reason that names the place and what was tried.
// Where the planner finds no path it tries paths on the local map (LocalPlanning), and goes to look whether what blocks
// the likeliest one is still there (BlockageLook): a door may have opened.
//
// When the map is exchanged for one that has places elsewhere, the planner's route moves along. It is planned again
// only when it is blocked on the new map or was bent by more than kMaxBend_m; other paths are always.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/route_goal.hpp"
#include "plugins/behaviours/driving/settings.hpp"
#include "plugins/behaviours/following/route_follower.hpp"
#include "plugins/behaviours/lookouts/lookout_route.hpp"
#include "plugins/behaviours/places/map_watch.hpp"

namespace cairn::behaviours {

class RouteDriver {
 public:
  RouteDriver(const RouteSettings& settings, std::uint64_t seed);

  // Success: the robot is at the goal, and faces the goal's heading if that matters (a landmark is not faced: see
  // goal_landmark()). Failure: the reason says where and why. The goal must stay the same until then; another one needs
  // a restart() before. Landmarks of the goal must be known to the graph.
  Status tick(const Place& goal, const WorldView& world, BehaviourContext& context);
  // Forgets everything but its settings.
  void restart();

  // The landmark of the goal that the route ends at; 0: a place, or no route yet.
  [[nodiscard]] LandmarkId goal_landmark() const { return goal_.landmark(); }

 private:
  enum class Mode { plan, travel, back_up, turn, look, face };

  void set_mode(Mode mode, double time_s);
  // The map has been exchanged: what it keeps of places, and whether the route under way is still good.
  void begin_in_new_map(const MapMove* move);
  [[nodiscard]] bool keeps_route(const MapMove& move, const WorldView& world);

  // route_driver.cpp: along the path, and at its end.
  Status travel(const WorldView& world, BehaviourContext& context);
  Status arrive(const WorldView& world, BehaviourContext& context);
  Status face(const WorldView& world, MotionRequests& context);

  // route_driver_planning.cpp: which path.
  Status plan(const WorldView& world, BehaviourContext& context);
  void plan_past(const WorldView& world, BehaviourContext& context);
  void take(const std::vector<Point>& path, Leg leg);
  void take_local(const LocalPath& path, const WorldView& world);
  void take_route(const PlanResult& result, const WorldView& world);
  [[nodiscard]] bool plan_locally(const WorldView& world, Optimism optimism);
  Status without_route(const PlanResult& result, const WorldView& world, BehaviourContext& context);
  [[nodiscard]] bool begin_escape(const WorldView& world);
  [[nodiscard]] bool begin_look(PlanOutcome outcome, const WorldView& world);
  [[nodiscard]] bool begin_look_at_goal(const Point& goal, const WorldView& world);
  void go_to_look(const LookoutRoute& route, const BlockageLook::Target& target);

  // route_driver_recovery.cpp: when the robot is blocked.
  Status recover(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] std::optional<Point> nearest_ahead(const WorldView& world) const;
  [[nodiscard]] bool begin_yield(const WorldView& world);
  void close_route_here(const WorldView& world, BehaviourContext& context);
  Status back_up(const WorldView& world, BehaviourContext& context);
  Status turn(const WorldView& world, BehaviourContext& context);
  Status begin_look_from_here(const WorldView& world, BehaviourContext& context);
  Status look(const WorldView& world, BehaviourContext& context);
  [[nodiscard]] Status give_up(const WorldView& world) const;
  [[nodiscard]] FreeSpace space(const WorldView& world, double clearance_m, Optimism optimism) const;

  RouteSettings settings_;
  std::uint64_t seed_;
  RouteGoal goal_;
  Mode mode_ = Mode::plan;
  double mode_since_s_ = 0.0;
  MapWatch map_watch_;
  LocalMap map_;
  RouteFollower follower_;
  PlannerRequests requests_;
  LocalPlanning local_planning_;
  BlockageLook look_;
  RecoveryLadder ladder_;
  BackUp back_up_;
  TurnRound turn_round_;
  bool has_reported_wait_ = false;
  std::string tried_;  // for the reason
};

}  // namespace cairn::behaviours
