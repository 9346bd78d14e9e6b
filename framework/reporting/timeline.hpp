// What happened in a run beside its nodes, when: for the report and the picture of the run.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/mission/events.hpp"

namespace cairn {

// By the mission's clock.
struct RunSpan {
  double begin_s = 0.0;
  double end_s = 0.0;
};

// The mission's clock stood at time_s, for so long by the robot's.
struct PauseSpan {
  double time_s = 0.0;
  double for_s = 0.0;
};

inline constexpr std::size_t kMaxRunSpans = 10000;  // of each kind; what comes later is left out

class RunTimeline : public Listener {
 public:
  void on(const Event& event, const MissionView& view) override;

  [[nodiscard]] const std::vector<PauseSpan>& pauses() const { return pauses_; }
  // While the collision monitor allowed nothing of a wanted speed.
  [[nodiscard]] const std::vector<RunSpan>& stops() const { return stops_; }
  // While the robot itself let nobody drive it.
  [[nodiscard]] const std::vector<RunSpan>& holds() const { return holds_; }
  [[nodiscard]] const std::vector<double>& bumps_s() const { return bumps_s_; }
  [[nodiscard]] const std::vector<double>& saves_s() const { return saves_s_; }  // of maps, by the mission itself

 private:
  void note_stop(double speed_reduction_ratio, double time_s);
  void note_hold(bool is_held, double time_s);

  std::vector<PauseSpan> pauses_;
  std::vector<RunSpan> stops_;
  std::vector<RunSpan> holds_;
  std::vector<double> bumps_s_;
  std::vector<double> saves_s_;
  bool is_stopped_ = false;
  bool is_held_ = false;
};

}  // namespace cairn
