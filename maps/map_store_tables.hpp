// The content of a saved map, to and from the tables of its schema.
#pragma once

#include "maps/map_store_sqlite.hpp"

namespace cairn::store {

void write_content(Database& database, const SavedMap& map);
// What the version does not know stays empty. Checks every value it takes over; throws StoreError with the table and
// what is wrong.
[[nodiscard]] SavedMap read_content(Database& database, int version);

// The tables of the clusters, into a map whose graph and next ids are there. Both check what they take over and throw
// StoreError, without the table's name.
void read_clusters(Database& database, SavedMap& map);
void read_landmark_clusters(Database& database, SavedMap& map);

}  // namespace cairn::store
