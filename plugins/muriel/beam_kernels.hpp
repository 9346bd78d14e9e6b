// The inner loops of the fast evaluation: docs/method.md 2.1 over blocks of eight cells, in single precision.
//
// Compiled for several instruction sets (Highway), the machine's best is chosen at run time; all give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "maps/grid/occupancy_grid.hpp"
#include "plugins/muriel/config.hpp"

namespace cairn::muriel {

inline constexpr int kBlock_cells = 8;

// Eight neighbouring cells of one row in one tile. Those that are not of the beam get no evidence, by their
// bearing and range; in a ray, which has no bearings, by their place: lanes begin to end - 1 are of it.
struct Block {
  float dx_m = 0.0F;  // the first cell's centre from the apex
  float dy_m = 0.0F;
  LogOdds* cells = nullptr;
  std::uint16_t* log = nullptr;  // counts, in the reading's first plane (independence_log.hpp)
  float begin = 0.0F;
  float end = 0.0F;
};

// Beams up to here, half a beam of 20 degrees, take the shorter series.
inline constexpr float kNarrowTangent2 = 0.1325F;

// One reading's numbers, lengths in metres.
struct KernelReading {
  float cell_m = 0.05F;
  float ahead_x = 1.0F;  // the beam's axis, map frame
  float ahead_y = 0.0F;
  float per_half_beam = 0.0F;    // 0 for a ray
  float widest_tangent2 = 0.0F;  // of the beam's edge
  float alpha_max = 0.0F;
  float per_alpha_range = 0.0F;
  float delta_m = 0.0F;
  float delta_per_m = 0.0F;
  float per_false_echo_m = 1.0F;
  float range_m = 0.0F;
  float reach_m = 0.0F;
  float near_m = 0.0F;  // up to here Phi is 1 and phi 0
  bool is_ray = false;
  bool is_echo = false;
  int believed_from = 0;  // log-odds of a known target
  int sectors = 1;
};

// Room for find_targets(), a block longer than there are blocks.
struct TargetList {
  float* value;
  std::int32_t* sector;
};

// What one reading says of each cell, kBlock_cells entries a block, and two lists of blocks.
struct KernelCells {
  float* evidence;  // lambda0 - 1
  float* range_m;
  float* off;           // bearing / half_beam
  std::int32_t* near;   // where the echo is near
  std::int32_t* known;  // where the map believes in a target
  TargetList blockers;
  TargetList sources;
  std::uint8_t* moved;  // one number a block, a bit a cell: what apply_blocks() changed
};
struct ListLengths {
  int near = 0;
  int known = 0;
};

// The best targets of each sector among the known blocks: alpha p before the echo, alpha p N(D; r, delta) anywhere.
struct SectorTargets {
  float blocking[kMaxSectors];
  float density_per_m[kMaxSectors];
};

// How evidence becomes a change: round(weight of the cell's count * 256 ln(1 + weight evidence)), quanta.
struct KernelScale {
  float weight = 1.0F;            // 1 - s
  int clamp = 1024;               // of the grid, at most 100 nat
  float weight_of_count[4] = {};  // counts 0 to 3
};

// Where a reading's counts stand in the log: the first and, plane_step on, the second plane of 16 bits a
// cell make 32 bits, from `shift` on two a bucket.
struct KernelLog {
  bool is_on = false;
  std::ptrdiff_t plane_step = 0;  // 0: one plane is enough
  int shift = 0;                  // of the beam's first bucket
  float buckets_per_off = 0.0F;
  float buckets_to_axis = 0.0F;  // from the beginning of the first bucket
};

// Evidence as if no echo were near, and the lists.
[[nodiscard]] ListLengths place_blocks(const KernelReading& reading, const Block* blocks, int count,
                                       const KernelCells& cells);
// Between place_blocks() and compare_blocks(). The entries up to reading.sectors.
void find_targets(const KernelReading& reading, const Block* blocks, int known, const KernelCells& cells,
                  SectorTargets& best);
// The echo, or its absence, in the near blocks' evidence.
void compare_blocks(const KernelReading& reading, int near, const KernelCells& cells);
// Whether any of `count` cells gets an increment that does not round to 0.
[[nodiscard]] bool says_something(const float* evidence, const KernelScale& scale, int count);
// Changes the blocks' cells and counts the reading in their logs.
void apply_blocks(const KernelScale& scale, const KernelLog& log, const Block* blocks, int count,
                  const KernelCells& cells);

}  // namespace cairn::muriel
