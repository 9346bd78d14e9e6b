// YAML files of Open-RMF -> landmarks and routes: navigation graphs (maps/exchange/rmf_nav_graph.hpp says what becomes
// of them) and buildings as the traffic editor saves them (`*.building.yaml`).
//
// Buildings. Vertices that a lane uses or that have a name become landmarks, with every graph_idx; bidirectional lanes
// become two routes. In the coordinate system reference_image a level's pixels become metres by the mean of its
// measurements, y upwards; a further level is laid over the first (or reference_level_name) by the fiducials that both
// have, at least two. cartesian_meters is taken as it is. Walls, floors, doors and lifts are not read (a warning).
#pragma once

#include <filesystem>
#include <optional>

#include "framework/config/config_value.hpp"
#include "maps/exchange/graphs/exchanged_graph.hpp"

namespace cairn {

// Whether a YAML file is one of Open-RMF: it has `levels`. Throws ConfigError when it has no image either, and a key
// that is spelt nearly like `levels`.
[[nodiscard]] bool is_rmf(const ConfigValue& root);

// Throws ConfigError with file:line:column: a missing key, a key that is spelt nearly like a known one, a lane to a
// vertex that is not there, an orientation other than forward and backward, numbers that are not finite, geographic
// coordinates.
[[nodiscard]] ImportedGraph rmf_graph_of(const ConfigValue& root);

}  // namespace cairn
