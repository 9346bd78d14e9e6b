// What the page changes in a saved map, as `cairn map name`, `close`, `open` and `cairn template capture` do.
#pragma once

#include <filesystem>
#include <string>

#include "framework/program/view/view_request.hpp"

namespace cairn {

// change: "name" {"what", "name"}, "close" and "open" {"route", "both_ways"}, "capture" {"at", "category", "radius_m"},
// whose file is CATEGORY.yaml beside the map. 400 with its reason when it cannot be made; the map is then as before.
// 404: there is no such change.
[[nodiscard]] ViewResponse edit_map(const std::filesystem::path& map, const std::string& change,
                                    const std::string& body);

}  // namespace cairn
