// The inner loops of the fast evaluation: METHOD 2.1 over flat arrays, in single precision.
//
// Compiled for several instruction sets, chosen when the program starts; all give the same bits.
// Against double precision an increment is off by less than 0.05 quanta of 1/256 nat (beam_kernels_test).
#pragma once

namespace cairn::muriel {

// One reading's numbers, lengths in metres.
struct KernelReading {
  float ahead_x = 1.0F;  // the beam's axis, map frame
  float ahead_y = 0.0F;
  float per_half_beam2 = 0.0F;  // 1 / half_beam^2; 0 for a ray
  float alpha_max = 0.0F;
  float per_alpha_range = 0.0F;
  float delta_m = 0.0F;
  float delta_per_m = 0.0F;
  float range_m = 0.0F;
  float reach_m = 0.0F;
  bool is_ray = false;
  bool is_echo = false;
};

// What the reading says of each cell, before weighting.
struct KernelCells {
  float* range_m;
  float* off_axis;  // bearing / half_beam
  float* alpha;
  float* miss;       // alpha Phi(z)
  float* hit_per_m;  // alpha phi(z) / delta; 0 without an echo
};

// dx_m, dy_m: cell centres from the apex, map frame. Cells beyond the reach get alpha 0.
void evaluate_cells(const KernelReading& reading, const float* dx_m, const float* dy_m, int count,
                    const KernelCells& out);

// increments[i] = 256 ln(1 + weight (hit / F - miss)), quanta.
void weigh_cells(const float* miss, const float* hit_per_m, float weight, float per_false_echo_m, int count,
                 float* increments);

}  // namespace cairn::muriel
