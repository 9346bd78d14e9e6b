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
  store::Reading check(database);
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

void save_map(const std::filesystem::path& file, const SavedMap& map, Links links) {
  const std::string bytes = bytes_of(map);
  const auto save = [&] {
    if (!store::may_be_replaced(file, links))
      throw StoreError("is there already and is not a saved map: it is left as it is");
    store::replace_map(file, bytes, links);
  };
  store::in_file(file, save, "cannot be written");
}

namespace {

// One state of the file for all that is read of it.
Database opened(const std::filesystem::path& file) {
  store::check_header(file);
  Database database = Database::read_only(file);
  database.execute("BEGIN");
  return database;
}

// With the tables of this version.
Database checked(Database database) {
  const int version = version_of(database);
  store::check_schema(database, version);
  store::check_checksums(database, version);
  return store::migrated(std::move(database), version);
}

}  // namespace

SavedMap load_map(const std::filesystem::path& file) {
  return store::in_file(file, [&] {
    Database database = opened(file);
    check_pages(database);
    database = checked(std::move(database));
    store::Reading reading(database);
    return store::read_content(reading);
  });
}

struct MapFile::Opened {
  std::filesystem::path file;
  Database database;

  // Calls read(reading).
  template <typename Read>
  auto with_reading(Read read) {
    return store::in_file(file, [&] {
      store::Reading reading(database);
      return read(reading);
    });
  }
};

MapFile::MapFile(const std::filesystem::path& file)
    : opened_(store::in_file(file, [&] {
        return std::make_unique<Opened>(Opened{file, checked(opened(file))});
      })) {}
MapFile::MapFile(MapFile&&) noexcept = default;
MapFile& MapFile::operator=(MapFile&&) noexcept = default;
MapFile::~MapFile() = default;

OccupancyGrid MapFile::lattice() const {
  return opened_->with_reading(store::read_lattice);
}

SavedMap MapFile::without_cells() const {
  return opened_->with_reading(store::read_content_without_tiles);
}

OccupancyGrid MapFile::grid_within(const CellBox& box) const {
  return opened_->with_reading([&](store::Reading& reading) {
    OccupancyGrid grid = store::read_lattice(reading);
    const CellBox within = intersected(box, grid.bounds());
    store::read_tiles_within(reading, within, grid);
    return part_of(grid, within);
  });
}

}  // namespace cairn
