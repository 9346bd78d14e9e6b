#include "framework/reporting/grid_history.hpp"

#include <map>
#include <string_view>

#include "maps/base/deflate.hpp"

namespace cairn {
namespace {

using OlOfTiles = std::map<Cell, std::string>;

void add_tiles(OlOfTiles& tiles, const GridMoment& moment) {
  const std::string ol = inflated(moment.packed_ol, moment.tiles.size() * GridTile::kCells);
  for (std::size_t i = 0; i < moment.tiles.size(); ++i)
    tiles[moment.tiles[i]] = ol.substr(i * GridTile::kCells, GridTile::kCells);
}

GridMoment moment_of(double time_s, const OlOfTiles& tiles) {
  GridMoment moment{time_s, {}, {}};
  std::string ol;
  for (const auto& [tile, cells] : tiles) {
    moment.tiles.push_back(tile);
    ol += cells;
  }
  moment.packed_ol = deflated(ol);
  return moment;
}

}  // namespace

void GridHistory::note(double time_s, const OccupancyGrid& grid, const CellChanges* changes) {
  if (is_given_up_) return;
  if (&grid != grid_) {  // another one than before
    grid_ = &grid;
    for (const Cell& tile : tiles_written(grid)) changed_.insert(tile);
  }
  if (changes != nullptr && !changes->empty())
    for (const Cell& tile : tiles_touched(*changes)) changed_.insert(tile);
  if (!changed_.empty() && time_s >= next_s_) take(time_s, grid);
}

void GridHistory::take(double time_s, const OccupancyGrid& grid) {
  OlOfTiles tiles;
  for (const Cell& tile : changed_) {
    const GridTile copied = copied_tile(grid, tile);
    tiles[tile].assign(copied.ol.begin(), copied.ol.end());
  }
  changed_.clear();
  moments_.push_back(moment_of(time_s, tiles));
  packed_bytes_ += moments_.back().packed_ol.size();
  next_s_ = time_s + every_s_;
  while (moments_.size() >= kFewMoments && (moments_.size() > kMaxMoments || packed_bytes_ > max_packed_bytes_))
    halve();
  if (packed_bytes_ <= max_packed_bytes_) return;
  is_given_up_ = true;
  moments_.clear();
  changed_.clear();
}

// Of two moments the later stays, with what changed at either.
void GridHistory::halve() {
  std::vector<GridMoment> kept;
  packed_bytes_ = 0;
  for (std::size_t i = 0; i < moments_.size(); i += 2) {
    OlOfTiles tiles;
    add_tiles(tiles, moments_[i]);
    const std::size_t last = std::min(i + 1, moments_.size() - 1);
    if (last > i) add_tiles(tiles, moments_[last]);
    kept.push_back(moment_of(moments_[last].time_s, tiles));
    packed_bytes_ += kept.back().packed_ol.size();
  }
  moments_ = std::move(kept);
  every_s_ *= 2.0;
}

}  // namespace cairn
