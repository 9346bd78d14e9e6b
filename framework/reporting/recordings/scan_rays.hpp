// Which of a robot's ranges are a laser's scan.
#pragma once

#include <cstddef>
#include <span>

#include "framework/contracts/observation.hpp"

namespace cairn {

// How many rays at the beginning are a laser's scan: from one place, as far from each to the next; 0: it is none.
[[nodiscard]] std::size_t rays_of_a_scan(std::span<const RangeReading> ranges);

}  // namespace cairn
