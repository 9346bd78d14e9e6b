// The modules of a mission, each in its stage.
#pragma once

#include <memory>
#include <vector>

#include "framework/contracts/optional/mission_display.hpp"
#include "framework/mission/modules.hpp"
#include "framework/modules/staged.hpp"

namespace cairn {

// What the host itself does in a tick: stages like those of modules, so that a tick's time is accounted for.
struct HostStages {
  explicit HostStages(StageClock& clock);

  StageClock::Id observation;        // takes it in, keeps the pace
  StageClock::Id echo_prediction;    // of sonars that were silent
  StageClock::Id perception;         // what is left out of the map, the path
  StageClock::Id landmark_tracker;   // from detections to landmarks
  StageClock::Id behaviour_tree;     // conditions, steps, times left
  StageClock::Id route_joining;      // landmarks that a step has found
  StageClock::Id collision_monitor;  // limits the velocity
  StageClock::Id listeners;          // reports, recordings, displays
  StageClock::Id run_control;        // the status for others
  StageClock::Id autosave;
};

struct StagedModules {
  // The stages get their names from the mission's settings.
  StagedModules(const MissionModules& modules, const Mission& mission, std::shared_ptr<const WallClock> wall_clock);
  StagedModules(const StagedModules&) = delete;  // the parts refer to the clock
  StagedModules& operator=(const StagedModules&) = delete;

  // Whose fault it is that a stage does not come to its end: a localizer may wait for its loop closer.
  [[nodiscard]] StageClock::Id culprit_of(StageClock::Id stage) const;

  StageClock clock;
  HostStages host{clock};
  StageClock::Id tick = StageClock::kHost;  // a whole one; its own time is what no stage accounts for
  Staged<Sensor> sensor;
  Staged<Localizer> localizer;
  StageClock::Id loop_closer = StageClock::kHost;
  std::shared_ptr<CallsUnderWay> loop_closer_calls;
  Staged<Mapper> mapper;
  Staged<Detector> detector;                  // may be none
  Staged<MarkerDetector> marker_detector;     // may be none
  Staged<Planner> planner;                    // may be none
  Staged<Planner> routes;                     // the same, when it joins landmarks
  Staged<Controller> controller;              // may be none
  std::vector<Staged<Behaviour>> behaviours;  // in the order of behaviours_of()
  Staged<Behaviour> find_myself;              // may be none
  StageClock::Id drive = StageClock::kHost;
  Staged<MissionDisplay> display;  // may be none
  bool has_drive = false;          // else the sensor plays back what others have driven
  Pose2 T_map_start;
};

}  // namespace cairn
