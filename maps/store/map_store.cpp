#include "maps/store/map_store.hpp"

#include "maps/store/file.hpp"
#include "maps/store/map_database.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn {

void save_map(const std::filesystem::path& file, const SavedMap& map, Links links) {
  // The database is made in memory and becomes a file in one step. A transaction in the file itself would be as safe,
  // but its pages would then depend on what the file held before; made anew, the same map gives the same bytes.
  const std::string bytes = store::database_of(map).serialized();
  const auto save = [&] {
    store::require_replaceable(file, links);
    store::replace_map(file, bytes, links);
  };
  store::in_file(file, save, "cannot be written");
}

SavedMap load_map(const std::filesystem::path& file) {
  return store::in_file(file, [&] {
    store::Database database = store::opened(file);
    store::check_pages(database);
    database = store::checked(std::move(database));
    store::Reading reading(database);
    return store::read_content(reading);
  });
}

struct MapFile::Opened {
  std::filesystem::path file;
  store::Database database;

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
        return std::make_unique<Opened>(Opened{file, store::checked(store::opened(file))});
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
