// Seeds made of seeds.
#pragma once

#include <cstdint>

namespace cairn {

// Added to the seed of an informed sampler: apart from the numbers of the plain samplers.
inline constexpr std::uint64_t kInformedStream = 0x1000;

// splitmix64 (S. Vigna): neighbouring seeds give unrelated streams.
[[nodiscard]] inline std::uint64_t mixed(std::uint64_t seed) {
  seed += 0x9e3779b97f4a7c15U;
  seed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
  seed = (seed ^ (seed >> 27)) * 0x94d049bb133111ebU;
  return seed ^ (seed >> 31);
}

}  // namespace cairn
