#include "framework/reporting/grid_history.hpp"

#include <string_view>
#include <utility>

#include "maps/base/deflate.hpp"

namespace cairn {
namespace {

std::string packed_tile(const OccupancyGrid& grid, Cell tile) {
  const GridTile copied = copied_tile(grid, tile);
  return deflated({reinterpret_cast<const char*>(copied.ol.data()), copied.ol.size()});
}

std::size_t bytes_of(const GridDelta& delta) {
  std::size_t bytes = 0;
  for (const auto& [tile, packed] : delta.packed_ol) bytes += packed.size();
  return bytes;
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
  GridDelta delta{time_s, {}};
  for (const Cell& tile : changed_) delta.packed_ol.emplace(tile, packed_tile(grid, tile));
  changed_.clear();
  packed_bytes_ += bytes_of(delta);
  deltas_.push_back(std::move(delta));
  next_s_ = time_s + every_s_;
  while (deltas_.size() >= kMinDeltas && (deltas_.size() > kMaxDeltas || packed_bytes_ > max_packed_bytes_)) halve();
  if (packed_bytes_ <= max_packed_bytes_) return;
  is_given_up_ = true;
  deltas_.clear();
  changed_.clear();
}

// Of two moments the later stays, with what changed at either. Nothing is packed again: a tick must not take long.
void GridHistory::halve() {
  std::vector<GridDelta> kept;
  packed_bytes_ = 0;
  for (std::size_t i = 0; i < deltas_.size(); i += 2) {
    const bool is_last = i + 1 == deltas_.size();
    GridDelta& later = deltas_[is_last ? i : i + 1];
    if (!is_last) later.packed_ol.merge(deltas_[i].packed_ol);  // which leaves those that are there already
    packed_bytes_ += bytes_of(later);
    kept.push_back(std::move(later));
  }
  deltas_ = std::move(kept);
  every_s_ *= 2.0;
}

}  // namespace cairn
