#include "framework/experiments/recognition/ring_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cairn {
namespace {

double middle_of(int bin) {
  return kProfileBegin_m + (bin + 0.5) * kProfileStep_m;
}

}  // namespace

RingProfile& RingProfile::operator+=(const RingProfile& more) {
  for (std::size_t b = 0; b < ol.size(); ++b) {
    ol[b] += more.ol[b];
    cells[b] += more.cells[b];
  }
  return *this;
}

double RingProfile::ring_at_m() const {
  double weight = 0.0;
  double moment = 0.0;
  for (int b = 0; b < kProfileBins; ++b) {
    const auto i = static_cast<std::size_t>(b);
    if (cells[i] == 0) continue;
    const double above = std::max(0.0, ol[i] / static_cast<double>(cells[i]) - 127.0);
    weight += above;
    moment += above * middle_of(b);
  }
  return weight > 0.0 ? moment / weight : 0.0;
}

RingProfile ring_profile(const OccupancyGrid& grid, const World& world) {
  RingProfile profile;
  for (const WorldObject& object : world.objects) {
    if (object.category.empty()) continue;
    const Pose2 T_object_map = inverse(object.T_map_object);
    const double reach_m = 0.5 * object.contour.outer_diameter_m() + kProfileEnd_m;
    const Cell middle = grid.cell_at(object.T_map_object.position());
    const int reach = static_cast<int>(std::ceil(reach_m / grid.cell_m())) + 1;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Cell cell = middle + Cell{x, y};
        const double distance_m = object.contour.signed_distance(T_object_map * grid.centre_of(cell));
        const double bin = std::floor((distance_m - kProfileBegin_m) / kProfileStep_m);
        if (bin < 0.0 || bin >= kProfileBins) continue;
        const auto b = static_cast<std::size_t>(bin);
        profile.ol[b] += grid.ol(cell);
        ++profile.cells[b];
      }
  }
  return profile;
}

}  // namespace cairn
