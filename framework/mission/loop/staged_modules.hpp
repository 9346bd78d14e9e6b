// The modules of a mission, each in its stage.
#pragma once

#include <memory>
#include <vector>

#include "framework/mission/modules.hpp"
#include "framework/modules/staged.hpp"

namespace cairn {

struct StagedModules {
  // The stages get their names from the mission's settings.
  StagedModules(const MissionModules& modules, const Mission& mission, std::shared_ptr<const WallClock> wall_clock);
  StagedModules(const StagedModules&) = delete;  // the parts refer to the clock
  StagedModules& operator=(const StagedModules&) = delete;

  StageClock clock;
  StageClock::Id tick = StageClock::kHost;  // a whole one; holds stages and is none itself
  Staged<Sensor> sensor;
  Staged<Localizer> localizer;
  Staged<Mapper> mapper;
  Staged<Detector> detector;                  // may be none
  Staged<Planner> planner;                    // may be none
  Staged<Planner> routes;                     // the same, when it joins landmarks
  Staged<Controller> controller;              // may be none
  std::vector<Staged<Behaviour>> behaviours;  // in the order of behaviours_of()
  StageClock::Id drive = StageClock::kHost;
  Pose2 T_map_start;
};

}  // namespace cairn
