// What a reading says, given the map: the parts of docs/method.md 2.2 that both evaluations share, as numbers.
#pragma once

#include <algorithm>
#include <array>
#include <optional>

#include "framework/contracts/observation.hpp"
#include "maps/grid/beam_cells.hpp"
#include "plugins/muriel/config.hpp"

namespace cairn::muriel {

// Beyond this many range errors behind the echo no cell learns as much as a quantum (1/256 nat).
inline constexpr double kReach_sigmas = 4.5;

// A reading that says something, placed in the map.
struct PlacedReading {
  Beam beam;              // its reach is that of the evidence
  bool is_echo = false;   // else: nothing up to range_m
  bool is_light = false;  // of a laser: nothing mirrors it
  double range_m = 0.0;
};

// Nothing for a reading that sonar_model::meaning_of() ignores. A cone that is nowhere wider than a
// cell becomes a ray: cell centres would miss it.
[[nodiscard]] std::optional<PlacedReading> placed(const Config& config, const RangeReading& reading,
                                                  const Pose2& T_map_robot);

// The targets that the map knows in a beam, the best of each angular sector.
class KnownTargets {
 public:
  explicit KnownTargets(int sectors) : sectors_(sectors) {}

  // off_axis: bearing / half_beam, -1 to 1.
  void add_blocker(double off_axis, double answer) { raise(blocking_[sector_of(off_axis)], answer); }
  void add_source(double off_axis, double density_per_m) { raise(density_per_m_[sector_of(off_axis)], density_per_m); }

  void add_blocker_in(int sector, double answer) { raise(blocking_[static_cast<std::size_t>(sector)], answer); }
  void add_source_in(int sector, double density_per_m) {
    raise(density_per_m_[static_cast<std::size_t>(sector)], density_per_m);
  }

  // Probability that the reading is specular (docs/method.md 2.2).
  [[nodiscard]] double specular_p(const Config& config, bool is_echo) const;

 private:
  [[nodiscard]] std::size_t sector_of(double off_axis) const {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(0.5 * (off_axis + 1.0) * sectors_), 0, sectors_ - 1));
  }
  static void raise(double& best, double value) { best = std::max(best, value); }

  int sectors_;
  std::array<double, kMaxSectors> blocking_{};       // alpha p of the best target before the echo
  std::array<double, kMaxSectors> density_per_m_{};  // alpha p N(D; r, delta) of the best target anywhere
};

}  // namespace cairn::muriel
