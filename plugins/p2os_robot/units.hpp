// In which units a model of the Pioneers counts. Source: the parameter files that its makers published.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cairn::p2os_robot {

struct Units {
  double position_m = 0.001;     // a count of x and y
  double heading_rad = 0.0;      // a count of the heading
  double range_m = 0.001;        // a count of a sonar's range
  bool has_motor_switch = true;  // its motors are off until they are enabled
};

// Of the subclass that the robot names when it is connected to, as "p3dx-sh"; capitals do not count.
[[nodiscard]] std::optional<Units> units_of(std::string_view subclass);
// In alphabetical order.
[[nodiscard]] std::vector<std::string> known_subclasses();

}  // namespace cairn::p2os_robot
