// Which cells lie in a beam, row by row.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/cell.hpp"

namespace cairn {

// A sector of a disc on a lattice with its origin at the map's: apex and axis from T_map_sensor.
// half_beam_rad 0 is a ray.
struct Beam {
  Pose2 T_map_sensor;
  double half_beam_rad = 0.0;
  double reach_m = 0.0;
};

// Spans that hold every cell of the beam, one a row, rows rising. For a cone a cell is of the beam
// when its centre is; for a ray, when the ray touches it and its centre is not beyond the reach.
// A span may hold a few cells more, so ask BeamFrame::place_of(). `spans` is replaced; it is the
// caller's so that its memory serves again.
void spans_over(const Beam& beam, double cell_m, std::vector<CellSpan>& spans);

// A cell as the sensor sees it.
struct BeamPlace {
  double range_m = 0.0;
  double bearing_rad = 0.0;
  bool is_inside = false;  // of the beam
};

// Cell centres in sensor coordinates; the bearing of a ray's cells is 0 and their range the centre's
// distance along the ray.
class BeamFrame {
 public:
  BeamFrame(const Beam& beam, double cell_m) : beam_(beam), cell_m_(cell_m), ahead_(beam.T_map_sensor.direction()) {}

  [[nodiscard]] BeamPlace place_of(Cell cell) const {
    const double dx = (cell.x + 0.5) * cell_m_ - beam_.T_map_sensor.x_m;
    const double dy = (cell.y + 0.5) * cell_m_ - beam_.T_map_sensor.y_m;
    const double along = ahead_.x() * dx + ahead_.y() * dy;
    if (beam_.half_beam_rad <= 0.0) return {std::max(0.0, along), 0.0, along <= beam_.reach_m};
    const double range = std::sqrt(dx * dx + dy * dy);
    if (range > beam_.reach_m) return {};
    const double bearing = std::atan2(ahead_.x() * dy - ahead_.y() * dx, along);
    return {range, bearing, std::abs(bearing) <= beam_.half_beam_rad};
  }

 private:
  Beam beam_;
  double cell_m_;
  Point ahead_;
};

}  // namespace cairn
