#include "maps/occupancy_grid.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

constexpr int kTableHalf = 32768;

// OL of every int16 log-odds value: 64 KiB, computed once.
const std::vector<std::uint8_t>& ol_table() {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> t(2 * kTableHalf);
    for (int i = 0; i < 2 * kTableHalf; ++i)
      t[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
          std::floor(255.0 / (1.0 + std::exp(-(i - kTableHalf) / kLogOddsPerNat))));
    return t;
  }();
  return table;
}

}  // namespace

double probability_of(LogOdds log_odds) { return 1.0 / (1.0 + std::exp(-log_odds / kLogOddsPerNat)); }

std::uint8_t ol_of(LogOdds log_odds) {
  static const std::uint8_t* const table = ol_table().data() + kTableHalf;
  return table[log_odds];
}

LogOdds log_odds_of(double probability) {
  constexpr double kLow = std::numeric_limits<LogOdds>::min();
  constexpr double kHigh = std::numeric_limits<LogOdds>::max();
  const double nat = std::log(probability) - std::log1p(-probability);
  return static_cast<LogOdds>(std::lround(std::clamp(nat * kLogOddsPerNat, kLow, kHigh)));
}

OccupancyGrid::OccupancyGrid(double cell_m, double clamp_nat, Point origin_m)
    : cell_m_(cell_m), clamp_(static_cast<int>(std::lround(clamp_nat * kLogOddsPerNat))), origin_m_(origin_m) {
  if (!(cell_m > 0.0) || !std::isfinite(cell_m))
    throw std::invalid_argument("OccupancyGrid: cell_m must be positive, got " + std::to_string(cell_m));
  if (!(clamp_nat > 0.0) || clamp_ > std::numeric_limits<LogOdds>::max())
    throw std::invalid_argument("OccupancyGrid: clamp_nat must be in (0, 127], got " + std::to_string(clamp_nat));
}

OccupancyGrid::OccupancyGrid(const OccupancyGrid& other)
    : cell_m_(other.cell_m_), clamp_(other.clamp_), origin_m_(other.origin_m_), bounds_(other.bounds_),
      tiles_box_(other.tiles_box_) {
  tiles_.reserve(other.tiles_.size());
  for (const auto& tile : other.tiles_) tiles_.push_back(tile ? std::make_unique<Tile>(*tile) : nullptr);
}

OccupancyGrid& OccupancyGrid::operator=(const OccupancyGrid& other) {
  if (this != &other) *this = OccupancyGrid(other);
  return *this;
}

Cell OccupancyGrid::cell_at(const Point& p_map) const {
  return {static_cast<int>(std::floor((p_map.x() - origin_m_.x()) / cell_m_)),
          static_cast<int>(std::floor((p_map.y() - origin_m_.y()) / cell_m_))};
}

Point OccupancyGrid::centre_of(Cell cell) const {
  return {origin_m_.x() + (cell.x + 0.5) * cell_m_, origin_m_.y() + (cell.y + 0.5) * cell_m_};
}

void OccupancyGrid::include(const CellBox& box) { bounds_ = united(bounds_, box); }

void OccupancyGrid::set_log_odds(Cell cell, LogOdds value) {
  tile_for_writing(cell)[offset_in_tile(cell)] =
      static_cast<LogOdds>(std::clamp(static_cast<int>(value), -clamp_, clamp_));
}

void OccupancyGrid::add_log_odds(Cell cell, int delta) {
  LogOdds& value = tile_for_writing(cell)[offset_in_tile(cell)];
  value = static_cast<LogOdds>(std::clamp(value + delta, -clamp_, clamp_));
}

OccupancyGrid::Tile& OccupancyGrid::tile_for_writing(Cell cell) {
  if (!bounds_.contains(cell)) include({cell, {cell.x + 1, cell.y + 1}});
  const Cell tile{tile_index(cell.x), tile_index(cell.y)};
  if (!tiles_box_.contains(tile)) grow_directory({tile, {tile.x + 1, tile.y + 1}});
  auto& slot = tiles_[static_cast<std::size_t>(tile.y - tiles_box_.min.y) *
                          static_cast<std::size_t>(tiles_box_.width()) +
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

void OccupancyGrid::copy_ol(const CellBox& box, std::span<std::uint8_t> out) const {
  std::size_t i = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) out[i++] = ol({x, y});
}

void OccupancyGrid::copy_log_odds(const CellBox& box, std::span<LogOdds> out) const {
  std::size_t i = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) out[i++] = log_odds({x, y});
}

bool OccupancyGrid::operator==(const OccupancyGrid& other) const {
  if (cell_m_ != other.cell_m_ || origin_m_ != other.origin_m_ || !(bounds_ == other.bounds_)) return false;
  for (int y = bounds_.min.y; y < bounds_.max.y; ++y)
    for (int x = bounds_.min.x; x < bounds_.max.x; ++x)
      if (log_odds({x, y}) != other.log_odds({x, y})) return false;
  return true;
}

double known_ratio(const OccupancyGrid& grid, const OccupancyThresholds& thresholds) {
  const CellBox box = grid.bounds();
  if (box.empty()) return 0.0;
  long known = 0;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}, thresholds) != CellState::unknown) ++known;
  return static_cast<double>(known) / (static_cast<double>(box.width()) * box.height());
}

}  // namespace cairn
