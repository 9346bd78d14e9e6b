// What observations show: where the robot is, what its surroundings look like, which landmarks are there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "framework/landmarks/tracker.hpp"
#include "framework/mission/events.hpp"
#include "framework/mission/held_out.hpp"
#include "framework/mission/loop/staged_modules.hpp"

namespace cairn {

// What a tick has recognised.
struct Recognition {
  std::int64_t matchings = 0;
  std::vector<Event> events;           // each matching, and what it has changed in the landmark graph
  const CoarseGrid* coarse = nullptr;  // the detector's
};

class Perception {
 public:
  // Mission and modules must outlive it.
  Perception(const Mission& mission, const StagedModules& modules, const Budget& budget);

  // Goes on from what an earlier run has known. Before begin().
  void restore(const SavedMap& map);
  // Once, before all below: asks the mapper for its grid. Throws ModuleFault, as all below do.
  const OccupancyGrid& begin();
  // Once, then: shows the detector what an earlier run has mapped; its coarse grid.
  const CoarseGrid* show_earlier_map();

  // The stages of a tick, in their order.
  [[nodiscard]] PoseEstimate localize(const Observation& observation);
  // Which cells may have changed; valid until the next call. Of deaf transducers "no echo" is no news for the map.
  const CellChanges& map(const Observation& observation, const PoseEstimate& pose, std::span<const int> deaf = {});
  [[nodiscard]] Recognition recognise(const CellChanges& changes, double time_s);

  [[nodiscard]] LandmarkTracker& tracker() { return tracker_; }
  [[nodiscard]] const LandmarkTracker& tracker() const { return tracker_; }

 private:
  struct Detected {
    DetectionReport report;
    const CoarseGrid* coarse = nullptr;
  };
  [[nodiscard]] Detected detect(const CellChanges& changes, const Budget& budget);
  void add_events(const std::vector<LandmarkTracker::Change>& changes, std::vector<Event>& events) const;

  const MissionConfig& config_;
  const StagedModules& modules_;
  const Budget budget_;
  LandmarkTracker tracker_;
  HoldOut hold_out_;
  Observation for_map_;  // without what is held out; a member for its memory only
  const OccupancyGrid* grid_ = nullptr;
  double last_freed_check_s_ = 0.0;
  bool is_resumed_ = false;
};

}  // namespace cairn
