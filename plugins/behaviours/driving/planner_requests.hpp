// Asks the mission's planner for a drive's route: with as much room as there is a path for, and without the stored
// routes that were found blocked while there is another.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"

namespace cairn::behaviours {

struct PlanningSettings {
  std::vector<double> clearances_m{0.12, 0.06, 0.0};
  double plans_apart_s = 1.0;
  double local_plans_apart_s = 3.0;
  int max_plans = 200;
  double closed_for_s = 60.0;
  static void describe(Fields<PlanningSettings>& fields);
};

class PlannerRequests {
 public:
  // speed_mps: of the drive; 0: as the robot can.
  PlannerRequests(const PlanningSettings& settings, std::uint64_t seed, double speed_mps = 0.0)
      : settings_(settings), seed_(seed), speed_mps_(speed_mps) {}

  // Every tick: opens routes that were closed for long enough.
  void tick(double time_s);
  [[nodiscard]] PlanResult ask(const Place& goal, const WorldView& world, MotionRequests& context);
  void close(RouteId route, double time_s) { closed_until_s_[route] = time_s + settings_.closed_for_s; }

  // Whether the last plan, also one on the local map, is long enough ago.
  [[nodiscard]] bool may_plan(double time_s) const { return time_s - planned_s_ >= settings_.plans_apart_s; }
  [[nodiscard]] bool may_plan_locally(double time_s) const {
    return time_s - planned_s_ >= settings_.local_plans_apart_s;
  }
  void note_local_plan(double time_s) { planned_s_ = time_s; }
  [[nodiscard]] bool is_used_up() const { return plans_ >= settings_.max_plans; }
  [[nodiscard]] int plans() const { return plans_; }

 private:
  PlanningSettings settings_;
  std::uint64_t seed_;
  double speed_mps_;
  double planned_s_ = -1e9;
  int plans_ = 0;
  std::map<RouteId, double> closed_until_s_;
};

}  // namespace cairn::behaviours
