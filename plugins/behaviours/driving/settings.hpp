// The settings of driving somewhere, shared by every behaviour that does.
#pragma once

#include "plugins/behaviours/driving/blockage_look.hpp"
#include "plugins/behaviours/driving/local_planning.hpp"
#include "plugins/behaviours/driving/planner_requests.hpp"
#include "plugins/behaviours/driving/recovery_ladder.hpp"
#include "plugins/behaviours/following/route_follower.hpp"
#include "plugins/behaviours/lookouts/lookout_route.hpp"

namespace cairn::behaviours {

// Turning to the heading of the goal, or to the landmark that was the goal.
struct FaceSettings {
  double faced_rad = radians(3.0);
  double at_most_s = 15.0;
  static void describe(Fields<FaceSettings>& fields);
};

struct DrivingSettings {
  PlanningSettings planning;
  FollowSettings follow;
  ProgressSettings progress;
  RecoverySettings recovery;
  LookSettings look;
  OptimismSettings optimism;
  LookoutCosts lookout_costs;
  LocalMapSettings local_map;
  LocalObstacleSettings obstacles;
  motion::TurnSettings turn;
  FaceSettings face;
  static void describe(Fields<DrivingSettings>& fields);
};

// The part of a behaviour's settings that is about driving somewhere: its config derives from this one.
struct RouteSettings {
  double speed_mps = 0.25;
  double tolerance_m = 0.1;
  double patience_s = 4.0;
  int rounds = 6;
  DrivingSettings driving;

  // Of a config that derives from it.
  template <class Config>
  static void describe_driving(Fields<Config>& fields) {
    fields
        .group("driving", static_cast<DrivingSettings Config::*>(&Config::driving),
               "how it plans, follows the path and recovers when it is blocked")
        .shared = "driving";
  }
  template <class Config>
  static void describe_route(Fields<Config>& fields) {
    fields.number("tolerance_m", &Config::tolerance_m, {0.01, 2.0}, "m", "this near to the end of the plan is there");
    fields.number("speed_mps", &Config::speed_mps, {0.01, 5.0}, "m/s", "top speed, within the robot's own limits");
    fields.number("patience_s", &Config::patience_s, {0.1, 3600.0}, "s",
                  "how long it waits for a blockage to go before it tries anything else");
    fields.template integer<int>("rounds", &Config::rounds, {1.0, 100.0},
                                 "how many recoveries are tried at one place before it gives up");
    describe_driving(fields);
  }
};

}  // namespace cairn::behaviours
