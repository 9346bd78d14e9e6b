// What a trial is judged by, noted from tick to tick.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/mission/events.hpp"

namespace cairn {

struct TrialMoment {
  double time_s = 0.0;  // of the mission's clock
  Pose2 T_map_robot;    // in truth
  double off_m = 0.0;   // of the estimate
  double off_rad = 0.0;
  bool is_empty = false;  // the battery
};

// Times without any reading that began while the robot was ordered to move.
struct SilenceFigures {
  int silences = 0;
  // The tick without readings, from 1, from which on it was ordered to stand; the worst of all silences.
  int worst_stop_ticks = 0;
};

// A landmark as the map held it.
struct KnownLandmark {
  std::string category;
  Point at_m;
  Point access_m;  // where the robot stands beside it
};

class TrialRecord : public Listener {
 public:
  // Notes ticks in which the truth is known.
  void on(const Event& event, const MissionView& view) override;

  [[nodiscard]] const std::vector<TrialMoment>& moments() const { return moments_; }
  [[nodiscard]] const SilenceFigures& silences() const { return silences_; }
  // When the node ended the last time that it was published; nothing when it was not.
  [[nodiscard]] std::vector<KnownLandmark> landmarks_at_end(const std::string& path) const;

 private:
  void note_tick(const MissionView& view);
  void note_landmarks(const std::string& path, const LandmarkGraph& graph);
  void note_silence(const Observation& observation, const Twist& commanded);

  std::vector<TrialMoment> moments_;
  std::map<std::string, std::vector<KnownLandmark>> landmarks_;  // by the node's path
  SilenceFigures silences_;
  int silent_ticks_ = 0;
  bool moved_before_ = false;  // ordered to, in the last tick
  bool counts_ = false;        // the silence under way began while moving
};

// The longest time in which the robot neither moved by 0.1 m nor turned by 15 deg.
struct Stand {
  double begin_s = 0.0;
  double for_s = 0.0;
};
// Times at which it waits on purpose (inside of a span) or can do nothing (its battery is empty) count as progress.
struct WaitSpan {
  double begin_s = 0.0;
  double end_s = 0.0;
};
[[nodiscard]] Stand longest_stand(const std::vector<TrialMoment>& moments, const std::vector<WaitSpan>& waits);

}  // namespace cairn
