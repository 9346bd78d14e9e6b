// Random draws that are the same on every compiler, unlike the distributions of the standard library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace cairn {

class PortableRandom {
 public:
  explicit PortableRandom(std::uint64_t seed) : random_(seed) {}
  // Streams of one seed with different purposes are independent, and so are those of neighbouring seeds (splitmix64).
  PortableRandom(std::uint64_t seed, std::uint64_t purpose) : random_(mixed(mixed(seed) + purpose)) {}
  double share() { return static_cast<double>(random_() >> 11) * 0x1.0p-53; }  // [0, 1)
  double between(double low, double high) { return low + (high - low) * share(); }
  // One of low .. high, both included.
  int whole(int low, int high) { return low + std::min(high - low, static_cast<int>((high - low + 1) * share())); }
  // Until the next of independent events that come at this rate; > 0.
  double wait(double per_unit) { return -std::log(1.0 - share()) / per_unit; }

 private:
  static std::uint64_t mixed(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::mt19937_64 random_;
};

}  // namespace cairn
