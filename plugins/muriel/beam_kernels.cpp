#include "plugins/muriel/beam_kernels.hpp"

#include <bit>
#include <cmath>
#include <cstdint>

#if defined(__x86_64__) && defined(__ELF__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define CAIRN_FOR_EACH_MACHINE __attribute__((target_clones("avx2", "default")))
#else
#define CAIRN_FOR_EACH_MACHINE
#endif
#define CAIRN_INLINE inline __attribute__((always_inline))

namespace cairn::muriel {
namespace {

constexpr float kQuantaPerNat = 256.0F;

CAIRN_INLINE float larger(float a, float b) {
  return a > b ? a : b;  // std::fmax minds NaN and does not vectorise
}
CAIRN_INLINE float smaller(float a, float b) {
  return a < b ? a : b;
}

// Angle squared from v = 1 - cos(angle): 2 sum (2v)^n / (n^2 C(2n, n)), good to 1e-7 up to 45 degrees.
CAIRN_INLINE float angle2_of_versine(float v) {
  return v * (2.0F + v * (0.33333333F +
                          v * (0.088888889F +
                               v * (0.028571429F + v * (0.01015873F + v * (0.0038480038F + v * 0.0015222872F))))));
}

// e^x for -87 <= x <= 0, relative error 2e-7: a power of two times a short series.
CAIRN_INLINE float exp_of(float x) {
  const float scaled = x * 1.44269504F;
  const float whole = static_cast<float>(static_cast<std::int32_t>(scaled - 0.5F));
  const float rest = (scaled - whole) * 0.69314718F;
  const float series =
      1.0F +
      rest * (1.0F + rest * (0.5F + rest * (0.16666667F +
                                            rest * (0.041666667F + rest * (0.0083333333F + rest * 0.0013888889F)))));
  const auto power = static_cast<std::uint32_t>(static_cast<std::int32_t>(whole) + 127) << 23U;
  return series * std::bit_cast<float>(power);
}

// ln x for positive normal x: the series of atanh around a power of two, error 2e-7.
CAIRN_INLINE float ln_of(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const std::int32_t exponent = (bits - 0x3f3504f3) >> 23;  // so that the rest lies within a factor sqrt(2) of 1
  const float rest = std::bit_cast<float>(bits - (exponent << 23));
  const float s = (rest - 1.0F) / (rest + 1.0F);
  const float s2 = s * s;
  const float series = s * (2.0F + s2 * (0.66666667F + s2 * (0.4F + s2 * (0.28571429F + s2 * 0.22222222F))));
  return static_cast<float>(exponent) * 0.69314718F + series;
}

// Abramowitz and Stegun 26.2.17 (error 7.5e-8), with phi(z) sqrt(2 pi) at hand.
CAIRN_INLINE float normal_integral(float z, float bell) {
  const float t = 1.0F / (1.0F + 0.2316419F * std::fabs(z));
  const float tail = 0.39894228F * bell * t *
                     (0.31938153F + t * (-0.356563782F + t * (1.781477937F + t * (-1.821255978F + t * 1.330274429F))));
  return z >= 0.0F ? 1.0F - tail : tail;
}

}  // namespace

CAIRN_FOR_EACH_MACHINE
void evaluate_cells(const KernelReading& reading, const float* __restrict dx_m, const float* __restrict dy_m, int count,
                    const KernelCells& out) {
  const KernelReading r = reading;
  float* const __restrict out_range = out.range_m;
  float* const __restrict out_off_axis = out.off_axis;
  float* const __restrict out_alpha = out.alpha;
  float* const __restrict out_miss = out.miss;
  float* const __restrict out_hit = out.hit_per_m;
  const float ray = r.is_ray ? 1.0F : 0.0F;
  const float echo = r.is_echo ? 0.39894228F : 0.0F;
  for (int i = 0; i < count; ++i) {
    const float along = r.ahead_x * dx_m[i] + r.ahead_y * dy_m[i];
    const float across = (r.ahead_x * dy_m[i] - r.ahead_y * dx_m[i]) * (1.0F - ray);
    const float ahead = along > 0.0F ? along : 0.0F;
    const float along_used = ray > 0.0F ? ahead : along;
    const float range = std::sqrt(along_used * along_used + across * across);
    const float versine = across * across / (range * (range + along_used) + 1e-20F);
    const float off2 = angle2_of_versine(versine) * r.per_half_beam2;
    const float inside = off2 <= 1.0F && range <= r.reach_m ? 1.0F : 0.0F;
    const float near = larger(1.0F - range * r.per_alpha_range, 0.0F);
    const float alpha = inside * r.alpha_max * near * (1.0F - off2);

    const float per_delta = 1.0F / (r.delta_m + r.delta_per_m * range);
    const float z = smaller(larger((r.range_m - range) * per_delta, -12.0F), 12.0F);
    const float bell = exp_of(-0.5F * z * z);
    out_range[i] = range;
    out_off_axis[i] = std::copysign(std::sqrt(off2), across);
    out_alpha[i] = alpha;
    out_miss[i] = alpha * normal_integral(z, bell);
    out_hit[i] = alpha * bell * per_delta * echo;
  }
}

CAIRN_FOR_EACH_MACHINE
void weigh_cells(const float* __restrict miss, const float* __restrict hit_per_m, float weight, float per_false_echo_m,
                 int count, float* __restrict increments) {
  for (int i = 0; i < count; ++i)
    increments[i] = kQuantaPerNat * ln_of(1.0F + weight * (hit_per_m[i] * per_false_echo_m - miss[i]));
}

}  // namespace cairn::muriel
