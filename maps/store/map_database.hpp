// A saved map as a database: made in memory, or opened from its file and checked.
#pragma once

#include <filesystem>

#include "maps/store/sqlite.hpp"

namespace cairn::store {

// In memory, with all checksums. Throws std::invalid_argument when the map would not load again.
[[nodiscard]] Database database_of(const SavedMap& map);

// The file, with one state of it for all that is read. Throws StoreError, like all below.
[[nodiscard]] Database opened(const std::filesystem::path& file);
// Its pages fit together.
void check_pages(Database& database);
// Tables and checksums are right; with the tables of this version.
[[nodiscard]] Database checked(Database database);

}  // namespace cairn::store
