#include "maps/store/schema.hpp"

#include <array>

#include "maps/store/codec.hpp"

namespace cairn::store {
namespace {

// What a table is for, column by column: docs/formats.md.
constexpr std::array kTables{
    Table{"meta", "key", "key TEXT NOT NULL PRIMARY KEY, value TEXT NOT NULL", " WITHOUT ROWID"},
    Table{"grid", "level",
          "level INTEGER PRIMARY KEY, cell_m REAL NOT NULL, origin_x_m REAL NOT NULL, origin_y_m REAL NOT NULL, "
          "clamp_nat REAL NOT NULL, min_x INTEGER NOT NULL, min_y INTEGER NOT NULL, max_x INTEGER NOT NULL, "
          "max_y INTEGER NOT NULL",
          ""},
    // log_odds: 64 x 64 little-endian int16 in 1/256 nat, row by row from below, zlib; crc32 of the raw bytes.
    Table{"tiles", "level, ty, tx",
          "level INTEGER NOT NULL, ty INTEGER NOT NULL, tx INTEGER NOT NULL, log_odds BLOB NOT NULL, "
          "crc32 INTEGER NOT NULL, PRIMARY KEY (level, ty, tx)",
          " WITHOUT ROWID", 1, "", 1, 4},
    Table{"landmarks", "id",
          "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, name TEXT NOT NULL, category TEXT NOT NULL, "
          "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, degree REAL NOT NULL, "
          "sightings INTEGER NOT NULL, access_x_m REAL, access_y_m REAL, access_theta_rad REAL",
          "", 1, ", annotations TEXT NOT NULL", 3},
    Table{"landmark_templates", "landmark, rank",
          "landmark INTEGER NOT NULL, rank INTEGER NOT NULL, category TEXT NOT NULL, orientation_rad REAL NOT NULL, "
          "degree REAL NOT NULL, PRIMARY KEY (landmark, rank)",
          " WITHOUT ROWID"},
    Table{"landmark_evidence", "landmark, category",
          "landmark INTEGER NOT NULL, category TEXT NOT NULL, matchings INTEGER NOT NULL, mean_degree REAL NOT NULL, "
          "best_degree REAL NOT NULL, last_degree REAL NOT NULL, PRIMARY KEY (landmark, category)",
          " WITHOUT ROWID", 2},
    // As landmarks; templates and evidence of both are in one table.
    Table{"retired_landmarks", "id",
          "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, name TEXT NOT NULL, category TEXT NOT NULL, "
          "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, degree REAL NOT NULL, "
          "sightings INTEGER NOT NULL, access_x_m REAL, access_y_m REAL, access_theta_rad REAL, reason TEXT NOT NULL",
          "", 2, ", annotations TEXT NOT NULL", 3},
    // trajectory: see map_store_trajectory.hpp; crc32 of the blob, before version
    // 5 of the doubles in it. No bytes at all when there is no pose, since
    // version 3.
    Table{"routes", "id",
          "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, from_landmark INTEGER NOT NULL, "
          "to_landmark INTEGER NOT NULL, cost_m REAL NOT NULL, driven INTEGER NOT NULL, closed INTEGER NOT NULL, "
          "poses INTEGER NOT NULL, trajectory BLOB NOT NULL, crc32 INTEGER NOT NULL",
          "", 1, ", speed_limit_mps REAL, annotations TEXT NOT NULL", 3},
    // parent: 0 on the highest level.
    Table{"clusters", "id",
          "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, parent INTEGER NOT NULL, anchor INTEGER NOT NULL, "
          "name TEXT NOT NULL",
          "", 3},
    Table{"landmark_clusters", "landmark", "landmark INTEGER PRIMARY KEY, cluster INTEGER NOT NULL", "", 3},
    Table{"next_ids", "kind", "kind TEXT NOT NULL PRIMARY KEY, id INTEGER NOT NULL", " WITHOUT ROWID"},
    // parameters: the diameter of a circle; "x,y x,y ..." of a polygon's corners (m), ";" between polygons.
    Table{"shapes", "number",
          "number INTEGER PRIMARY KEY, category TEXT NOT NULL, kind TEXT NOT NULL, parameters TEXT NOT NULL", ""},
    Table{"driven_path", "number",
          "number INTEGER PRIMARY KEY, x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL", ""},
    // One row, or none when no mission made the map. true_: where the simulated robot really was.
    Table{"progress", "number",
          "number INTEGER PRIMARY KEY, time_s REAL NOT NULL, step INTEGER NOT NULL, step_name TEXT NOT NULL, "
          "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, "
          "true_x_m REAL, true_y_m REAL, true_theta_rad REAL, distance_m REAL NOT NULL, readings INTEGER NOT NULL, "
          "matchings INTEGER NOT NULL, collisions INTEGER NOT NULL",
          "", 4},
    // As landmarks, with ids and a history of their own.
    Table{"candidates", "id",
          "id INTEGER PRIMARY KEY, level INTEGER NOT NULL, name TEXT NOT NULL, category TEXT NOT NULL, "
          "x_m REAL NOT NULL, y_m REAL NOT NULL, theta_rad REAL NOT NULL, degree REAL NOT NULL, "
          "sightings INTEGER NOT NULL, access_x_m REAL, access_y_m REAL, access_theta_rad REAL, "
          "annotations TEXT NOT NULL",
          "", 4},
    Table{"candidate_templates", "landmark, rank",
          "landmark INTEGER NOT NULL, rank INTEGER NOT NULL, category TEXT NOT NULL, orientation_rad REAL NOT NULL, "
          "degree REAL NOT NULL, PRIMARY KEY (landmark, rank)",
          " WITHOUT ROWID", 4},
    Table{"candidate_evidence", "landmark, category",
          "landmark INTEGER NOT NULL, category TEXT NOT NULL, matchings INTEGER NOT NULL, mean_degree REAL NOT NULL, "
          "best_degree REAL NOT NULL, last_degree REAL NOT NULL, PRIMARY KEY (landmark, category)",
          " WITHOUT ROWID", 4},
};

constexpr Table kChecksums{"checksums", "table_name",
                           "table_name TEXT NOT NULL PRIMARY KEY, row_count INTEGER NOT NULL, crc32 INTEGER NOT NULL",
                           " WITHOUT ROWID"};

const char* options_of(const Table& table, int version) {
  return version <= table.options_until ? table.options : "";
}

std::string definition_of(const Table& table, int version) {
  const char* const added = version >= table.added_since ? table.added : "";
  return std::string("CREATE TABLE ") + table.name + " (" + table.columns + added + ")" + options_of(table, version);
}

void check_definition(Database& database, const Table& table, int version) {
  Statement found(database, "SELECT sql FROM sqlite_schema WHERE type = 'table' AND name = ?");
  found.bind_text(table.name);
  const std::string at = std::string("table ") + table.name;
  if (!found.step()) throw StoreError(at + ": is missing");
  if (found.text(0) != definition_of(table, version))
    throw StoreError(at + ": its columns are not those of schema version " + std::to_string(version));
}

void check_table(Database& database, const Table& table) {
  const std::string at = std::string("table ") + table.name;
  Statement stored(database, "SELECT row_count, crc32 FROM checksums WHERE table_name = ?");
  stored.bind_text(table.name);
  if (!stored.step()) throw StoreError("table checksums: has no row for table " + std::string(table.name));
  const Checksum found = checksum_of(database, table);
  if (found.row_count != stored.integer(0))
    throw StoreError(at + ": has " + std::to_string(found.row_count) + " rows, saved were " +
                     std::to_string(stored.integer(0)));
  if (found.crc != stored.integer(1))
    throw StoreError(at + ": its content does not match its checksum, it was damaged or edited");
}

}  // namespace

std::span<const Table> tables() {
  return kTables;
}

bool has_rowid(const Table& table, int version) {
  return *options_of(table, version) == '\0';
}

Checksum checksum_of(Database& database, const Table& table) {
  Checksum sum;
  Statement rows(database, std::string("SELECT * FROM ") + table.name + " ORDER BY " + table.order);
  for (; rows.step(); ++sum.row_count) sum.crc = crc32_of(rows.row_bytes(), sum.crc);
  return sum;
}

Database empty_map(int version) {
  Database database = Database::in_memory();
  database.execute("PRAGMA page_size = 4096; PRAGMA encoding = 'UTF-8'; PRAGMA secure_delete = ON");
  database.execute(("PRAGMA application_id = " + std::to_string(kMapApplicationId)).c_str());
  database.execute(("PRAGMA user_version = " + std::to_string(version)).c_str());
  database.execute("BEGIN");
  for (const Table& table : kTables)
    if (table.since <= version) database.execute(definition_of(table, version).c_str());
  database.execute(definition_of(kChecksums, version).c_str());
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
  for (const Table& table : kTables)
    if (table.since <= version) check_definition(database, table, version);
  check_definition(database, kChecksums, version);
}

void write_checksums(Database& database) {
  Statement insert(database, "INSERT INTO checksums VALUES (?, ?, ?)");
  for (const Table& table : kTables) {
    const Checksum sum = checksum_of(database, table);
    insert.bind_text(table.name).bind(sum.row_count).bind(std::int64_t{sum.crc}).run();
  }
}

void check_checksums(Database& database, int version) {
  for (const Table& table : kTables)
    if (table.since <= version) check_table(database, table);
}

}  // namespace cairn::store
