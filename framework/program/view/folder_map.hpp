// Which map a run's output folder stands for.
#pragma once

#include <filesystem>

namespace cairn {

// What its report names, or its only map (*.cairn). Throws std::runtime_error when it holds none, or several and no
// report that names one.
[[nodiscard]] std::filesystem::path map_in(const std::filesystem::path& folder);

}  // namespace cairn
