// Changes of a saved map that commands and the view's page make: the file is read, changed and saved as a whole.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/program/common/commands.hpp"
#include "maps/landmarks/captured_outline.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// give_name() in the file. Returns the id.
std::string name_in_map(const std::filesystem::path& map, const std::string& what, const std::string& name);

// Closes or opens the routes that the command names. Returns those that were not so before, in the order of their
// numbers; when there are none, the file is left alone.
std::vector<RouteId> set_closed_in_map(const CloseCommand& command, bool closed);

// What lies at the place, written as a template file. The map is only read. Throws std::runtime_error: there is
// nothing, or such a file already; ConfigError: no category can be called that, or the file would not load, and is not
// left.
struct CapturedTemplate {
  LandmarkShape shape;
  Point at_m{0.0, 0.0};  // in the map
};
CapturedTemplate capture_template(const CaptureCommand& command);

}  // namespace cairn
