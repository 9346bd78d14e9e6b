// The saved map's tables, and a checksum over each. Version 2 added evidence and retired landmarks, version 3
// clusters, annotations and speed limits, version 4 how far the mission has come, version 5 smaller
// tiles and trajectories.
#pragma once

#include <span>
#include <string>

#include "maps/store/file.hpp"
#include "maps/store/map_store.hpp"
#include "maps/store/sqlite.hpp"

namespace cairn::store {

inline constexpr std::int64_t kMapApplicationId = 0x43524E31;  // "CRN1"

struct Table {
  const char* name;
  const char* order;    // its key: rows are read in this order
  const char* columns;  // as CREATE TABLE takes them
  const char* options;  // behind the columns
  int since = 1;        // schema version
  // Columns that a later version put behind the others, and which: none before that version.
  const char* added = "";
  int added_since = 1;
  int options_until = kMapSchemaVersion;  // a later version has none
};

[[nodiscard]] std::span<const Table> tables();
[[nodiscard]] bool has_rowid(const Table& table, int version);
// A map of that version without content, and a transaction begun in it.
[[nodiscard]] Database empty_map(int version);
// The tables are made before all content, so every map of a version has their definitions and roots in these pages.
[[nodiscard]] EmptyMapFile empty_map_file(int version);
// Every table of that version exists exactly as empty_map makes it; throws StoreError with the first that
// does not.
void check_schema(Database& database, int version);

struct Checksum {
  std::int64_t row_count = 0;
  std::uint32_t crc = 0;
};
[[nodiscard]] Checksum checksum_of(Database& database, const Table& table);

void write_checksums(Database& database);
void check_checksums(Database& database, int version);

}  // namespace cairn::store
