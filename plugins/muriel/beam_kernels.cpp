#include "plugins/muriel/beam_kernels.hpp"

#include <bit>
#include <cstring>

#if defined(__x86_64__) && defined(__ELF__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CAIRN_FOR_EACH_MACHINE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define CAIRN_FOR_EACH_MACHINE
#endif
#define CAIRN_INLINE inline __attribute__((always_inline))

namespace cairn::muriel {
namespace {

// Eight lanes in the compiler's own vectors: whatever the machine has, it makes of them what it can.
using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Shorts = std::int16_t __attribute__((vector_size(16)));
using Quads = std::uint64_t __attribute__((vector_size(32), may_alias));
using Halves = std::uint64_t __attribute__((vector_size(16), may_alias));
using Words = std::uint64_t __attribute__((vector_size(64)));

constexpr Floats kLane = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr float kQuantaPerNat = 256.0F;
constexpr float kPerSqrtTwoPi = 0.39894228F;

template <class Vector, class T>
CAIRN_INLINE Vector load(const T* from) {
  Vector v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
template <class Vector, class T>
CAIRN_INLINE void store(T* to, const Vector& v) {
  std::memcpy(to, &v, sizeof v);
}
CAIRN_INLINE Floats all(float x) {
  return Floats{} + x;
}
CAIRN_INLINE Floats larger(const Floats& a, const Floats& b) {
  return a > b ? a : b;
}
CAIRN_INLINE Ints to_ints(const Floats& x) {  // towards 0
  return __builtin_convertvector(x, Ints);
}
CAIRN_INLINE Floats to_floats(const Ints& x) {
  return __builtin_convertvector(x, Floats);
}
CAIRN_INLINE Floats bits_as_floats(const Ints& x) {
  return reinterpret_cast<const Floats&>(x);
}
CAIRN_INLINE Ints bits_as_ints(const Floats& x) {
  return reinterpret_cast<const Ints&>(x);
}
CAIRN_INLINE bool any(const Ints& mask) {
  const Quads quads = reinterpret_cast<const Quads&>(mask);
  return (quads[0] | quads[1] | quads[2] | quads[3]) != 0;
}
CAIRN_INLINE bool any(const Shorts& mask) {
  const Halves halves = reinterpret_cast<const Halves&>(mask);
  return (halves[0] | halves[1]) != 0;
}
CAIRN_INLINE Floats square_root(const Floats& x) {
  alignas(32) float lanes[kBlock_cells];
  store(lanes, x);
  for (float& lane : lanes) lane = __builtin_sqrtf(lane);
  return load<Floats>(lanes);
}

// Angle squared from its tangent squared: a fit to atan(t)^2 / t^2 in t^2, good to 1e-5 up to 45 degrees.
CAIRN_INLINE Floats angle2_of_tangent2(const Floats& t) {
  const Floats t2 = t * t;
  return t *
         ((0.999997295F + -0.666399155F * t) +
          t2 * ((0.506630091F + -0.389583447F * t) + t2 * ((0.258316266F + -0.117268741F * t) + 0.025159398F * t2)));
}

// e^x for -87 <= x <= 0, relative error 2e-7: a power of two times a short series.
CAIRN_INLINE Floats exp_of(const Floats& x) {
  const Floats scaled = x * 1.44269504F;
  const Ints whole = to_ints(scaled - 0.5F);
  const Floats rest = (scaled - to_floats(whole)) * 0.69314718F;
  const Floats rest2 = rest * rest;
  const Floats series =
      (1.0F + rest) +
      rest2 * ((0.5F + 0.16666667F * rest) + rest2 * ((0.041666667F + 0.0083333333F * rest) + 0.0013888889F * rest2));
  return series * bits_as_floats((whole + 127) << 23);
}

// ln x for positive normal x: the series of atanh around a power of two, error 2e-7.
CAIRN_INLINE Floats ln_of(const Floats& x) {
  const Ints bits = bits_as_ints(x);
  const Ints exponent = (bits - 0x3f3504f3) >> 23;  // so that the rest lies within a factor sqrt(2) of 1
  const Floats rest = bits_as_floats(bits - (exponent << 23));
  const Floats s = (rest - 1.0F) / (rest + 1.0F);
  const Floats s2 = s * s;
  return to_floats(exponent) * 0.69314718F +
         s * ((2.0F + 0.66666667F * s2) + s2 * s2 * ((0.4F + 0.28571429F * s2) + 0.22222222F * (s2 * s2)));
}

// Abramowitz and Stegun 26.2.17 (error 7.5e-8); bell = e^(-z^2 / 2).
CAIRN_INLINE Floats normal_integral(const Floats& z, const Floats& bell) {
  const Floats t = 1.0F / (1.0F + 0.2316419F * larger(z, -z));
  const Floats t2 = t * t;
  const Floats tail = kPerSqrtTwoPi * bell * t *
                      ((0.31938153F - 0.356563782F * t) + t2 * ((1.781477937F - 1.821255978F * t) + 1.330274429F * t2));
  return z >= 0.0F ? 1.0F - tail : tail;
}

// One loop a step, each with few dependent operations, so that the machine can work at several blocks at once.

// Ranges, bearings and alphas of all runs, as if no echo were near; counts the blocks where one is.
template <bool is_ray>
CAIRN_INLINE int place_runs(const KernelReading& r, const Run* runs, int count, const KernelCells& out) {
  const Floats ahead_x = all(r.ahead_x);
  const Floats ahead_y = all(r.ahead_y);
  const Floats per_half_beam2 = all(r.per_half_beam2);
  const Floats per_alpha_range = all(r.per_alpha_range);
  const Floats alpha_max = all(r.alpha_max);
  const Floats near_m = all(r.near_m);
  const Floats reach_m = all(r.reach_m);
  const Floats lanes_m = kLane * static_cast<float>(r.cell_m);
  const auto block_m = static_cast<float>(kBlock_cells * r.cell_m);
  int near_count = 0;
  std::size_t at = 0;
  for (const Run* run = runs; run != runs + count; ++run) {
    const Floats dy_m = all(static_cast<float>((run->first.y + 0.5) * r.cell_m - r.apex_y_m));
    Floats dx_m = static_cast<float>((run->first.x + 0.5) * r.cell_m - r.apex_x_m) + lanes_m;
    Floats lane = kLane - static_cast<float>(run->begin);
    const Floats cells = all(static_cast<float>(run->end - run->begin));
    for (int b = 0; b < run->blocks; ++b, at += kBlock_cells, dx_m += block_m, lane += kBlock_cells) {
      const Floats along = ahead_x * dx_m + ahead_y * dy_m;
      Ints inside = (lane >= 0.0F) & (lane < cells);
      Floats range = larger(along, Floats{});
      Floats alpha = alpha_max;
      if constexpr (!is_ray) {
        const Floats across = ahead_x * dy_m - ahead_y * dx_m;
        const Floats along2 = along * along;
        const Floats across2 = across * across;
        range = square_root(along2 + across2);
        const Floats off2 = angle2_of_tangent2(across2 / (along2 + 1e-12F)) * per_half_beam2;
        inside &= (off2 <= 1.0F) & (along > 0.0F);
        alpha *= 1.0F - off2;
        store(out.off2 + at, across < 0.0F ? -off2 : off2);
      } else {
        store(out.off2 + at, Floats{});
      }
      const Ints reached = range <= reach_m;
      alpha = inside & reached ? alpha * larger(1.0F - range * per_alpha_range, Floats{}) : Floats{};
      store(out.range_m + at, range);
      store(out.alpha + at, alpha);
      store(out.miss + at, alpha);
      store(out.hit_per_m + at, Floats{});
      out.blocks[near_count] = static_cast<std::int32_t>(at);
      near_count += any((range > near_m) & reached) ? 1 : 0;
    }
  }
  return near_count;
}

// Where each cell's count stands in its log word.
CAIRN_INLINE void shift_runs(const KernelReading& r, const Run* runs, int count, std::int32_t* shift) {
  Floats edge_x[KernelReading::kMostEdges];
  Floats edge_y[KernelReading::kMostEdges];
  for (int e = 0; e < r.edges; ++e) {
    edge_x[e] = all(r.edge_x[static_cast<std::size_t>(e)]);
    edge_y[e] = all(r.edge_y[static_cast<std::size_t>(e)]);
  }
  const Floats lanes_m = kLane * static_cast<float>(r.cell_m);
  const auto block_m = static_cast<float>(kBlock_cells * r.cell_m);
  for (const Run* run = runs; run != runs + count; ++run) {
    const Floats dy_m = all(static_cast<float>((run->first.y + 0.5) * r.cell_m - r.apex_y_m));
    Floats dx_m = static_cast<float>((run->first.x + 0.5) * r.cell_m - r.apex_x_m) + lanes_m;
    for (int b = 0; b < run->blocks; ++b, shift += kBlock_cells, dx_m += block_m) {
      Ints bucket = Ints{} + r.first_bucket;
      for (int e = 0; e < r.edges; ++e) bucket -= edge_x[e] * dy_m >= edge_y[e] * dx_m;
      store(shift, 2 * (bucket - ((bucket >= r.bearings) & r.bearings)));
    }
  }
}

// Where the echo is near: miss and hit.
CAIRN_INLINE void compare_block(const KernelReading& r, std::size_t at, const KernelCells& out) {
  const auto range = load<Floats>(out.range_m + at);
  const auto alpha = load<Floats>(out.alpha + at);
  const Floats per_delta = 1.0F / (r.delta_m + r.delta_per_m * range);
  Floats z = (r.range_m - range) * per_delta;
  z = z < 12.0F ? larger(z, all(-12.0F)) : all(12.0F);
  const Floats bell = exp_of(-0.5F * z * z);
  store(out.miss + at, alpha * normal_integral(z, bell));
  if (r.is_echo) store(out.hit_per_m + at, alpha * bell * per_delta * kPerSqrtTwoPi);
}

CAIRN_INLINE int list_known(const KernelReading& r, const LogOdds* log_odds, std::size_t at, const float* alpha,
                            KnownTarget* known) {
  int count = 0;
  for (std::size_t i = 0; i < kBlock_cells; ++i) {
    known[count] = {static_cast<std::int32_t>(at + i), log_odds[i]};
    count += static_cast<int>(log_odds[i] >= r.believed_from) & static_cast<int>(alpha[at + i] > 0.0F);
  }
  return count;
}

CAIRN_INLINE Floats increment_of(const Floats& miss, const Floats& hit_per_m, const KernelScale& scale) {
  return kQuantaPerNat * ln_of(1.0F + scale.weight * (hit_per_m * scale.per_false_echo_m - miss));
}

CAIRN_INLINE void note_changes(const Shorts& moved, int at, Run& run) {
  const Halves halves = reinterpret_cast<const Halves&>(moved);
  if ((halves[0] | halves[1]) == 0) return;
  if (run.last_changed < 0)
    run.first_changed = at + (halves[0] != 0 ? std::countr_zero(halves[0]) : 64 + std::countr_zero(halves[1])) / 16;
  run.last_changed = at + (halves[1] != 0 ? 127 - std::countl_zero(halves[1]) : 63 - std::countl_zero(halves[0])) / 16;
}

}  // namespace

CAIRN_FOR_EACH_MACHINE
int evaluate_runs(const KernelReading& reading, const Run* runs, int count, const KernelCells& out,
                  KnownTarget* known) {
  const KernelReading r = reading;
  const int near_count = r.is_ray ? place_runs<true>(r, runs, count, out) : place_runs<false>(r, runs, count, out);
  shift_runs(r, runs, count, out.shift);
  for (int i = 0; i < near_count; ++i) compare_block(r, static_cast<std::size_t>(out.blocks[i]), out);

  int found = 0;
  std::size_t at = 0;
  for (const Run* run = runs; run != runs + count; ++run)
    for (int offset = 0; offset < run->blocks * kBlock_cells; offset += kBlock_cells, at += kBlock_cells) {
      const Shorts believed = load<Shorts>(run->cells + offset) >= static_cast<std::int16_t>(r.believed_from);
      if (any(believed)) found += list_known(r, run->cells + offset, at, out.alpha, known + found);
    }
  return found;
}

CAIRN_FOR_EACH_MACHINE
bool says_something(const float* miss, const float* hit_per_m, const KernelScale& scale, int count) {
  for (int i = 0; i < count; i += kBlock_cells) {
    const Floats increment = increment_of(load<Floats>(miss + i), load<Floats>(hit_per_m + i), scale);
    if (any((increment >= 0.5F) | (increment <= -0.5F))) return true;
  }
  return false;
}

CAIRN_FOR_EACH_MACHINE
void apply_runs(const KernelCells& cells, const KernelScale& scale, const KernelWeights& weights, Run* runs,
                int count) {
  const KernelScale by = scale;
  const auto weight_of_count = load<Floats>(weights.data());
  const Ints highest = Ints{} + by.clamp;
  const Ints lowest = -highest;
  const float* miss = cells.miss;
  const float* hit = cells.hit_per_m;
  const std::int32_t* shift = cells.shift;
  for (Run* run = runs; run != runs + count; ++run)
    for (int at = 0; at < run->blocks * kBlock_cells;
         at += kBlock_cells, miss += kBlock_cells, hit += kBlock_cells, shift += kBlock_cells) {
      Floats change = increment_of(load<Floats>(miss), load<Floats>(hit), by);
      Ints taken = (change >= 0.5F) | (change <= -0.5F);
      if (run->cells_to_write == nullptr || !any(taken)) continue;
      if (run->words != nullptr) {
        auto log = load<Words>(run->words + at);
        const Words shifts = __builtin_convertvector(load<Ints>(shift), Words);
        const Floats weight = __builtin_shuffle(weight_of_count, __builtin_convertvector((log >> shifts) & 3, Ints));
        taken &= weight > 0.0F;
        if (!any(taken)) continue;
        log += __builtin_convertvector(taken & 1, Words) << shifts;
        store(run->words + at, log);
        change *= weight;
      }
      change = taken ? change : Floats{};
      const Ints before = __builtin_convertvector(load<Shorts>(run->cells_to_write + at), Ints);
      Ints after = before + to_ints(change + (change < 0.0F ? all(-0.5F) : all(0.5F)));
      after = after > highest ? highest : after;
      after = after < lowest ? lowest : after;
      store(run->cells_to_write + at, __builtin_convertvector(after, Shorts));
      note_changes(__builtin_convertvector(after != before, Shorts), at, *run);
    }
}

}  // namespace cairn::muriel
