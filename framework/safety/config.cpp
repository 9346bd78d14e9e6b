#include "framework/safety/config.hpp"

namespace cairn {

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
}

}  // namespace cairn
