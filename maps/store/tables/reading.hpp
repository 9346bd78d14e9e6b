// How the tables of a saved map are read: strictly, where the first row that is wrong ends it all, or to save what
// can be saved, where it is left out and noted.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "maps/store/repair.hpp"
#include "maps/store/sqlite.hpp"

namespace cairn::store {

inline constexpr std::int64_t kMaxLevel = 1'000'000;
inline constexpr std::int64_t kMaxInt = std::numeric_limits<int>::max();
inline constexpr std::int64_t kMaxId = (std::int64_t{1} << 53) - 1;  // what JSON and doubles hold exactly

inline std::string numbered(const char* kind, std::int64_t id) {
  return std::string(kind) + " " + std::to_string(id);
}

struct TileMetres {
  Point origin_m{0.0, 0.0};
  double side_m = 0.0;
  [[nodiscard]] MetreBox box_of(Cell tile) const {
    const Point low = origin_m + side_m * Point(tile.x, tile.y);
    return {low, low + Point(side_m, side_m)};
  }
};

class Reading {
 public:
  // losses: null to read strictly.
  explicit Reading(Database& from, std::vector<StoreLoss>* losses = nullptr) : database(from), losses_(losses) {}

  // Runs a reader and puts the table in front of whatever it, the graph or a contour objects to.
  template <typename Read>
  void in_table(const std::string& table, Read read) {
    try {
      read();
    } catch (const StoreError& error) {
      object(table, error.what());
    } catch (const std::invalid_argument& error) {
      object(table, error.what());
    }
  }

  // Calls read(row) for each row.
  template <typename Read>
  void rows(const std::string& table, const std::string& select, Read read) {
    in_table(table, [&] {
      for (Statement row(database, select); row.step();) {
        if (losses_ == nullptr) {
          read(row);
          continue;
        }
        label_ = row.first_text();
        in_table(table, [&] { read(row); });
        label_.clear();
        lost_box_.reset();
      }
    });
  }

  // Which tile the row that is being read is about.
  void at_tile(Cell tile) {
    if (tile_m.side_m > 0.0) lost_box_ = tile_m.box_of(tile);
  }

  Database& database;
  TileMetres tile_m;  // side 0: the grid's row is lost

 private:
  void object(const std::string& table, const std::string& what) const {
    if (losses_ == nullptr) throw StoreError("table " + table + ": " + what);
    losses_->push_back({table, label_.empty() ? what : "row " + label_ + ": " + what, lost_box_});
  }

  std::vector<StoreLoss>* losses_;
  std::string label_;  // of the row that is being read
  std::optional<MetreBox> lost_box_;
};

}  // namespace cairn::store
