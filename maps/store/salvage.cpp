#include <algorithm>
#include <fstream>
#include <iterator>

#include "maps/hierarchy/hierarchy.hpp"
#include "maps/store/file.hpp"
#include "maps/store/schema.hpp"
#include "maps/store/tables/reading.hpp"
#include "maps/store/tables/tables.hpp"

namespace cairn {
namespace store {
namespace {

constexpr std::int64_t kMaxProbes = 500'000;

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw StoreError("cannot be read");
  return bytes;
}

std::string descending(std::string keys) {
  for (std::size_t at = keys.find(','); at != std::string::npos; at = keys.find(',', at + 6)) keys.insert(at, " DESC");
  return keys + " DESC";
}

// Copies every row that SQLite can still reach into tables whose pages are sound. A page that it cannot read hides
// those behind it: so each table is read from both ends, and what lies between is asked for key by key.
class Copying {
 public:
  Copying(Database& from, Database& to, std::vector<StoreLoss>& losses) : from_(from), to_(to), losses_(losses) {}

  void copy(const Table& table) {
    table_ = &table;
    unreadable_ = false;
    try {
      copy_readable();
    } catch (const StoreError& error) {
      lose(std::string("cannot be read: ") + error.what());
      unreadable_ = true;
    }
    compare_with_checksum();
  }

  // Names of tables with a value that is possible, but not the one that was saved.
  [[nodiscard]] const std::string& unproven() const { return unproven_; }

 private:
  [[nodiscard]] std::string select(const std::string& behind) const { return "SELECT * FROM " + table_->name + behind; }
  void lose(const std::string& what, const std::optional<MetreBox>& box = {}) {
    losses_.push_back({table_->name, what, box});
  }

  void copy_readable() {
    const std::string forwards = copy_in_order(table_->key);
    if (forwards.empty()) return;
    unreadable_ = true;
    static_cast<void>(copy_in_order(descending(table_->key)));
    // Past the index of the keys, which may be all that is damaged.
    if (table_->has_rowid() && copy_in_order("rowid").empty())
      return lose("the index of its keys was damaged, its rows are read without");
    if (table_->has_rowid()) static_cast<void>(copy_in_order("rowid DESC"));
    if (table_->name == "tiles")
      probe_tiles();
    else if (table_->definition.find("(" + table_->key + " INTEGER PRIMARY KEY") != std::string::npos)
      probe_numbers();
    else
      lose("a part of its rows cannot be read: " + forwards);
  }

  // What stopped it; empty at the end of the table.
  std::string copy_in_order(const std::string& order) {
    try {
      for (Statement row(from_, select(" ORDER BY " + order)); row.step();) take(row);
    } catch (const StoreError& error) {
      return error.what();
    }
    return {};
  }

  void take(const Statement& row) {
    std::string places = "?";
    for (int i = 1; i < row.columns(); ++i) places += ", ?";
    Statement(to_, "INSERT OR IGNORE INTO " + table_->name + " VALUES (" + places + ")").bind_row(row).run();
  }

  // Whether the row with these keys can be read, if there is one.
  bool probe(const std::string& where, std::initializer_list<std::int64_t> keys) {
    const auto with_keys = [&](Database& database) {
      Statement row(database, select(where));
      for (const std::int64_t value : keys) row.bind(value);
      return row;
    };
    if (with_keys(to_).step()) return true;
    try {
      Statement row = with_keys(from_);
      if (row.step()) take(row);
      return true;
    } catch (const StoreError&) {
      return false;
    }
  }

  void probe_numbers() {
    std::int64_t most = max_number();
    std::optional<std::int64_t> first_lost;
    const auto close = [&](std::int64_t last) {
      if (first_lost) lose("rows " + std::to_string(*first_lost) + " to " + std::to_string(last) + " cannot be read");
      first_lost.reset();
    };
    for (std::int64_t number = 0; number <= most; ++number) {
      if (probe(" WHERE " + table_->key + " = ?", {number}))
        close(number - 1);
      else if (!first_lost)
        first_lost = number;
    }
    close(most);
  }

  std::int64_t max_number() {
    std::int64_t most = 0;
    Statement copied(to_, "SELECT ifnull(max(" + table_->key + "), 0) FROM " + table_->name);
    if (copied.step()) most = copied.integer(0);
    // The last ones may be lost, and then their numbers are not known: about as many as there were.
    return std::min(std::max(most, 2 * rows_saved()), kMaxProbes);
  }

  // As its checksum says; 0 when that is lost, too.
  std::int64_t rows_saved() {
    try {
      Statement rows(from_, "SELECT row_count FROM checksums WHERE table_name = ?");
      rows.bind_text(table_->name);
      return rows.step() ? std::clamp<std::int64_t>(rows.integer(0), 0, kMaxProbes) : 0;
    } catch (const StoreError&) {
      return 0;
    }
  }

  void probe_tiles() {
    Statement grid(from_, "SELECT min_x, min_y, max_x, max_y, cell_m, origin_x_m, origin_y_m FROM grid");
    if (!grid.step()) return lose("a part of its rows cannot be read");
    const auto index = [&](int column) {
      return grid.integer_within(column, -OccupancyGrid::kLargestCellIndex, OccupancyGrid::kLargestCellIndex);
    };
    const std::int64_t x_begin = index(0) >> 6, y_begin = index(1) >> 6;
    const std::int64_t x_end = (index(2) + 63) >> 6, y_end = (index(3) + 63) >> 6;
    if ((x_end - x_begin) * (y_end - y_begin) > kMaxProbes) return lose("a part of its rows cannot be read");
    const TileMetres tiles{{grid.real(5), grid.real(6)}, OccupancyGrid::kTileSide * grid.real(4)};
    for (std::int64_t y = y_begin; y < y_end; ++y)
      for (std::int64_t x = x_begin; x < x_end; ++x) {
        std::int64_t lost = x;
        while (lost < x_end && !probe(" WHERE level = 0 AND ty = ? AND tx = ?", {y, lost})) ++lost;
        if (lost == x) continue;
        const auto tile = [&](std::int64_t at) { return Cell{static_cast<int>(at), static_cast<int>(y)}; };
        lose("row " + std::to_string(y) + " from tile " + std::to_string(x) + " to " + std::to_string(lost - 1) +
                 " cannot be read",
             MetreBox{tiles.box_of(tile(x)).min_m, tiles.box_of(tile(lost - 1)).max_m});
        x = lost;
      }
  }

  void compare_with_checksum() {
    try {
      Statement stored(from_, "SELECT row_count, crc32 FROM checksums WHERE table_name = ?");
      stored.bind_text(table_->name);
      if (!stored.step()) {
        note_unproven();
        return lose("has no checksum: what is missing in it cannot be said");
      }
      const Checksum found = checksum_of(to_, *table_);
      if (found.row_count != stored.integer(0))
        return lose(std::to_string(found.row_count) + " of its " + std::to_string(stored.integer(0)) +
                    " rows can be read");
      if (found.crc != stored.integer(1) && !unreadable_) {
        lose("its content does not match its checksum: some value in it was damaged or edited; kept, but not proven");
        note_unproven();
      }
    } catch (const StoreError& error) {
      note_unproven();
      lose(std::string("its checksum cannot be read: ") + error.what());
    }
  }
  // Of nothing there is nothing to prove.
  void note_unproven() {
    if (checksum_of(to_, *table_).row_count > 0) unproven_ += (unproven_.empty() ? "" : ", ") + table_->name;
  }

  Database& from_;
  Database& to_;
  std::vector<StoreLoss>& losses_;
  const Table* table_ = nullptr;
  bool unreadable_ = false;
  std::string unproven_;
};

// Where the definitions of the tables are damaged, SQLite cannot read anything: then those of any other map take
// their place.
Database opened(const std::string& bytes, int version) {
  try {
    Database database = Database::of_bytes(as_far_as_it_goes(bytes, nullptr));
    check_schema(database, version);
    return database;
  } catch (const StoreError&) {
    const EmptyMapFile definitions = empty_map_file(version);
    return Database::of_bytes(as_far_as_it_goes(bytes, &definitions));
  }
}

bool concerns_clusters(const StoreLoss& loss) {
  return loss.table == "clusters" || loss.table == "landmark_clusters";
}

bool defines_tables_of(const std::string& bytes, int version) {
  try {
    Database database = Database::of_bytes(as_far_as_it_goes(bytes, nullptr));
    check_schema(database, version);
    return true;
  } catch (const StoreError&) {
    return false;
  }
}

SalvagedMap salvaged_from(Database& damaged, int version) {
  SalvagedMap salvaged;
  salvaged.version = version;
  Database sound = empty_map(version);
  Copying copying(damaged, sound, salvaged.losses);
  for (const Table& table : tables_of(sound)) copying.copy(table);
  sound.execute("COMMIT");
  sound = migrated(std::move(sound), version);
  const bool missed_clusters = std::ranges::any_of(salvaged.losses, concerns_clusters);
  std::vector<StoreLoss> wrong;
  Reading reading(sound, &wrong);
  salvaged.map = read_content(reading);
  salvaged.losses.insert(salvaged.losses.end(), wrong.begin(), wrong.end());
  if (!copying.unproven().empty()) salvaged.map.properties[kUnprovenTables] = copying.unproven();
  // What fits the landmarks as it is was not touched.
  if (std::ranges::any_of(wrong, concerns_clusters) ||
      (missed_clusters && salvaged.map.clusters.cluster_of.empty() && !salvaged.map.graph.landmarks().empty())) {
    const ClusterId next_id = salvaged.map.clusters.next_id;
    const ClusterSizes sizes;
    salvaged.map.clusters = cluster_landmarks(
        salvaged.map.graph, {}, {sizes, passages_in(salvaged.map.grid, salvaged.map.graph, sizes.narrow_below_m)});
    salvaged.map.clusters.next_id = std::max(next_id, salvaged.map.clusters.next_id);
    if (!salvaged.map.clusters.clusters.empty())
      salvaged.losses.push_back({"clusters", "were made anew: their names and ids are lost"});
  }
  return salvaged;
}

bool holds_nothing(const SavedMap& map) {
  return map.properties.empty() && map.grid.bounds().empty() && map.graph.landmarks().empty() &&
         map.driven_path.empty();
}

// All headers of a version are alike but for the number of pages: the one of another map takes its place. Which version
// it was, the content says.
std::optional<SalvagedMap> salvaged_past_header(const std::string& bytes) {
  std::optional<SalvagedMap> best;
  for (int version = kMapSchemaVersion; version >= 1 && bytes.size() > kHeaderBytes; --version) {
    std::string mended = bytes;
    mended.replace(0, kHeaderBytes, empty_map_file(version).bytes, 0, kHeaderBytes);
    try {
      Database damaged = opened(mended, version);
      SalvagedMap salvaged = salvaged_from(damaged, version);
      if (!holds_nothing(salvaged.map) && (!best || salvaged.losses.size() < best->losses.size()))
        best = std::move(salvaged);
      // An older version has fewer tables to lose something of.
      if (best && defines_tables_of(mended, version)) break;
    } catch (const StoreError&) {
      // Not this version.
    }
  }
  if (best) best->losses.insert(best->losses.begin(), {"header of the file", "was damaged, and is made anew"});
  return best;
}

}  // namespace
}  // namespace store

int schema_version_of(const std::filesystem::path& file) {
  return store::in_file(file, [&] { return store::check_kind(file); });
}

SalvagedMap salvage_map(const std::filesystem::path& file) {
  using namespace store;
  return in_file(file, [&] {
    const std::string bytes = std::filesystem::is_regular_file(file) ? content_of(file) : std::string();
    if (!names_its_program(bytes))
      if (auto salvaged = salvaged_past_header(bytes)) return *std::move(salvaged);
    const int version = check_kind(file);
    Database damaged = opened(bytes, version);
    SalvagedMap salvaged = salvaged_from(damaged, version);
    if (!salvaged.losses.empty() && holds_nothing(salvaged.map))
      throw StoreError("nothing of it can be read: " + salvaged.losses.front().what);
    return salvaged;
  });
}

std::optional<SavedMap> map_without_damaged_submaps(const std::filesystem::path& file) {
  SalvagedMap salvaged = salvage_map(file);
  const auto is_of_submaps = [](const StoreLoss& loss) { return loss.table.starts_with("submap"); };
  if (salvaged.losses.empty() || !std::ranges::all_of(salvaged.losses, is_of_submaps)) return std::nullopt;
  salvaged.map.properties.erase(kUnprovenTables);
  salvaged.map.submaps = {};
  return std::move(salvaged.map);
}

}  // namespace cairn
