// What a range reading means, the same for every map (docs/method.md 2.1):
//   min_m <= range < max_m          an echo
//   range >= max_m, or +inf         no echo
//   range < min_m, negative, -inf   ignored: nearer than the sensor can measure
//   NaN                             ignored: a bad reading
// A reading whose own geometry is not finite, or whose half_beam is not in [0, pi], is ignored too; and
// every map ignores one whose beam leaves what a grid can hold, and observations under a pose that is
// not finite.
#pragma once

#include <vector>

#include "framework/contracts/observation.hpp"
#include "maps/grid/cell.hpp"

namespace cairn::sonar_model {

enum class Meaning { ignored, echo, silence };

[[nodiscard]] Meaning meaning_of(const RangeReading& reading);

// Makes spans what CellChanges promises: sorted, and joined where they overlap or meet.
void tidy(std::vector<CellSpan>& spans);

}  // namespace cairn::sonar_model
