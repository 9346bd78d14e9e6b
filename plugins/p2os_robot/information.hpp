// The server information packet: what the microcontroller says ten or twenty times a second.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cairn::p2os_robot {

struct HeardSonar {
  int number = 0;
  int range_counts = 0;
};

struct Information {
  int x_counts = 0;  // of 15 bits: it wraps round
  int y_counts = 0;
  int heading_counts = 0;
  double battery_v = 0.0;
  bool is_stalled = false;
  bool is_bumped = false;
  bool are_motors_on = false;      // not of PSOS
  bool is_emergency = false;       // a button is pressed, or has not been released; not of PSOS
  int compass = 0;                 // in 2 degrees
  std::vector<HeardSonar> sonars;  // those only that have been heard since the last packet
};

// None: data of another packet, or too few of them.
[[nodiscard]] std::optional<Information> information_of(std::span<const std::uint8_t> data);

}  // namespace cairn::p2os_robot
