#include "maps/store/schema.hpp"

#include <array>

#include "maps/store/tables/codec.hpp"

namespace cairn::store {
namespace {

struct Definition {
  const char* name;
  const char* columns;  // as CREATE TABLE takes them
  const char* end = ")";
};

constexpr const char* kWithoutRowid = ") WITHOUT ROWID";
constexpr const char* kWithAnnotations = ", annotations TEXT NOT NULL)";
constexpr const char* kLandmarkColumns =
    "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, name TEXT NOT NULL, category TEXT NOT NULL, "
    "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, degree REAL NOT NULL, "
    "sightings INTEGER NOT NULL, access_x_m REAL, access_y_m REAL, access_theta_rad REAL";
constexpr const char* kTemplateColumns =
    "landmark INTEGER NOT NULL, rank INTEGER NOT NULL, category TEXT NOT NULL, orientation_rad REAL NOT NULL, "
    "degree REAL NOT NULL, PRIMARY KEY (landmark, rank)";
constexpr const char* kEvidenceColumns =
    "landmark INTEGER NOT NULL, category TEXT NOT NULL, matchings INTEGER NOT NULL, mean_degree REAL NOT NULL, "
    "best_degree REAL NOT NULL, last_degree REAL NOT NULL, PRIMARY KEY (landmark, category)";

// The tables of version 1. What each is for, column by column: docs/formats.md.
constexpr std::array kVersionOne{
    Definition{"meta", "key TEXT NOT NULL PRIMARY KEY, value TEXT NOT NULL", kWithoutRowid},
    Definition{"grid",
               "level INTEGER PRIMARY KEY, cell_m REAL NOT NULL, origin_x_m REAL NOT NULL, origin_y_m REAL NOT NULL, "
               "clamp_nat REAL NOT NULL, min_x INTEGER NOT NULL, min_y INTEGER NOT NULL, max_x INTEGER NOT NULL, "
               "max_y INTEGER NOT NULL"},
    // log_odds: 64 x 64 little-endian int16 in 1/256 nat, row by row from below, zlib; crc32 of the raw bytes.
    Definition{"tiles",
               "level INTEGER NOT NULL, ty INTEGER NOT NULL, tx INTEGER NOT NULL, log_odds BLOB NOT NULL, "
               "crc32 INTEGER NOT NULL, PRIMARY KEY (level, ty, tx)"},
    Definition{"landmarks", kLandmarkColumns, kWithAnnotations},
    // Templates and evidence of landmarks and retired ones are in one table.
    Definition{"landmark_templates", kTemplateColumns, kWithoutRowid},
    Definition{"landmark_evidence", kEvidenceColumns, kWithoutRowid},
    Definition{"retired_landmarks", kLandmarkColumns, ", reason TEXT NOT NULL, annotations TEXT NOT NULL)"},
    // trajectory: see trajectory.hpp; crc32 of its bytes.
    Definition{"routes",
               "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, from_landmark INTEGER NOT NULL, "
               "to_landmark INTEGER NOT NULL, cost_m REAL NOT NULL, driven INTEGER NOT NULL, closed INTEGER NOT NULL, "
               "poses INTEGER NOT NULL, trajectory BLOB NOT NULL, crc32 INTEGER NOT NULL, speed_limit_mps REAL",
               kWithAnnotations},
    // parent: 0 on the highest level.
    Definition{"clusters",
               "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, parent INTEGER NOT NULL, anchor INTEGER NOT NULL, "
               "name TEXT NOT NULL"},
    Definition{"landmark_clusters", "landmark INTEGER PRIMARY KEY, cluster INTEGER NOT NULL"},
    Definition{"next_ids", "kind TEXT NOT NULL PRIMARY KEY, id INTEGER NOT NULL", kWithoutRowid},
    // parameters: the diameter of a circle; "x,y x,y ..." of a polygon's corners (m), ";" between polygons.
    Definition{"shapes",
               "number INTEGER PRIMARY KEY, category TEXT NOT NULL, kind TEXT NOT NULL, parameters TEXT NOT NULL"},
    Definition{"driven_path",
               "number INTEGER PRIMARY KEY, x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL"},
    // One row, or none when no mission made the map. true_: where the simulated robot really was.
    Definition{"progress",
               "number INTEGER PRIMARY KEY, time_s REAL NOT NULL, step INTEGER NOT NULL, step_name TEXT NOT NULL, "
               "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, "
               "true_x_m REAL, true_y_m REAL, true_theta_rad REAL, distance_m REAL NOT NULL, readings INTEGER NOT "
               "NULL, matchings INTEGER NOT NULL, collisions INTEGER NOT NULL"},
    // Ids and a history of their own.
    Definition{"candidates", kLandmarkColumns, kWithAnnotations},
    Definition{"candidate_templates", kTemplateColumns, kWithoutRowid},
    Definition{"candidate_evidence", kEvidenceColumns, kWithoutRowid},
    Definition{"checksums", "table_name TEXT NOT NULL PRIMARY KEY, row_count INTEGER NOT NULL, crc32 INTEGER NOT NULL",
               kWithoutRowid},
};

// Version 2: what laser SLAM knows (maps/submaps/kept_submaps.hpp), and which landmarks are printed markers. echoes:
// width x height counts, zlib; crc32 of its bytes.
constexpr std::array kMigrations{
    "CREATE TABLE submap_nodes (number INTEGER PRIMARY KEY, stamp_s REAL NOT NULL, x_m REAL NOT NULL, y_m REAL NOT "
    "NULL, theta_rad REAL NOT NULL);"
    "CREATE TABLE submaps (anchor INTEGER PRIMARY KEY, finished INTEGER NOT NULL, cell_m REAL NOT NULL, min_x INTEGER "
    "NOT NULL, min_y INTEGER NOT NULL, width INTEGER NOT NULL, height INTEGER NOT NULL, echoes BLOB NOT NULL, crc32 "
    "INTEGER NOT NULL);"
    "CREATE TABLE submap_edges (number INTEGER PRIMARY KEY, from_node INTEGER NOT NULL, to_node INTEGER NOT NULL, "
    "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, xx REAL NOT NULL, xy REAL NOT NULL, xt REAL NOT "
    "NULL, yy REAL NOT NULL, yt REAL NOT NULL, tt REAL NOT NULL, closure INTEGER NOT NULL, believed INTEGER NOT NULL);"
    "CREATE TABLE landmark_markers (landmark INTEGER PRIMARY KEY, family TEXT NOT NULL, number INTEGER NOT NULL)"};
static_assert(kMapSchemaVersion == 1 + kMigrations.size());

// The steps from one version to another.
void run(Database& database, Migrations steps, int from_version, int to_version) {
  for (int version = from_version; version < to_version; ++version)
    database.execute(steps[static_cast<std::size_t>(version - 1)]);
}

void check_table(Database& database, const Table& table) {
  const std::string at = "table " + table.name;
  Statement stored(database, "SELECT row_count, crc32 FROM checksums WHERE table_name = ?");
  stored.bind_text(table.name);
  if (!stored.step()) throw StoreError("table checksums: has no row for table " + table.name);
  const Checksum found = checksum_of(database, table);
  if (found.row_count != stored.integer(0))
    throw StoreError(at + ": has " + std::to_string(found.row_count) + " rows, saved were " +
                     std::to_string(stored.integer(0)));
  if (found.crc != stored.integer(1))
    throw StoreError(at + ": its content does not match its checksum, it was damaged or edited");
}

}  // namespace

Migrations migrations() {
  return kMigrations;
}

Database migrated(Database map, int version, Migrations steps) {
  const int newest = 1 + static_cast<int>(steps.size());
  if (version == newest) return map;
  Database copy = Database::of_bytes(map.serialized());
  run(copy, steps, version, newest);
  return copy;
}

std::vector<Table> tables_of(Database& database) {
  std::vector<Table> tables;
  Statement table(database, "SELECT name, sql FROM sqlite_schema WHERE type = 'table' AND name <> 'checksums'");
  while (table.step()) {
    std::string key;
    Statement column(database, "SELECT name FROM pragma_table_info(?) WHERE pk > 0 ORDER BY pk");
    column.bind_text(table.text(0));
    while (column.step()) key += (key.empty() ? "" : ", ") + column.text(0);
    tables.push_back({table.text(0), key, table.text(1)});
  }
  return tables;
}

Checksum checksum_of(Database& database, const Table& table) {
  Checksum sum;
  Statement rows(database, "SELECT * FROM " + table.name + " ORDER BY " + table.key);
  for (; rows.step(); ++sum.row_count) sum.crc = crc32_of(rows.row_bytes(), sum.crc);
  return sum;
}

Database empty_map(int version) {
  Database database = Database::in_memory();
  database.execute("PRAGMA page_size = 4096; PRAGMA encoding = 'UTF-8'; PRAGMA secure_delete = ON");
  database.execute("PRAGMA application_id = " + std::to_string(kMapApplicationId));
  database.execute("PRAGMA user_version = " + std::to_string(version));
  database.execute("BEGIN");
  for (const auto& [name, columns, end] : kVersionOne)
    database.execute(std::string("CREATE TABLE ") + name + " (" + columns + end);
  run(database, migrations(), 1, version);
  return database;
}

EmptyMapFile empty_map_file(int version) {
  Database database = empty_map(version);
  database.execute("COMMIT");
  EmptyMapFile file{database.serialized(), {}};
  Statement roots(database, "SELECT rootpage FROM sqlite_schema");
  while (roots.step()) file.content_pages.insert(static_cast<std::uint32_t>(roots.integer(0)));
  return file;
}

void check_schema(Database& database, int version) {
  Database empty = empty_map(version);
  Statement expected(empty, "SELECT name, sql FROM sqlite_schema WHERE type = 'table'");
  while (expected.step()) {
    const std::string at = "table " + expected.text(0);
    Statement found(database, "SELECT sql FROM sqlite_schema WHERE type = 'table' AND name = ?");
    found.bind_text(expected.text(0));
    if (!found.step()) throw StoreError(at + ": is missing");
    if (found.text(0) != expected.text(1))
      throw StoreError(at + ": its columns are not those of schema version " + std::to_string(version));
  }
}

void write_checksums(Database& database) {
  Statement insert(database, "INSERT INTO checksums VALUES (?, ?, ?)");
  for (const Table& table : tables_of(database)) {
    const Checksum sum = checksum_of(database, table);
    insert.bind_text(table.name).bind(sum.row_count).bind(sum.crc).run();
  }
}

void check_checksums(Database& database, int version) {
  Database empty = empty_map(version);
  for (const Table& table : tables_of(empty)) check_table(database, table);
}

}  // namespace cairn::store
