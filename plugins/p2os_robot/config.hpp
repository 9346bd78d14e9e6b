// Settings of `p2os_robot` (docs/your-robot.md).
#pragma once

#include <filesystem>
#include <string>

#include "framework/config/fields.hpp"
#include "framework/live/live_robot.hpp"

namespace cairn::p2os_robot {

struct Config {
  std::filesystem::path device = "/dev/ttyUSB0";
  int baud = 9600;
  std::string subclass;  // empty: as the robot says
  double no_echo_from_m = 4.9;
  bool has_compass = false;
  double compass_offset_rad = 0.0;
  double battery_full_v = 13.0;
  double battery_empty_v = 11.0;
  double guard_s = 0.3;
  live::LiveRules stop_when;

  static void describe(Fields<Config>& fields);
};

}  // namespace cairn::p2os_robot
