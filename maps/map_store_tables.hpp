// The content of a saved map, to and from the tables of its schema.
#pragma once

#include "maps/map_store_sqlite.hpp"

namespace cairn::store {

void write_content(Database& database, const SavedMap& map);
// What the version does not know stays empty. Checks every value it takes over; throws StoreError with the table and
// what is wrong.
[[nodiscard]] SavedMap read_content(Database& database, int version);

}  // namespace cairn::store
