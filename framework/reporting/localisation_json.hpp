// What a run that has left its map alone knows of its place, as JSON for reports (docs/localisation.md).
#pragma once

#include <string>

#include "framework/mission/localisation/self_finder.hpp"
#include "framework/mission/localisation/watch_figures.hpp"
#include "maps/submaps/kept_submaps.hpp"

namespace cairn {

// The same of a run that goes on with a map: whether the robot was carried.
[[nodiscard]] std::string start_check_json(const PoseCheck& check);
// The doubts of a mission under way, and the times that its robot was carried.
[[nodiscard]] std::string doubts_json(const WatchFigures& figures);
[[nodiscard]] std::string carried_json(const WatchFigures& figures);
// Of a saved map that has a pose graph: how many loops close it.
[[nodiscard]] std::string pose_graph_json(const SubmapCounts& counts);
[[nodiscard]] std::string localisation_json(const LocalisationFigures& figures);

}  // namespace cairn
