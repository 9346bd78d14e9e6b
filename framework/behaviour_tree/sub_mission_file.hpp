// Reads the files that the node `mission` names.
#pragma once

#include <filesystem>

#include "framework/behaviour_tree/nodes.hpp"
#include "framework/config/config_value.hpp"

namespace cairn {

// including: the file that names it; place: where. Throws ConfigError; a file that is not there is reported at that
// place. What an error says of a file outside the including one's folder that is not a sub-mission holds nothing of its
// text: a mission from elsewhere may name anything that its reader can read.
[[nodiscard]] SubMissionFile read_sub_mission(const std::filesystem::path& file, const std::filesystem::path& including,
                                              const SourcePlace& place);

}  // namespace cairn
