#include "maps/store/map_store.hpp"

#include "maps/store/file.hpp"
#include "maps/store/reading.hpp"
#include "maps/store/schema.hpp"
#include "maps/store/tables.hpp"

namespace cairn {
namespace {

using store::Database;

// The database is made in memory and becomes a file in one step. A transaction in the file itself
// would be as safe, but its pages would then depend on what the file held before; made anew, the same
// map gives the same bytes, and no journal lies beside a map after a kill.
// Nothing is written that would not load again: what the tables refuse is a bug of the caller.
Database database_of(const SavedMap& map) {
  Database database = store::empty_map(kMapSchemaVersion);
  store::write_content(database, map);
  store::write_checksums(database);
  database.execute("COMMIT");
  store::Reading check(database, kMapSchemaVersion);
  static_cast<void>(store::read_content(check));
  return database;
}

std::string bytes_of(const SavedMap& map) {
  try {
    return database_of(map).serialized();
  } catch (const StoreError& error) {
    throw std::invalid_argument("save_map: this map cannot be saved: " + std::string(error.what()));
  }
}

void check_pages(Database& database) {
  store::Statement check(database, "PRAGMA quick_check(1)");
  if (check.step() && check.text(0) != "ok") throw StoreError("is damaged: " + check.text(0));
}

// check_header() has seen that it is one we know; asked again, because the file may have been replaced since.
int version_of(Database& database) {
  store::Statement version(database, "PRAGMA user_version");
  version.step();
  return static_cast<int>(version.integer_within(0, 1, kMapSchemaVersion));
}

}  // namespace

void save_map(const std::filesystem::path& file, const SavedMap& map) {
  const std::string bytes = bytes_of(map);
  try {
    if (!store::may_be_replaced(file)) throw StoreError("is there already and is no saved map: it is left as it is");
    store::replace_file(file, bytes);
  } catch (const StoreError& error) {
    throw StoreError(file.string() + ": " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw StoreError(file.string() + ": cannot be written: " + error.code().message());
  }
}

namespace {

// Puts the file in front of what is wrong.
template <typename Read>
auto in_file(const std::filesystem::path& file, Read read) {
  try {
    return read();
  } catch (const StoreError& error) {
    throw StoreError(file.string() + ": " + error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw StoreError(file.string() + ": cannot be read: " + error.code().message());
  }
}

Database opened(const std::filesystem::path& file) {
  store::check_header(file);
  Database database = Database::read_only(file);
  database.execute("BEGIN");  // one state of the file for all that follows
  return database;
}

}  // namespace

SavedMap load_map(const std::filesystem::path& file) {
  return in_file(file, [&] {
    Database database = opened(file);
    check_pages(database);
    const int version = version_of(database);
    store::check_schema(database, version);
    store::check_checksums(database, version);
    store::Reading reading(database, version);
    return store::read_content(reading);
  });
}

struct MapFile::Opened {
  std::filesystem::path file;
  Database database;
  int version = 0;
};

MapFile::MapFile(const std::filesystem::path& file) {
  opened_ = in_file(file, [&] {
    auto opened_file = std::make_unique<Opened>(Opened{file, opened(file), 0});
    opened_file->version = version_of(opened_file->database);
    store::check_schema(opened_file->database, opened_file->version);
    store::check_checksums(opened_file->database, opened_file->version);
    return opened_file;
  });
}
MapFile::MapFile(MapFile&&) noexcept = default;
MapFile& MapFile::operator=(MapFile&&) noexcept = default;
MapFile::~MapFile() = default;

OccupancyGrid MapFile::lattice() const {
  return in_file(opened_->file, [&] {
    store::Reading reading(opened_->database, opened_->version);
    return store::read_lattice(reading);
  });
}

SavedMap MapFile::without_cells() const {
  return in_file(opened_->file, [&] {
    store::Reading reading(opened_->database, opened_->version);
    return store::read_content_without_tiles(reading);
  });
}

OccupancyGrid MapFile::grid_within(const CellBox& box) const {
  return in_file(opened_->file, [&] {
    store::Reading reading(opened_->database, opened_->version);
    OccupancyGrid grid = store::read_lattice(reading);
    const CellBox within = intersected(box, grid.bounds());
    store::read_tiles_within(reading, within, grid);
    return part_of(grid, within);
  });
}

}  // namespace cairn
