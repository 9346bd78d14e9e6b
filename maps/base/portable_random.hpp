// Random draws that are the same on every compiler, unlike the distributions of the standard library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace cairn {

// The output function of splitmix64 (S. Vigna).
[[nodiscard]] constexpr std::uint64_t finalized(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
  return z ^ (z >> 31U);
}
inline constexpr std::uint64_t kSplitmixStep = 0x9e3779b97f4a7c15U;
// A seed made of a seed: neighbouring ones give unrelated streams.
[[nodiscard]] constexpr std::uint64_t mixed_seed(std::uint64_t seed) {
  return finalized(seed + kSplitmixStep);
}

class PortableRandom {
 public:
  explicit PortableRandom(std::uint64_t seed) : random_(seed) {}
  // Streams of one seed with different purposes are independent, and so are those of neighbouring seeds (splitmix64).
  PortableRandom(std::uint64_t seed, std::uint64_t purpose) : random_(mixed_seed(mixed_seed(seed) + purpose)) {}
  double share() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }  // [0, 1)
  double between(double low, double high) { return low + (high - low) * share(); }
  // One of low .. high, both included.
  int whole(int low, int high) { return low + std::min(high - low, static_cast<int>((high - low + 1) * share())); }
  // Until the next of independent events that come at this rate; > 0.
  double wait(double per_unit) { return -std::log(1.0 - share()) / per_unit; }

 private:
  std::mt19937_64 random_;
};

}  // namespace cairn
