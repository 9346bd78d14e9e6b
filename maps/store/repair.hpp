// What a damaged map still holds, and exactly what it has lost.
//
// Nothing is guessed: a row is taken over when all of its values are possible, and a tile or trajectory when its own
// checksum is right too.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/store/map_store.hpp"

namespace cairn {

struct MetreBox {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
};

struct StoreLoss {
  std::string table;
  std::string what;               // which row, and what is wrong with it
  std::optional<MetreBox> box{};  // of the map frame, when it is a part of the grid
};

// Of a file that begins as a saved map. Throws StoreError.
[[nodiscard]] int schema_version_of(const std::filesystem::path& file);

// The property in which a repaired map says which of its tables hold a value that is possible, but not the one that was
// saved.
inline constexpr const char* kUnprovenTables = "unproven_tables";

struct SalvagedMap {
  SavedMap map;
  int version = 0;                // schema version of the file
  std::vector<StoreLoss> losses;  // none: nothing is lost, though the file may not load as it is
};

// Reads past damaged rows, damaged pages and the end of a truncated file. Routes whose landmarks are lost are left
// out; clusters that are damaged are made anew. Throws StoreError when the file is not a saved map of a version that is
// known, or nothing of it can be read. Never writes.
[[nodiscard]] SalvagedMap salvage_map(const std::filesystem::path& file);

// Of a file that load_map() refuses: the map without its submaps, when nothing else of it is damaged; none otherwise.
// Throws as salvage_map() does.
[[nodiscard]] std::optional<SavedMap> map_without_damaged_submaps(const std::filesystem::path& file);

}  // namespace cairn
