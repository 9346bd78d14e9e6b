// One random stream a purpose, so that changing one error of a robot leaves the others as they were.
#pragma once

#include <cstdint>
#include <random>

#include "maps/base/portable_random.hpp"

namespace cairn {

class NoiseStream {
 public:
  // Streams of one seed with different purposes are independent (splitmix64 of both).
  NoiseStream(std::uint64_t seed, std::uint64_t purpose) : engine_(finalized(seed + kSplitmixStep * (purpose + 1))) {}

  [[nodiscard]] double normal() { return normal_(engine_); }                                   // mean 0, deviation 1
  [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }  // [0, 1)

 private:
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
};

}  // namespace cairn
