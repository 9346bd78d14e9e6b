// Changes the file of a saved map into another map, and writes only what differs.
#pragma once

#include <cstdint>
#include <filesystem>

#include "maps/store/sqlite.hpp"

namespace cairn::store {

// Afterwards each table of the file has the rows of the wanted map, and all is on the disk. One transaction whose
// journal is in memory: whoever calls this needs another whole file, because a kill may leave this one damaged. Returns
// the bytes that were written. Throws StoreError, and the file is not to be used any more.
std::uint64_t update_map_file(const std::filesystem::path& file, Database& wanted);

}  // namespace cairn::store
