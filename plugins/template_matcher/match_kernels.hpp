// The inner loops of the fast matcher, compiled for every instruction set that the compiler knows;
// the best one that the machine has is chosen when the program runs. All of them work on whole
// numbers or on floats that are exact, so every instruction set gives the same bits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cairn::template_matcher {

// Directions on which gradients are projected: 8 leave more to be computed, 32 hardly less.
inline constexpr int kDirections = 16;
// sum_block_shortfalls() works on at most this many at once; arrays are padded to whole groups.
inline constexpr std::size_t kPlacesPerGroup = 128;
inline constexpr std::size_t kPlacesPerPiece = 32;       // of sum_segment_shortfalls()
inline constexpr std::size_t kPlacesPerExactPiece = 16;  // of sum_distances()

// Unit vector k in 1/16384, rounded towards zero: never longer than 1.
struct Direction {
  std::int16_t x;
  std::int16_t y;
};
[[nodiscard]] Direction direction(int k);

// A template cell as the bounds see it: how long its gradient is along a direction, rounded down, and
// where that direction's projection is found for place 0.
struct BoundCell {
  std::uint32_t value = 0;  // index of the map's value
  std::uint16_t wanted = 0;
};

// Projections of the gradients of a window on each direction, rounded up to units of 2^shift, plus
// `offset` so that none is negative: one map a direction, rows `stride` apart.
struct ProjectionMaps {
  const std::uint16_t* first = nullptr;
  std::size_t map_size = 0;
  std::size_t stride = 0;
};

// The same for blocks, in units of 2^(shift + kCoarserBits).
struct BlockMaps {
  const std::uint8_t* first = nullptr;
  std::size_t map_size = 0;
  std::size_t stride = 0;
};
inline constexpr int kCoarserBits = 1;

struct ProjectionRows {
  const std::int16_t* x = nullptr;  // gradients of the window's first row
  const std::int16_t* y = nullptr;
  std::size_t gradient_stride = 0;
  std::size_t width = 0;
  std::size_t height = 0;
  int shift = 0;
  std::uint16_t offset = 0;
};

// kDirections maps. Writes up to kPlacesPerPiece values beyond a row's width: stride >= width, and the
// last map has room behind it.
void project(const ProjectionRows& rows, std::uint16_t* maps, std::size_t map_size, std::size_t stride);

// Of each map four maps of half the size, one for each parity of (row, column): the largest value of
// 2 x 2 neighbours, so that one entry bounds four neighbouring places of a template cell.
void pool(const ProjectionMaps& from, std::size_t width, std::size_t height, std::uint8_t* maps, std::size_t map_size,
          std::size_t stride);

// sums[i] = start[i] + sum over cells of max(0, wanted - map), saturated at 65535, for i < count, a multiple
// of kPlacesPerGroup. A group all of whose sums have reached `limit` is given up: its sums are >= limit.
void sum_block_shortfalls(const std::uint8_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                          const std::uint16_t* start, std::size_t count, std::uint16_t* sums);

// The same for kPlacesPerPiece places from `place` on.
void sum_segment_shortfalls(const std::uint16_t* maps, std::span<const BoundCell> cells, std::uint16_t limit,
                            const std::uint16_t* start, std::size_t place, std::uint16_t* sums);

// The places, rising, whose sums are below the limit; returns how many. count: a multiple of kPlacesPerPiece.
std::size_t collect_below(const std::uint16_t* sums, std::size_t count, std::uint16_t limit, std::uint32_t* places);

struct GradientCell {
  std::int32_t x;
  std::int32_t y;
  std::int16_t gradient_x;
  std::int16_t gradient_y;
};

// The mismatches of kPlacesPerExactPiece neighbouring places. Given up when all are above `limit`: then none of the
// sums is at most `limit`.
void sum_distances(const std::int16_t* x, const std::int16_t* y, std::ptrdiff_t stride,
                   std::span<const GradientCell> cells, std::int32_t limit, std::int32_t* sums);

// A template's cells by columns, as sum_distance() reads them.
struct GradientColumns {
  std::vector<std::int32_t> x;
  std::vector<std::int32_t> y;
  std::vector<float> gradient_x;
  std::vector<float> gradient_y;
  std::size_t count = 0;  // the columns are longer, by up to kPlacesPerExactPiece

  void push_back(const GradientCell& cell);
};

// The mismatch of one place, where sum_distances() would compute its neighbours too; `both` as
// GradientField::both_from() gives it. Given up once it is above `limit`: then what is returned is above it too.
[[nodiscard]] std::int32_t sum_distance(const std::int32_t* both, std::ptrdiff_t stride, const GradientColumns& cells,
                                        std::int32_t limit);

}  // namespace cairn::template_matcher
