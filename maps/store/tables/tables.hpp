// The content of a saved map, to and from the tables of its schema.
#pragma once

#include "maps/store/sqlite.hpp"

namespace cairn::store {

class Reading;

void write_content(Database& database, const SavedMap& map);
// Checks every value it takes over; throws StoreError with the table and what is wrong, unless the reading notes it and
// goes on.
[[nodiscard]] SavedMap read_content(Reading& reading);
// The same without the tiles; and the cells of a box alone, into a grid that knows its lattice and bounds.
[[nodiscard]] SavedMap read_content_without_tiles(Reading& reading);
[[nodiscard]] OccupancyGrid read_lattice(Reading& reading);
void read_tiles_within(Reading& reading, const CellBox& box, OccupancyGrid& grid);

// Whether a map needs version 2 for its printed markers.
[[nodiscard]] bool has_markers(const LandmarkGraph& graph);
// Landmarks, retired ones, and what is known of both.
void read_all_landmarks(Reading& reading, LandmarkGraph& graph);
void read_progress(Reading& reading, SavedMap& map);
// Laser SLAM's; nothing from a map of version 1, which has no tables for them.
void write_submaps(Database& database, const KeptSubmaps& submaps);
void read_submaps(Reading& reading, KeptSubmaps& submaps);
// The text of a JSON object, or nothing.
[[nodiscard]] std::string annotations_in(const Statement& row, int column);

// The tables of the clusters, into a map whose graph and next ids are there. Both check what they take over and throw
// StoreError, without the table's name.
void read_clusters(Database& database, SavedMap& map);
void read_landmark_clusters(Database& database, SavedMap& map);

}  // namespace cairn::store
