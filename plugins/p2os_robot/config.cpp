#include "plugins/p2os_robot/config.hpp"

namespace cairn::p2os_robot {

void Config::describe(Fields<Config>& fields) {
  fields.file("device", &Config::device, "the serial line");
  fields.integer("baud", &Config::baud, {9600, 115200}, "its speed: 9600, 19200, 38400, 57600 or 115200");
  fields.text("subclass", &Config::subclass,
              "the model in whose units the robot counts, as p3dx-sh or psos1m; empty: as the robot says");
  fields.number("no_echo_from_m", &Config::no_echo_from_m, {0.5, 20.0}, "m", "a range from there on means no echo");
  fields.flag("compass", &Config::has_compass, "the robot has one, and it is believed");
  fields.angle("compass_offset_deg", &Config::compass_offset_rad, {-360.0, 360.0},
               "heading in the map when the compass says 0");
  fields.number("battery_full_v", &Config::battery_full_v, {1.0, 100.0}, "V", "voltage of a full battery");
  fields.number("battery_empty_v", &Config::battery_empty_v, {0.0, 99.0}, "V", "voltage of an empty one");
  fields.number("guard_s", &Config::guard_s, {0.1, 2.0}, "s",
                "a process of its own stops the wheels when this one gives no sign of life for so long");
  fields.group("stop_when", &Config::stop_when, "when the wheels stop by themselves");
}

}  // namespace cairn::p2os_robot
