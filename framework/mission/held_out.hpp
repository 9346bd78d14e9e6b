// Range readings that are held out from the map, and how well the map predicts them: the measure of a
// map where no truth is known.
#pragma once

#include <cstdint>
#include <vector>

#include "framework/mission/events.hpp"

namespace cairn {

// Which readings of a run: every n-th, begun at one that the seed picks, so that n seeds in a row
// withhold each reading once.
class HoldOut {
 public:
  HoldOut(int every, std::int64_t seed) : every_(every), count_(every > 0 ? seed % every : 0) {}
  // Whether the next reading of the run is held out.
  bool next() { return every_ > 0 && ++count_ % every_ == 0; }

 private:
  std::int64_t every_;
  std::int64_t count_;
};

// Collects what a mission withholds. Readings that say nothing (NaN, nearer than min_m) are left out; as
// for every map, a range of max_m or more is no echo.
class HeldOutReadings : public Listener {
 public:
  HeldOutReadings(int every, std::int64_t seed) : hold_out_(every, seed) {}
  void on(const Event& event, const MissionView& view) override;

  [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(readings_.size()); }
  // Mean log-likelihood of the readings under the map, nat; 0 without readings.
  [[nodiscard]] double mean_log_likelihood(const OccupancyGrid& grid) const;

 private:
  struct HeldOut {
    Pose2 T_map_sensor;
    RangeReading reading;
  };
  HoldOut hold_out_;
  std::vector<HeldOut> readings_;
};

// Log of the chance (no echo) or of the density in 1/m (echo) that a map gives to a reading, nat.
//
// The same simple sensor for every map: the beam is cut into rings a cell deep; in each ring the cell
// believed occupied (P > 0.5) that is likeliest to answer does so with 0.7 (1 - (th/th_b)^2) P (a ray:
// 0.98 P), anything else with 0.05 a metre; the first answer is the reading, blurred by the range error of
// docs/method.md 2.1; one reading in ten is anything at all.
[[nodiscard]] double log_likelihood(const OccupancyGrid& grid, const Pose2& T_map_sensor, const RangeReading& reading);

}  // namespace cairn
