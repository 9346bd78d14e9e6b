// The saved map's tables, a checksum over each, and how those of an older schema version become today's.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "maps/store/file.hpp"
#include "maps/store/map_store.hpp"
#include "maps/store/sqlite.hpp"

namespace cairn::store {

inline constexpr std::int64_t kMapApplicationId = 0x43524E31;  // "CRN1"

// SQL by which the tables of one version become those of the next: the first step makes version 2.
using Migrations = std::span<const char* const>;
[[nodiscard]] Migrations migrations();  // all there are
// A map of an older version after all steps that its version has not had, as a copy in memory; else the map itself.
[[nodiscard]] Database migrated(Database map, int version, Migrations steps = migrations());

struct Table {
  std::string name;
  std::string key;  // rows are read in this order
  std::string definition;
  [[nodiscard]] bool has_rowid() const { return definition.ends_with(')'); }  // not: WITHOUT ROWID
};

// Those with content.
[[nodiscard]] std::vector<Table> tables_of(Database& database);
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
