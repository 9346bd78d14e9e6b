#include "maps/grid/occupancy_grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace cairn {
namespace {

constexpr int kTableHalf = 32768;
constexpr double kLatticeRim = 1 << 30;  // keeps sums of cell indices inside an int

// OL of every int16 log-odds value: 64 KiB, computed once.
const std::vector<std::uint8_t>& ol_table() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> t(2 * kTableHalf);
    for (int i = 0; i < 2 * kTableHalf; ++i)
      t[static_cast<std::size_t>(i)] =
          static_cast<std::uint8_t>(std::floor(255.0 / (1.0 + std::exp(-(i - kTableHalf) / kLogOddsPerNat))));
    return t;
  }();
  return table;
}

int saturated_floor(double cells) {
  if (!(cells > -kLatticeRim)) return -static_cast<int>(kLatticeRim);  // NaN too
  return static_cast<int>(std::floor(std::min(cells, kLatticeRim)));
}

int checked_clamp(double clamp_nat) {
  constexpr double kMin = 1.0 / kLogOddsPerNat;
  if (!(clamp_nat >= kMin && clamp_nat <= 127.0))
    throw std::invalid_argument(fmt::format("OccupancyGrid: clamp_nat must be in [1/256, 127], got {:f}", clamp_nat));
  return static_cast<int>(std::lround(clamp_nat * kLogOddsPerNat));
}

// Calls visit(first_cell, run_length) for the pieces of each row of a box that lie in one tile column.
template <class Visit>
void for_each_run(const CellBox& box, const Visit& visit) {
  constexpr int kSide = OccupancyGrid::kTileSide;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x;) {
      const int run = std::min(box.max.x, (x & ~(kSide - 1)) + kSide) - x;
      visit(Cell{x, y}, run);
      x += run;
    }
}

bool is_allowed(const CellBox& box) {
  constexpr int kMax = OccupancyGrid::kLargestCellIndex;
  constexpr CellBox kAllowed{{-kMax, -kMax}, {kMax, kMax}};
  return intersected(kAllowed, box) == box && std::int64_t{box.width()} * box.height() <= OccupancyGrid::kMaxCells;
}

}  // namespace

double probability_of(LogOdds log_odds) {
  return 1.0 / (1.0 + std::exp(-log_odds / kLogOddsPerNat));
}

std::uint8_t ol_of(LogOdds log_odds) {
  static const std::uint8_t* const table = ol_table().data() + kTableHalf;
  return table[log_odds];
}

LogOdds log_odds_of(double probability) {
  constexpr double kLow = std::numeric_limits<LogOdds>::min();
  constexpr double kHigh = std::numeric_limits<LogOdds>::max();
  if (!(probability >= 0.0 && probability <= 1.0))
    throw std::invalid_argument(fmt::format("log_odds_of: a probability is in [0, 1], got {:f}", probability));
  const double nat = std::log(probability) - std::log1p(-probability);
  return static_cast<LogOdds>(std::lround(std::clamp(nat * kLogOddsPerNat, kLow, kHigh)));
}

Cell cell_on_lattice(const Point& p_map, const Point& origin_m, double cell_m) {
  return {saturated_floor((p_map.x() - origin_m.x()) / cell_m), saturated_floor((p_map.y() - origin_m.y()) / cell_m)};
}

OccupancyGrid::OccupancyGrid(double cell_m, double clamp_nat, const Point& origin_m)
    : cell_m_(cell_m), clamp_(checked_clamp(clamp_nat)), origin_m_(origin_m) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m))
    throw std::invalid_argument(fmt::format("OccupancyGrid: cell_m must be positive, got {:f}", cell_m));
  if (!origin_m.allFinite()) throw std::invalid_argument("OccupancyGrid: origin_m must be finite");
}

OccupancyGrid::OccupancyGrid(const OccupancyGrid& other)
    : cell_m_(other.cell_m_),
      clamp_(other.clamp_),
      origin_m_(other.origin_m_),
      bounds_(other.bounds_),
      tiles_box_(other.tiles_box_) {
  tiles_.reserve(other.tiles_.size());
  for (const auto& tile : other.tiles_) tiles_.push_back(tile ? std::make_unique<Tile>(*tile) : nullptr);
}

OccupancyGrid& OccupancyGrid::operator=(const OccupancyGrid& other) {
  if (this != &other) *this = OccupancyGrid(other);
  return *this;
}

Cell OccupancyGrid::cell_at(const Point& p_map) const {
  return cell_on_lattice(p_map, origin_m_, cell_m_);
}

Point OccupancyGrid::centre_of(Cell cell) const {
  return {origin_m_.x() + (cell.x + 0.5) * cell_m_, origin_m_.y() + (cell.y + 0.5) * cell_m_};
}

void OccupancyGrid::include(const CellBox& box) {
  if (box.empty() || intersected(bounds_, box) == box) return;
  const CellBox all = united(bounds_, box);
  if (!is_allowed(all))
    throw std::length_error(fmt::format(
        "OccupancyGrid: the cells ({}, {}) to ({}, {}) are too many, at most {} are possible, with indices up to {}",
        all.min.x, all.min.y, all.max.x, all.max.y, kMaxCells, kLargestCellIndex));
  bounds_ = all;
}

bool OccupancyGrid::can_include(const Point& p_map, double around_m) const {
  const Point around{around_m, around_m};
  // Cells saturate far beyond what is allowed, so no overflow can pass for a small box.
  return p_map.allFinite() && std::isfinite(around_m) &&
         is_allowed(united(bounds_, {cell_at(p_map - around), cell_at(p_map + around) + Cell{2, 2}}));
}

void OccupancyGrid::set_log_odds(Cell cell, LogOdds value) {
  tile_for_writing(cell)[offset_in_tile(cell)] =
      static_cast<LogOdds>(std::clamp(static_cast<int>(value), -clamp_, clamp_));
}

bool OccupancyGrid::add_log_odds(Cell cell, int delta) {
  LogOdds& value = tile_for_writing(cell)[offset_in_tile(cell)];
  const LogOdds before = value;
  // Twice the clamp reaches from one end to the other, so more than that cannot matter.
  value = static_cast<LogOdds>(std::clamp(value + std::clamp(delta, -2 * clamp_, 2 * clamp_), -clamp_, clamp_));
  return value != before;
}

OccupancyGrid::Tile& OccupancyGrid::tile_for_writing(Cell cell) {
  if (!bounds_.contains(cell)) include({cell, {cell.x + 1, cell.y + 1}});
  return tile_at({tile_index(cell.x), tile_index(cell.y)});
}

OccupancyGrid::Tile& OccupancyGrid::tile_at(Cell tile) {
  if (!tiles_box_.contains(tile)) grow_directory({tile, {tile.x + 1, tile.y + 1}});
  auto& slot =
      tiles_[static_cast<std::size_t>(tile.y - tiles_box_.min.y) * static_cast<std::size_t>(tiles_box_.width()) +
             static_cast<std::size_t>(tile.x - tiles_box_.min.x)];
  if (!slot) {
    slot = std::make_unique<Tile>();
    slot->fill(0);
  }
  return *slot;
}

void OccupancyGrid::grow_directory(const CellBox& tiles) {
  const CellBox box = united(tiles_box_, tiles);
  std::vector<std::unique_ptr<Tile>> grown(static_cast<std::size_t>(box.width()) *
                                           static_cast<std::size_t>(box.height()));
  std::size_t from = 0;
  for (int y = tiles_box_.min.y; y < tiles_box_.max.y; ++y)
    for (int x = tiles_box_.min.x; x < tiles_box_.max.x; ++x)
      grown[static_cast<std::size_t>(y - box.min.y) * static_cast<std::size_t>(box.width()) +
            static_cast<std::size_t>(x - box.min.x)] = std::move(tiles_[from++]);
  tiles_ = std::move(grown);
  tiles_box_ = box;
}

LogOdds* OccupancyGrid::cells_of_tile_for_writing(Cell tile) {
  return tile_at(tile).data();
}

std::size_t OccupancyGrid::bytes() const {
  std::size_t sum = tiles_.capacity() * sizeof(tiles_[0]);
  for (const auto& tile : tiles_) sum += tile ? sizeof(Tile) : 0;
  return sum;
}

void OccupancyGrid::copy_ol(const CellBox& box, std::span<std::uint8_t> out) const {
  const std::uint8_t* const table = ol_table().data() + kTableHalf;
  auto to = out.begin();
  for_each_run(box, [&](Cell first, int run) {
    const Tile* const tile = tile_of(first);
    if (tile == nullptr) {
      to = std::fill_n(to, run, kUnknownOl);
    } else {
      const LogOdds* const from = tile->data() + offset_in_tile(first);
      to = std::transform(from, from + run, to, [table](LogOdds log_odds) { return table[log_odds]; });
    }
  });
}

void OccupancyGrid::copy_log_odds(const CellBox& box, std::span<LogOdds> out) const {
  auto to = out.begin();
  for_each_run(box, [&](Cell first, int run) {
    const Tile* const tile = tile_of(first);
    to =
        tile == nullptr ? std::fill_n(to, run, LogOdds{0}) : std::copy_n(tile->data() + offset_in_tile(first), run, to);
  });
}

bool OccupancyGrid::operator==(const OccupancyGrid& other) const {
  if (cell_m_ != other.cell_m_ || origin_m_ != other.origin_m_ || !(bounds_ == other.bounds_)) return false;
  for (int y = bounds_.min.y; y < bounds_.max.y; ++y)
    for (int x = bounds_.min.x; x < bounds_.max.x; ++x)
      if (log_odds({x, y}) != other.log_odds({x, y})) return false;
  return true;
}

OccupancyGrid part_of(const OccupancyGrid& grid, const CellBox& box) {
  constexpr int kSide = OccupancyGrid::kTileSide;
  OccupancyGrid part(grid.cell_m(), grid.clamp_nat(), grid.origin_m());
  const CellBox within = intersected(box, grid.bounds());
  part.include(within);
  for (int ty = within.min.y >> 6; ty <= (within.max.y - 1) >> 6; ++ty)
    for (int tx = within.min.x >> 6; tx <= (within.max.x - 1) >> 6; ++tx) {
      const LogOdds* const from = grid.cells_of_tile({tx, ty});
      if (from == nullptr) continue;
      LogOdds* const to = part.cells_of_tile_for_writing({tx, ty});
      const CellBox cells = intersected({{tx * kSide, ty * kSide}, {(tx + 1) * kSide, (ty + 1) * kSide}}, within);
      for (int y = cells.min.y; y < cells.max.y; ++y) {
        const auto row = static_cast<std::size_t>((y - ty * kSide) * kSide + cells.min.x - tx * kSide);
        std::copy_n(from + row, cells.width(), to + row);
      }
    }
  return part;
}

double known_ratio(const OccupancyGrid& grid, const OccupancyThresholds& thresholds) {
  CellBox walls;
  const CellBox all = grid.bounds();
  for (int y = all.min.y; y < all.max.y; ++y)
    for (int x = all.min.x; x < all.max.x; ++x)
      if (grid.state({x, y}, thresholds) == CellState::occupied) walls = united(walls, {{x, y}, {x + 1, y + 1}});
  const CellBox box = walls.empty() ? all : walls;
  if (box.empty()) return 0.0;
  long known = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}, thresholds) != CellState::unknown) ++known;
  return static_cast<double>(known) / (static_cast<double>(box.width()) * box.height());
}

}  // namespace cairn
