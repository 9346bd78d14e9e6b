// How the grid grew: what of it had changed at moments of a run, for its timeline.
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "framework/reporting/grid_tiles.hpp"

namespace cairn {

// Each piece that changed since the delta before, as it then was.
struct GridDelta {
  double time_s = 0.0;
  std::map<Cell, std::string> packed_ol;  // of each of these tiles, by maps/base/deflate.hpp
};

// A delta every second at first. When there are too many, or they take too much memory, two and two become one and
// half as many are taken from then on; a grid so large that few would be left has no history any more.
class GridHistory {
 public:
  static constexpr std::size_t kMaxDeltas = 200;
  static constexpr std::size_t kMaxPackedBytes = std::size_t{8} << 20;
  static constexpr std::size_t kMinDeltas = 8;

  explicit GridHistory(std::size_t max_packed_bytes = kMaxPackedBytes) : max_packed_bytes_(max_packed_bytes) {}

  // After each tick. changes: null: nothing. Allocates nothing while nothing changes.
  void note(double time_s, const OccupancyGrid& grid, const CellChanges* changes);

  [[nodiscard]] const std::vector<GridDelta>& deltas() const { return deltas_; }

 private:
  void take(double time_s, const OccupancyGrid& grid);
  void halve();

  const std::size_t max_packed_bytes_;
  const OccupancyGrid* grid_ = nullptr;
  std::set<Cell> changed_;
  std::vector<GridDelta> deltas_;
  std::size_t packed_bytes_ = 0;
  double every_s_ = 1.0;
  double next_s_ = 0.0;
  bool is_given_up_ = false;
};

}  // namespace cairn
