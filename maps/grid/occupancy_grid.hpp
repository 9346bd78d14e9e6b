// OG1: the first level occupancy grid (docs/method.md 2; paper section 2.2).
//
// Promises: a cell's index never changes, the grid grows in all four directions without moving
// what it holds (64 x 64 tiles behind a directory), and every read outside it answers "unknown".
// Each cell keeps log-odds L in 1/256 nat; what everybody else reads is the linearised prevision
// OL = floor(255 P), P = 1 / (1 + e^-L), so 127 means equiprobable.
// Copyable (deep). Reads are thread-safe among themselves.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/cell.hpp"

namespace cairn {

using LogOdds = std::int16_t;  // 1/256 nat
inline constexpr double kLogOddsPerNat = 256.0;
inline constexpr std::uint8_t kUnknownOl = 127;

[[nodiscard]] double probability_of(LogOdds log_odds);
[[nodiscard]] std::uint8_t ol_of(LogOdds log_odds);
[[nodiscard]] LogOdds log_odds_of(double probability);  // clamped to the int16 range; NaN and outside [0, 1] throw

enum class CellState : std::uint8_t { free, unknown, occupied };

// Which log-odds count as free and as occupied; what lies between is unknown.
struct OccupancyThresholds {
  LogOdds free_below = -158;     // P < 0.35
  LogOdds occupied_above = 158;  // P > 0.65

  [[nodiscard]] static OccupancyThresholds of(double free_below_p, double occupied_above_p) {
    return {log_odds_of(free_below_p), log_odds_of(occupied_above_p)};
  }
  [[nodiscard]] constexpr CellState state(LogOdds log_odds) const {
    if (log_odds > occupied_above) return CellState::occupied;
    return log_odds < free_below ? CellState::free : CellState::unknown;
  }
};

// The cell of a lattice that holds a point, each cell with its lower and left edge. Points beyond
// +-2^30 cells, and those that are not finite, end at that rim.
[[nodiscard]] Cell cell_on_lattice(const Point& p_map, const Point& origin_m, double cell_m);

class OccupancyGrid {
 public:
  static constexpr int kLargestCellIndex = 1 << 17;  // 6.5 km at 0.05 m: beyond it something else is wrong
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 28;  // of bounds()
  static constexpr int kTileSide = 64;

  // origin_m: lower left corner of cell (0, 0) in the map frame. clamp_nat bounds |L|. Throws
  // std::invalid_argument unless cell_m > 0, 1/256 <= clamp_nat <= 127 and the origin is finite.
  explicit OccupancyGrid(double cell_m, double clamp_nat = 4.0, const Point& origin_m = {0.0, 0.0});
  OccupancyGrid(const OccupancyGrid& other);
  OccupancyGrid& operator=(const OccupancyGrid& other);
  OccupancyGrid(OccupancyGrid&&) noexcept = default;
  OccupancyGrid& operator=(OccupancyGrid&&) noexcept = default;
  ~OccupancyGrid() = default;

  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] double clamp_nat() const { return clamp_ / kLogOddsPerNat; }
  [[nodiscard]] Point origin_m() const { return origin_m_; }
  [[nodiscard]] Cell cell_at(const Point& p_map) const;
  [[nodiscard]] Point centre_of(Cell cell) const;

  // The box of cells that were ever written or asked for by include().
  [[nodiscard]] CellBox bounds() const { return bounds_; }
  void include(const CellBox& box);
  // Whether the disc lies where the grid can still grow to; false for what is not finite.
  [[nodiscard]] bool can_include(const Point& p_map, double around_m) const;

  [[nodiscard]] LogOdds log_odds(Cell cell) const {
    const Tile* tile = tile_of(cell);
    return tile == nullptr ? LogOdds{0} : (*tile)[offset_in_tile(cell)];
  }
  [[nodiscard]] std::uint8_t ol(Cell cell) const { return ol_of(log_odds(cell)); }
  [[nodiscard]] CellState state(Cell cell, const OccupancyThresholds& thresholds = {}) const {
    return thresholds.state(log_odds(cell));
  }

  // Both grow the grid where needed and clamp to +-clamp_nat. Throw std::length_error beyond +-2^17 cells.
  void set_log_odds(Cell cell, LogOdds value);
  // add_log_odds says whether the value changed.
  bool add_log_odds(Cell cell, int delta);

  // The stored cells of a tile, row-major, for the inner loops of maps: null where nothing was ever
  // written. What is written must keep to the clamp, and be announced to include().
  [[nodiscard]] const LogOdds* cells_of_tile(Cell tile) const {
    const Tile* found = tile_of({tile.x * kTileSide, tile.y * kTileSide});
    return found == nullptr ? nullptr : found->data();
  }
  [[nodiscard]] LogOdds* cells_of_tile_for_writing(Cell tile);
  // Memory held by tiles and their directory.
  [[nodiscard]] std::size_t bytes() const;
  [[nodiscard]] int clamp_quanta() const { return clamp_; }

  // Row-major copies of a box, row box.min.y first; out.size() == width * height.
  void copy_ol(const CellBox& box, std::span<std::uint8_t> out) const;
  void copy_log_odds(const CellBox& box, std::span<LogOdds> out) const;

  // Same cell size, origin, bounds and values.
  bool operator==(const OccupancyGrid& other) const;

 private:
  using Tile = std::array<LogOdds, kTileSide * kTileSide>;

  static constexpr int tile_index(int cell) { return cell >> 6; }
  static constexpr std::size_t offset_in_tile(Cell c) {
    return static_cast<std::size_t>(((c.y & 63) << 6) | (c.x & 63));
  }
  [[nodiscard]] const Tile* tile_of(Cell cell) const {
    const int tx = tile_index(cell.x) - tiles_box_.min.x;
    const int ty = tile_index(cell.y) - tiles_box_.min.y;
    if (tx < 0 || ty < 0 || tx >= tiles_box_.width() || ty >= tiles_box_.height()) return nullptr;
    return tiles_[static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_box_.width()) +
                  static_cast<std::size_t>(tx)]
        .get();
  }
  Tile& tile_for_writing(Cell cell);
  Tile& tile_at(Cell tile);
  void grow_directory(const CellBox& tiles);

  double cell_m_;
  int clamp_;
  Point origin_m_;
  CellBox bounds_;
  CellBox tiles_box_;
  std::vector<std::unique_ptr<Tile>> tiles_;  // row-major over tiles_box_; null = all unknown
};

// What the grid holds inside a box, with that box (as far as it is in bounds()) for its bounds.
[[nodiscard]] OccupancyGrid part_of(const OccupancyGrid& grid, const CellBox& box);

// Share of known cells in the smallest box that holds every occupied cell: readings without an echo
// reach out of a room through its doors and would count against it. All of bounds() as long as no cell
// is occupied; 0 for an empty grid.
[[nodiscard]] double known_ratio(const OccupancyGrid& grid, const OccupancyThresholds& thresholds = {});

}  // namespace cairn
