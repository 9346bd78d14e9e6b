// The evaluation of rays of light: docs/method.md 2.1 along one line of cells, a thousand times a scan.
//
// Light has no bearing and no mirror: what a cell learns depends on its range and the echo's alone, and comes from
// tables. Same cells and, to one quantum, same values as plain_muriel.hpp. O(cells on the ray).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "plugins/muriel/independence_log.hpp"
#include "plugins/muriel/reading_model.hpp"
#include "plugins/muriel/row_hull.hpp"

namespace cairn::muriel {

class LightRays {
 public:
  explicit LightRays(const Config& config);

  // A reading that is_light. Its cells that changed are added to the rows, and not announced to the grid.
  void integrate(const PlacedReading& reading, OccupancyGrid& grid, IndependenceLog& log, RowHull& changed);
  // Cells looked at so far.
  [[nodiscard]] std::int64_t cells() const { return cells_; }

 private:
  // Part of one row in one tile. Null: the tile is not there yet.
  struct Row {
    LogOdds* cells = nullptr;
    std::uint16_t* counts = nullptr;
  };
  struct Ray;

  [[nodiscard]] float increment_of(const Ray& ray, float range_m) const;
  // Cells x_begin to x_end - 1 of row y, all in one tile.
  void take_row(const Ray& ray, const CellSpan& span, OccupancyGrid& grid, IndependenceLog& log, RowHull& changed);

  Config config_;
  std::array<float, kMaxReadings + 1> weights_{};
  // The settings, as the loop needs them.
  float alpha_max_;
  float per_alpha_range_;
  float delta_m_;
  float delta_per_m_;
  std::vector<float> before_echo_;  // quanta by range, where the echo is far behind
  std::vector<float> integral_;     // of the normal distribution, by standard deviations
  std::vector<float> density_;
  std::vector<CellSpan> spans_;  // of one ray
  Row tile_;                     // the first cell of the tile that rows come from
  Cell tile_at_{};
  bool has_tile_ = false;
  std::int64_t cells_ = 0;
};

}  // namespace cairn::muriel
