// A saved map that is saved again and again while it grows: only what has changed is written.
//
// The file is a saved map as save_map() leaves it, whole at any moment and with no journal beside it: after a kill, a
// power cut or a full disk it holds the last map for which save() has returned. Two files are taken in turn. The one
// before, ".NAME.earlier", is changed into the next one by SQLite, row by row; then the two exchange their names. The
// content is that of save_map(), its bytes are not: they depend on what the file held before.
#pragma once

#include <cstdint>
#include <filesystem>

#include "maps/store/map_store.hpp"

namespace cairn {

class MapUpdater {
 public:
  // A link at that name is replaced.
  explicit MapUpdater(std::filesystem::path file);
  MapUpdater(const MapUpdater&) = delete;
  MapUpdater& operator=(const MapUpdater&) = delete;
  ~MapUpdater();

  // Throws as save_map() does; then the file holds what it held.
  void save(const SavedMap& map);
  // The file before is removed; the next save() writes the whole map.
  void drop_earlier() noexcept;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  // Of all files so far: pages that have changed, and whole maps.
  [[nodiscard]] std::uint64_t bytes_written() const { return bytes_written_; }

 private:
  const std::filesystem::path file_;
  const std::filesystem::path earlier_;
  bool file_is_ours_ = false;  // made by this object
  bool has_earlier_ = false;   // and the one before
  std::uint64_t bytes_written_ = 0;
};

}  // namespace cairn
