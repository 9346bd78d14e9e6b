// What a run that has left its map alone knows of its place, as JSON for reports (docs/localisation.md).
#pragma once

#include <string>

#include "framework/mission/localisation/self_finder.hpp"

namespace cairn {

// The same of a run that goes on with a map: whether the robot was carried.
[[nodiscard]] std::string start_check_json(const StartCheck& check);
[[nodiscard]] std::string localisation_json(const LocalisationFigures& figures);

}  // namespace cairn
