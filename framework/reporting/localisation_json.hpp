// What a run that has left its map alone knows of its place, as JSON for reports (docs/localisation.md).
#pragma once

#include <string>

#include "framework/mission/localisation/self_finder.hpp"

namespace cairn {

[[nodiscard]] std::string localisation_json(const LocalisationFigures& figures);

}  // namespace cairn
