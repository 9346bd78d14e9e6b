// The independence log: how many readings a cell has taken from each bearing (docs/method.md 2.3; paper 2.2).
//
// The pose that a cell was read from is kept as the direction of sight, one of `bearings` buckets; the
// bucket of direction 0 has 0 in its middle. 32 buckets of 2 bits a cell: 8 bytes. A tile keeps them in
// four planes of eight buckets, 16 bits a cell each: one reading needs one or two planes only.
#pragma once

#include <array>
#include <cstdint>

#include "maps/grid/cell.hpp"
#include "plugins/common/sonar_model/tile_map.hpp"
#include "plugins/muriel/config.hpp"

namespace cairn::muriel {

inline constexpr int kMaxBearings = 32;
inline constexpr int kMaxReadings = 3;  // what 2 bits count
inline constexpr int kBucketsInPlane = 8;
inline constexpr int kPlanes = kMaxBearings / kBucketsInPlane;

class IndependenceLog {
 public:
  // Plane after plane.
  using Tile = std::array<std::uint16_t, kPlanes * sonar_model::kCellsInTile>;

  [[nodiscard]] int count(Cell cell, int bucket) const {
    const Tile* const tile = tiles_.find(sonar_model::tile_holding(cell));
    return tile == nullptr ? 0 : ((*tile)[place_of(cell, bucket)] >> shift_of(bucket)) & kMaxReadings;
  }
  // count: 0 to kMaxReadings. Grows where needed, and so does tile().
  void set_count(Cell cell, int bucket, int count) {
    std::uint16_t& counts = tiles_.at(sonar_model::tile_holding(cell))[place_of(cell, bucket)];
    counts = static_cast<std::uint16_t>((counts & ~(kMaxReadings << shift_of(bucket))) | (count << shift_of(bucket)));
  }
  [[nodiscard]] Tile& tile(Cell tile) { return tiles_.at(tile); }
  [[nodiscard]] std::size_t bytes() const { return tiles_.bytes(); }

 private:
  static std::size_t place_of(Cell cell, int bucket) {
    return static_cast<std::size_t>(bucket / kBucketsInPlane) * sonar_model::kCellsInTile +
           sonar_model::place_in_tile(cell);
  }
  static int shift_of(int bucket) { return 2 * (bucket % kBucketsInPlane); }

  sonar_model::TileMap<Tile> tiles_;
};

// Bucket of a direction of sight in the map frame, 0 to bearings - 1.
[[nodiscard]] int bucket_of(double direction_rad, int bearings);

// What the n-th reading from one bearing weighs, n counting from 0, under the policy of the settings.
using Weights = std::array<double, kMaxReadings + 1>;
[[nodiscard]] Weights weights_of(const Config& config);

}  // namespace cairn::muriel
