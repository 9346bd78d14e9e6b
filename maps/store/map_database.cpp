#include "maps/store/map_database.hpp"

#include "maps/store/file.hpp"
#include "maps/store/schema.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn::store {
namespace {

// check_header() has seen that it is one we know; asked again, because the file may have been replaced since.
int version_of(Database& database) {
  Statement version(database, "PRAGMA user_version");
  version.step();
  return static_cast<int>(version.integer_within(0, 1, kMapSchemaVersion));
}

}  // namespace

// Nothing is written that would not load again: what the tables refuse is a bug of the caller.
Database database_of(const SavedMap& map) {
  try {
    Database database = empty_map(map.submaps.empty() && !has_markers(map.graph) ? 1 : kMapSchemaVersion);
    write_content(database, map);
    write_checksums(database);
    database.execute("COMMIT");
    Reading check(database);
    static_cast<void>(read_content(check));
    return database;
  } catch (const StoreError& error) {
    throw std::invalid_argument("save_map: this map cannot be saved: " + std::string(error.what()));
  }
}

Database opened(const std::filesystem::path& file) {
  check_header(file);
  Database database = Database::read_only(file);
  database.execute("BEGIN");
  return database;
}

void check_pages(Database& database) {
  Statement check(database, "PRAGMA quick_check(1)");
  if (check.step() && check.text(0) != "ok") throw StoreError("is damaged: " + check.text(0));
}

Database checked(Database database) {
  const int version = version_of(database);
  check_schema(database, version);
  check_checksums(database, version);
  return database;  // version 2 has tables more, and reading does without them: no need to copy a large map
}

}  // namespace cairn::store
