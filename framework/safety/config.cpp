#include "framework/safety/config.hpp"

namespace cairn {

void DeafConfig::describe(Fields<DeafConfig>& fields) {
  using C = DeafConfig;
  fields.integer("rounds", &C::rounds, {1, 6},
                 "a transducer counts as deaf that has said \"no echo\" so many times where the map predicts one");
  fields.integer("ring_echoes", &C::ring_echoes, {2, 12},
                 "all silent ones count as deaf when so many predicted echoes in a row were heard by none of the ring");
  fields.number("within_m", &C::within_m, {1.0, 4.0}, "m", "echoes from farther away are not predicted");
  fields.number("occupied_p", &C::occupied_p, {0.6, 0.95}, "",
                "a cell that is to echo is occupied with this probability");
  fields.angle("max_incidence_deg", &C::max_incidence_rad, {5.0, 40.0},
               "no echo is predicted of a wall that is seen at a slant of more than that: smooth ones do not answer");
  fields.number("max_pose_m", &C::max_pose_m, {0.02, 0.5}, "m",
                "nothing is predicted while the position's standard deviation is more than that");
  fields.angle("max_heading_deg", &C::max_heading_rad, {1.0, 20.0}, "the same of the heading");
  fields.number(
      "silent_m", &C::silent_m, {0.5, 10.0}, "m",
      "driven without an echo of any transducer, wherever: from then on the robot goes at silent_mps at most");
  fields.number("silent_mps", &C::silent_mps, {0.02, 0.1}, "m/s", "until something is heard again");
}

SpeedLaw CollisionMonitorConfig::speed_law() const {
  SpeedLaw law;
  law.margin_m = margin_m;
  law.slow_m = slow_m;
  return law;
}

void CollisionMonitorConfig::describe(Fields<CollisionMonitorConfig>& fields) {
  fields.number("margin_m", &CollisionMonitorConfig::margin_m, {0.01, 1.0}, "m",
                "stop zone: kept between the footprint and anything seen");
  fields.number("slow_m", &CollisionMonitorConfig::slow_m, {0.02, 2.0}, "m",
                "slow zone: so far beyond the margin the robot goes at 0.4 of its top speed at most");
  fields.number("stale_s", &CollisionMonitorConfig::stale_s, {0.2, 10.0}, "s",
                "how long an echo counts; where no transducer has answered for so long, the robot creeps");
  fields.number("blind_s", &CollisionMonitorConfig::blind_s, {0.02, 1.0}, "s",
                "no driving after so long without any reading; without it, one and a half firing periods, or where the "
                "robot's file gives none, one and a half times the measured gap, 1 s at most");
  fields.number("command_valid_s", &CollisionMonitorConfig::command_valid_s, {0.1, 2.0}, "s",
                "a command counts so long, by the robot's clock: without another one the wheels stop by themselves");
  fields.number("stop_after_s", &CollisionMonitorConfig::stop_after_s, {0.1, 2.0}, "s",
                "the wheels are stopped when no tick has ended for so long, by the wall clock, whatever is busy");
  fields.group("deaf", &CollisionMonitorConfig::deaf,
               "when a transducer that says \"no echo\" is not believed any more: the robot creeps to where it looks");
}

}  // namespace cairn
