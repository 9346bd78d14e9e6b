// The inner loops of the fast evaluation: METHOD 2.1 over blocks of eight cells, in single precision.
//
// Compiled for several instruction sets, chosen when the program starts; all give the same bits.
#pragma once

#include <array>
#include <cstdint>

#include "maps/cell.hpp"
#include "maps/occupancy_grid.hpp"

namespace cairn::muriel {

inline constexpr int kBlock_cells = 8;

// Cells of one row in one tile, none of its blocks beyond that: `blocks` blocks from `first` on, of which the cells
// first.x + begin to first.x + end - 1 are the beam's.
struct Run {
  Cell first;
  int blocks = 0;
  int begin = 0;
  int end = 0;
  const LogOdds* cells = nullptr;  // of `first`
  bool is_seen = true;             // the map has that tile

  // For apply_runs(); null: leave the run alone. Without a log words is null.
  LogOdds* cells_to_write = nullptr;
  std::uint64_t* words = nullptr;
  // What apply_runs() changed, from the first to the last such cell counted from `first`; none: last < 0.
  int first_changed = 0;
  int last_changed = -1;
};

// One reading's numbers, lengths in metres.
struct KernelReading {
  double apex_x_m = 0.0;
  double apex_y_m = 0.0;
  double cell_m = 0.05;
  float ahead_x = 1.0F;  // the beam's axis, map frame
  float ahead_y = 0.0F;
  float per_half_beam2 = 0.0F;  // 1 / half_beam^2; 0 for a ray
  float alpha_max = 0.0F;
  float per_alpha_range = 0.0F;
  float delta_m = 0.0F;
  float delta_per_m = 0.0F;
  float range_m = 0.0F;
  float reach_m = 0.0F;
  float near_m = 0.0F;  // up to here Phi is 1 and phi 0
  bool is_ray = false;
  bool is_echo = false;
  int believed_from = 0;  // log-odds of a known target

  // Directions of sight: buckets first_bucket to first_bucket + edges, modulo bearings.
  static constexpr int kMostEdges = 9;
  int bearings = 1;
  int first_bucket = 0;
  int edges = 0;
  std::array<float, kMostEdges> edge_x{};
  std::array<float, kMostEdges> edge_y{};
};

// What the reading says of each cell, before weighting: kBlock_cells entries a block.
struct KernelCells {
  float* miss;          // alpha Phi(z)
  float* hit_per_m;     // alpha phi(z) / delta; 0 without an echo
  std::int32_t* shift;  // of the cell's count in its log word
  float* range_m;
  float* off2;  // (bearing / half_beam)^2, with the sign of the bearing
  float* alpha;
  std::int32_t* blocks;  // room for two numbers a block
};

// A cell that the map believes occupied.
struct KnownTarget {
  std::int32_t index;  // into KernelCells
  std::int32_t log_odds;
};

// Evaluates all runs, one block after the other; cells that are not the beam's get 0 and 0. known must
// have room for every cell and one more; returns how many it got.
int evaluate_runs(const KernelReading& reading, const Run* runs, int count, const KernelCells& out, KnownTarget* known);

// How a reading's parts become an increment: 256 ln(1 + weight (hit / F - miss)), quanta.
struct KernelScale {
  float weight = 1.0F;  // 1 - s
  float per_false_echo_m = 1.0F;
  int clamp = 1024;  // of the grid
};

// Whether any of `count` cells gets an increment that does not round to 0.
bool says_something(const float* miss, const float* hit_per_m, const KernelScale& scale, int count);

// Weight of a reading by the cell's count, 0 to 3; the rest is filling.
using KernelWeights = std::array<float, kBlock_cells>;

// Adds the increments to the runs' cells and counts them in their log words.
void apply_runs(const KernelCells& cells, const KernelScale& scale, const KernelWeights& weights, Run* runs, int count);

}  // namespace cairn::muriel
