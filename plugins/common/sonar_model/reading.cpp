#include "plugins/common/sonar_model/reading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "maps/geometry/segments.hpp"

namespace cairn::sonar_model {

Meaning meaning_of(const RangeReading& reading) {
  const bool sane = is_finite(reading.T_robot_sensor) && reading.half_beam_rad >= 0.0 &&
                    reading.half_beam_rad <= std::numbers::pi && reading.max_m > 0.0;
  if (!sane || std::isnan(reading.range_m)) return Meaning::ignored;
  if (reading.range_m >= reading.max_m) return Meaning::silence;
  return reading.range_m >= reading.min_m && reading.range_m > 0.0 ? Meaning::echo : Meaning::ignored;
}

void tidy(std::vector<CellSpan>& spans) {
  std::sort(spans.begin(), spans.end(),
            [](const CellSpan& a, const CellSpan& b) { return a.y != b.y ? a.y < b.y : a.x_begin < b.x_begin; });
  std::size_t kept = 0;
  for (const CellSpan& span : spans) {
    CellSpan* const last = kept == 0 ? nullptr : &spans[kept - 1];
    if (last != nullptr && last->y == span.y && span.x_begin <= last->x_end)
      last->x_end = std::max(last->x_end, span.x_end);
    else
      spans[kept++] = span;
  }
  spans.resize(kept);
}

}  // namespace cairn::sonar_model
