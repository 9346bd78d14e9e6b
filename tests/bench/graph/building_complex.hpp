// Landmark graphs of any size for tests and benches: a campus of buildings with floors, corridors and rooms.
#pragma once

#include <cstdint>

#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// About so many landmarks, at least a floor's. Corridors with junctions and rooms at them, some with doors between
// them; stairs between floors, paths and a few bridges between buildings; one in thirty routes is one-way. Costs are
// 1 to 1.3 times the straight distance, floors being 4 m apart. The same seed gives the same graph.
[[nodiscard]] LandmarkGraph building_complex(std::size_t landmarks, std::uint64_t seed);

}  // namespace cairn
