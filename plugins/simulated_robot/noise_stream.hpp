// One random stream a purpose, so that changing one error of a robot leaves the others as they were.
#pragma once

#include <cstdint>
#include <random>

namespace cairn {

class NoiseStream {
 public:
  // Streams of one seed with different purposes are independent (splitmix64 of both).
  NoiseStream(std::uint64_t seed, std::uint64_t purpose)
      : engine_(mixed(seed + 0x9e3779b97f4a7c15ULL * (purpose + 1))) {}

  [[nodiscard]] double normal() { return normal_(engine_); }                                   // mean 0, deviation 1
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }  // [0, 1)

 private:
  [[nodiscard]] static std::uint64_t mixed(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace cairn
