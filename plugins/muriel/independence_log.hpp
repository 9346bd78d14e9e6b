// The independence log: how many readings a cell has taken from each bearing (METHOD 2.3; paper 2.2).
//
// The pose that a cell was read from is kept as the direction of sight, one of `bearings` buckets; the
// bucket of direction 0 has 0 in its middle. One word a cell: 32 buckets of 2 bits.
#pragma once

#include <array>
#include <cstdint>

#include "maps/cell.hpp"
#include "plugins/muriel/config.hpp"
#include "plugins/sonar_model/tile_map.hpp"

namespace cairn::muriel {

using LogWord = std::uint64_t;
inline constexpr int kMostBearings = 32;
inline constexpr int kMostReadings = 3;  // what 2 bits count

[[nodiscard]] constexpr int count_in(LogWord word, int bucket) {
  return static_cast<int>((word >> (2 * bucket)) & kMostReadings);
}

class IndependenceLog {
 public:
  using Tile = std::array<LogWord, sonar_model::kCellsInTile>;

  [[nodiscard]] LogWord word(Cell cell) const {
    const Tile* const tile = tiles_.find(sonar_model::tile_holding(cell));
    return tile == nullptr ? 0 : (*tile)[sonar_model::place_in_tile(cell)];
  }
  // Both grow where needed.
  [[nodiscard]] Tile& tile(Cell tile) { return tiles_.at(tile); }
  [[nodiscard]] LogWord& word_for_writing(Cell cell) {
    return tiles_.at(sonar_model::tile_holding(cell))[sonar_model::place_in_tile(cell)];
  }
  [[nodiscard]] std::size_t bytes() const { return tiles_.bytes(); }

 private:
  sonar_model::TileMap<Tile> tiles_;
};

// Bucket of a direction of sight in the map frame, 0 to bearings - 1.
[[nodiscard]] int bucket_of(double direction_rad, int bearings);

// What the n-th reading from one bearing weighs, n counting from 0, under the policy of the settings.
using Weights = std::array<double, kMostReadings + 1>;
[[nodiscard]] Weights weights_of(const Config& config);

}  // namespace cairn::muriel
