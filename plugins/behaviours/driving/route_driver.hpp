// Drives to a place by the mission's planner, past whatever turns up: what every behaviour that goes somewhere uses.
//
//   RouteDriver driver(settings, seed);
//   const Status status = driver.tick(goal, world, orders);  // every tick until it is no longer running
//
// Plans, follows the route with the local planner, and when it does not get on climbs a ladder: wait, back up, turn or
// look whether the way is free again, make way for whoever waits, plan again (round what it was held back by), close
// the stored route that is blocked for a while, and in the end give up with a reason that names the place and what was
// tried. A hold-up elsewhere begins the ladder anew. Where the map has no way it goes to look whether what blocks the
// likeliest one is still there: a door may have opened.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "plugins/behaviours/driving/free_space.hpp"
#include "plugins/behaviours/driving/local_planner.hpp"
#include "plugins/behaviours/driving/lookout_route.hpp"
#include "plugins/behaviours/driving/path_follower.hpp"
#include "plugins/behaviours/driving/progress_checker.hpp"
#include "plugins/behaviours/driving/recent_echoes.hpp"

namespace cairn::behaviours {

inline constexpr double kTraceSpacing_m = 0.1;  // of the poses that a behaviour remembers

// The part of a behaviour's settings that is about driving somewhere: its config derives from this one.
struct RouteSettings {
  double speed_mps = 0.25;
  double tolerance_m = 0.1;
  double patience_s = 4.0;
  int rounds = 6;

  // Of a config that derives from it.
  template <class Config>
  static void describe_route(Fields<Config>& fields) {
    fields.number("tolerance_m", &Config::tolerance_m, {0.01, 2.0}, "m", "this near to the end of the plan is there");
    fields.number("speed_mps", &Config::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
    fields.number("patience_s", &Config::patience_s, {0.1, 3600.0}, "s",
                  "waited for what is in the way to go, before anything else is tried");
    fields.template integer<int>("rounds", &Config::rounds, {1.0, 100.0},
                                 "how often backing up, turning and planning again are tried at one place before it "
                                 "gives up");
  }
};

class RouteDriver {
 public:
  RouteDriver(const RouteSettings& settings, std::uint64_t seed);

  // Success: the robot is at the goal, and faces the goal's heading if that matters (a landmark is not faced: see
  // goal_landmark()). Failure: the reason says where and why. The goal must stay the same until then; another one needs
  // a restart() before. Landmarks of the goal must be known to the graph.
  Status tick(const Place& goal, const WorldView& world, BehaviourContext& orders);
  // Forgets everything but its settings.
  void restart();

  // The landmark of the goal that the route ends at; 0: a place, or no route yet.
  [[nodiscard]] LandmarkId goal_landmark() const { return goal_landmark_; }

 private:
  static constexpr double kPlansApart_s = 1.0;
  static constexpr double kClosedFor_s = 60.0;  // a stored route that was blocked
  static constexpr double kBesideGoal_m = 0.5;  // from the robot's rim

  enum class Mode { plan, travel, back_up, turn, look, face };
  enum class Leg { route, escape_path, to_look, aside };  // what the path is
  // What of the map counts: all of it; not specks; not specks, and what is unknown is taken to be free; besides, what
  // leaves less room than the robot needs may be the width of the sonars' beams.
  enum class Trust { all, no_specks, only_solid, squeezed };

  // Facing a place until it is free, or for long enough.
  struct Look {
    Point at{0.0, 0.0};
    double at_least_s = 3.0;
    double at_most_s = 25.0;      // for a door to open
    bool is_goal = false;         // it is blocked, and looked at from beside
    bool is_live = false;         // it held the robot back, whatever the map has there
    std::map<Cell, int> through;  // occupied cells about it: for how many ticks more they were seen through than not
  };

  void remember(const WorldView& world);
  void set_mode(Mode mode, double time_s);
  Status plan(const WorldView& world, BehaviourContext& orders);
  [[nodiscard]] PlanResult ask_planner(const WorldView& world, BehaviourContext& orders);
  void take_path(const std::vector<Point>& path, Leg leg);
  void take_route(const PlanResult& result, const WorldView& world);
  [[nodiscard]] std::optional<Point> goal_point(const WorldView& world) const;
  [[nodiscard]] bool plan_by_own_eyes(const WorldView& world, Trust trust);
  Status no_plan(const PlanResult& result, const WorldView& world, BehaviourContext& orders);
  [[nodiscard]] bool begin_escape(const WorldView& world);
  [[nodiscard]] bool begin_look(PlanOutcome outcome, const WorldView& world);
  [[nodiscard]] bool begin_look_at_goal(const Point& goal, const WorldView& world);
  void go_to_look(const LookoutRoute& way);

  Status travel(const WorldView& world, BehaviourContext& orders);
  Status arrive(const WorldView& world, BehaviourContext& orders);
  Status progress_checker(const WorldView& world, BehaviourContext& orders);
  [[nodiscard]] std::optional<Point> nearest_ahead(const WorldView& world) const;
  [[nodiscard]] bool begin_aside(const WorldView& world);
  Status back_up(const WorldView& world, BehaviourContext& orders);
  Status turn(const WorldView& world, BehaviourContext& orders);
  void plan_past(const WorldView& world, BehaviourContext& orders);
  [[nodiscard]] bool has_opened(const WorldView& world);
  [[nodiscard]] std::vector<Cell> seen_through() const;
  [[nodiscard]] bool is_seen_through(Cell cell) const;
  Status begin_look_from_here(const WorldView& world, BehaviourContext& orders);
  Status look(const WorldView& world, BehaviourContext& orders);
  Status face(const WorldView& world, BehaviourContext& orders);
  void close_route_here(const WorldView& world, BehaviourContext& orders);
  [[nodiscard]] Status give_up(const WorldView& world) const;
  [[nodiscard]] FreeSpace space_now(const WorldView& world, double clearance_m, Trust trust) const;
  [[nodiscard]] std::vector<Cell> doubtful_cells(const OccupancyGrid& map) const;
  void doubt(const std::vector<Cell>& cells, const WorldView& world);
  void doubt_as(Trust trust, const WorldView& world);
  void doubt_along_path(const WorldView& world);
  void stop_doubting();
  [[nodiscard]] bool is_blocked(const WorldView& world, const std::vector<Point>& path, double along_m, double ahead_m,
                                double radius_m) const;

  RouteSettings settings_;
  std::uint64_t seed_;
  Place goal_;
  Mode mode_ = Mode::plan;
  double mode_since_s_ = 0.0;
  Leg leg_ = Leg::route;
  std::vector<Point> path_;
  FollowState follow_state_;
  LandmarkId goal_landmark_ = 0;
  std::optional<Point> route_end_;     // of the last plan that was solved
  std::vector<PathSegment> segments_;  // of the path, when it is the planner's
  std::map<RouteId, double> closed_until_s_;

  RecentEchoes echoes_;
  std::vector<Pose2> trace_;           // where the robot has been
  std::vector<TroubleSpot> troubles_;  // where it was held back
  std::vector<TroubleSpot> shut_;      // what held it back on a way through what is unknown: there is none
  CellSet doubted_;                    // left out of account on the way by its own eyes
  std::vector<Point> doubted_places_;  // the occupied ones
  LocalPlanner local_;
  ProgressChecker watch_;
  Twist preferred_;  // of the last tick
  double planned_s_ = -1e9;
  int plans_ = 0;
  int escape_paths_ = 0;
  int looks_ = 0;
  int unknown_ways_ = 0;
  int squeezes_ = 0;
  std::optional<Trust> own_trust_;  // the path is one by its own eyes
  Look look_;
  std::vector<Point> looked_at_;
  std::vector<Point> beside_goal_;  // where it has stood to look at a goal that is blocked
  int round_ = 0;                   // of the ladder, at this place
  int hold_ups_ = 0;                // in all
  Point held_at_{1e9, 1e9};
  std::optional<Point> held_by_;
  double turn_left_rad_ = 0.0;
  double last_theta_rad_ = 0.0;
  bool said_wait_ = false;
  std::string tried_;  // for the reason
};

}  // namespace cairn::behaviours
