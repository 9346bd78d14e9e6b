// How a marker is printed.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/contracts/marker.hpp"

namespace cairn {

struct TagPattern {
  int cells = 0;            // along a side
  int detected_cells = 0;   // along a side of the square in its middle whose corners are detected
  std::vector<bool> white;  // row by row from the upper left
};

// Throws std::invalid_argument when the family has no such number.
[[nodiscard]] TagPattern pattern_of(const MarkerId& marker);

}  // namespace cairn
