// The mission's clock: follows the stamps of observations from 0 on and stands while the mission is paused.
#pragma once

#include <optional>

namespace cairn {

class MissionClock {
 public:
  // Goes on from a saved map: mission time and pauses that it holds.
  void restore(double time_s, double paused_s);

  // The mission time of the next observation. is_paused: since the one before, the mission stood.
  double advance(double stamp_s, bool is_paused);
  // A log that is resumed is read from its beginning: the mission time of an observation before the first advance().
  [[nodiscard]] double replay(double stamp_s);

  [[nodiscard]] bool has_begun() const { return has_begun_; }  // with the first advance()
  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] double paused_s() const { return paused_s_; }  // by the observations' clock; not in time_s()
  [[nodiscard]] const std::optional<double>& resumed_s() const { return resumed_s_; }

 private:
  bool has_begun_ = false;
  std::optional<double> begin_stamp_s_;  // the stamp that is mission time 0
  double last_stamp_s_ = 0.0;
  double time_s_ = 0.0;
  double paused_s_ = 0.0;
  std::optional<double> resumed_s_;
};

}  // namespace cairn
