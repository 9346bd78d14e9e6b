// Eight lanes in the compiler's own vectors, and the few functions of them that the sonar model needs. The same bits
// on every machine: single operations only, no estimates, no fused multiply-add (its files forbid contraction).
//
// For the kernels' files only, each compiled for one instruction set: hence the unnamed namespace.
#pragma once

#include <cstdint>
#include <cstring>

#if defined(__AVX2__)
#include <immintrin.h>
#endif

#define CAIRN_INLINE inline __attribute__((always_inline))

namespace cairn::muriel {
namespace {  // NOLINT

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));
using Words = std::uint32_t __attribute__((vector_size(32)));
using Shorts = std::int16_t __attribute__((vector_size(16)));
using Counts = std::uint16_t __attribute__((vector_size(16)));

constexpr Floats kLane = {0, 1, 2, 3, 4, 5, 6, 7};

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

#if defined(__AVX2__)

CAIRN_INLINE Floats larger(Floats a, Floats b) {
  return _mm256_max_ps(a, b);
}
CAIRN_INLINE Floats smaller(Floats a, Floats b) {
  return _mm256_min_ps(a, b);
}
CAIRN_INLINE Floats square_root(Floats x) {
  return _mm256_sqrt_ps(x);
}
CAIRN_INLINE bool any(Ints mask) {
  return _mm256_movemask_ps(_mm256_castsi256_ps(reinterpret_cast<__m256i>(mask))) != 0;
}
CAIRN_INLINE bool any(Shorts mask) {
  return _mm_movemask_epi8(reinterpret_cast<__m128i>(mask)) != 0;
}
// x where the mask is set, else 0.
CAIRN_INLINE Floats where(Ints mask, Floats x) {
  return _mm256_and_ps(_mm256_castsi256_ps(reinterpret_cast<__m256i>(mask)), x);
}
// Entry 0 to 7 of a table, by lane.
CAIRN_INLINE Floats entry(Floats table, Ints index) {
  return _mm256_permutevar8x32_ps(table, reinterpret_cast<__m256i>(index));
}

// To the nearest, the even one of two.
CAIRN_INLINE Ints rounded(Floats x) {
  return reinterpret_cast<Ints>(_mm256_cvtps_epi32(x));
}
CAIRN_INLINE Ints widened(Shorts x) {
  return reinterpret_cast<Ints>(_mm256_cvtepi16_epi32(reinterpret_cast<__m128i>(x)));
}
CAIRN_INLINE Words widened(Counts x) {
  return reinterpret_cast<Words>(_mm256_cvtepu16_epi32(reinterpret_cast<__m128i>(x)));
}
// For what fits.
CAIRN_INLINE Shorts narrowed(Ints x) {
  const auto wide = reinterpret_cast<__m256i>(x);
  return reinterpret_cast<Shorts>(_mm_packs_epi32(_mm256_castsi256_si128(wide), _mm256_extracti128_si256(wide, 1)));
}
CAIRN_INLINE Counts narrowed(Words x) {
  const auto wide = reinterpret_cast<__m256i>(x);
  return reinterpret_cast<Counts>(_mm_packus_epi32(_mm256_castsi256_si128(wide), _mm256_extracti128_si256(wide, 1)));
}
// A bit a lane.
CAIRN_INLINE std::uint8_t bits_of(Shorts mask) {
  const auto lanes = reinterpret_cast<__m128i>(mask);
  return static_cast<std::uint8_t>(_mm_movemask_epi8(_mm_packs_epi16(lanes, lanes)));
}

#else

CAIRN_INLINE Ints rounded(Floats x) {  // for less than 2^22: there a float's last bit is a whole
  const Floats moved = x + 12582912.0F;
  return reinterpret_cast<Ints>(moved) - 0x4b400000;
}
CAIRN_INLINE Ints widened(Shorts x) {
  return __builtin_convertvector(x, Ints);
}
CAIRN_INLINE Words widened(Counts x) {
  return __builtin_convertvector(x, Words);
}
CAIRN_INLINE Shorts narrowed(Ints x) {
  return __builtin_convertvector(x, Shorts);
}
CAIRN_INLINE Counts narrowed(Words x) {
  return __builtin_convertvector(x, Counts);
}
CAIRN_INLINE std::uint8_t bits_of(Shorts mask) {
  int bits = 0;
  for (int lane = 0; lane < 8; ++lane) bits |= mask[lane] & (1 << lane);
  return static_cast<std::uint8_t>(bits);
}
CAIRN_INLINE Floats larger(Floats a, Floats b) {
  return a > b ? a : b;
}
CAIRN_INLINE Floats smaller(Floats a, Floats b) {
  return a < b ? a : b;
}
CAIRN_INLINE Floats square_root(Floats x) {
  for (int lane = 0; lane < 8; ++lane) x[lane] = __builtin_sqrtf(x[lane]);
  return x;
}
template <class Mask>
CAIRN_INLINE bool any(Mask mask) {
  int sum = 0;
  for (int lane = 0; lane < 8; ++lane) sum |= mask[lane];
  return sum != 0;
}
CAIRN_INLINE Floats where(Ints mask, Floats x) {
  return mask ? x : Floats{};
}
CAIRN_INLINE Floats entry(Floats table, Ints index) {
  Floats entries;
  for (int lane = 0; lane < 8; ++lane) entries[lane] = table[index[lane]];
  return entries;
}

#endif

CAIRN_INLINE Ints to_ints(const Floats& x) {  // towards 0
  return __builtin_convertvector(x, Ints);
}
CAIRN_INLINE Floats to_floats(const Ints& x) {
  return __builtin_convertvector(x, Floats);
}
CAIRN_INLINE Floats bits_as_floats(Ints x) {
  return reinterpret_cast<Floats>(x);
}
CAIRN_INLINE Ints bits_as_ints(Floats x) {
  return reinterpret_cast<Ints>(x);
}
// atan(t) for |t| <= tan(20.5 deg), good to 1e-7; t2 = t * t.
CAIRN_INLINE Floats atan_narrow(const Floats& t, const Floats& t2) {
  return t * ((0.999999734F - 0.333272128F * t2) + (t2 * t2) * (0.197768828F - 0.116075268F * t2));
}
// The same for |t| <= 1.
CAIRN_INLINE Floats atan_wide(const Floats& t, const Floats& t2) {
  const Floats t4 = t2 * t2;
  const Floats low = (0.999999882F - 0.333318127F * t2) + t4 * (0.199669618F - 0.140032902F * t2);
  const Floats high = (0.0986886546F - 0.0588297531F * t2) + t4 * (0.0237805186F - 0.00455979199F * t2);
  return t * (low + (t4 * t4) * high);
}

// e^x for -87 <= x <= 0, relative error 3e-6: a power of two times a short series.
CAIRN_INLINE Floats exp_of(const Floats& x) {
  const Floats scaled = x * 1.44269504F;
  const Ints whole = rounded(scaled);
  const Floats rest = (scaled - to_floats(whole)) * 0.69314718F;
  const Floats series = (1.0F + 0.999960779F * rest) +
                        (rest * rest) * ((0.499993469F + 0.167946436F * rest) + 0.0418798061F * (rest * rest));
  return series * bits_as_floats((whole + 127) << 23);
}

// 256 ln x for positive normal x, error 0.002: the series of atanh around a power of two.
CAIRN_INLINE Floats quanta_of_ln(const Floats& x) {
  const Ints bits = bits_as_ints(x);
  const Ints exponent = (bits - 0x3f3504f3) >> 23;  // so that the rest lies within a factor sqrt(2) of 1
  const Floats rest = bits_as_floats(bits - (exponent << 23));
  const Floats s = (rest - 1.0F) / (rest + 1.0F);
  return to_floats(exponent) * (256.0F * 0.69314718F) + s * (256.0F * 1.99995481F + (256.0F * 0.678788687F) * (s * s));
}

constexpr float kPerSqrtTwoPi = 0.39894228F;

// Abramowitz and Stegun 26.2.16 (error 1e-5); bell = e^(-z^2 / 2).
CAIRN_INLINE Floats normal_integral(const Floats& z, const Floats& bell) {
  const Floats t = 1.0F / (1.0F + 0.33267F * larger(z, -z));
  const Floats tail = (kPerSqrtTwoPi * bell) * (t * (0.4361836F + t * (0.937298F * t - 0.1201676F)));
  return z >= 0.0F ? 1.0F - tail : tail;
}

}  // namespace
}  // namespace cairn::muriel
