#include "framework/mission/loop/staged_modules.hpp"

namespace cairn {

HostStages::HostStages(StageClock& clock)
    : observation(clock.add("observation", "")),
      echo_prediction(clock.add("echo prediction", "")),
      perception(clock.add("perception", "")),
      landmark_tracker(clock.add("landmark tracker", "")),
      behaviour_tree(clock.add("behaviour tree", "")),
      route_joining(clock.add("route joining", "")),
      collision_monitor(clock.add("collision monitor", "")),
      listeners(clock.add("listeners", "")),
      run_control(clock.add("run control", "")),
      autosave(clock.add("autosave", "")) {}

StagedModules::StagedModules(const MissionModules& modules, const Mission& mission,
                             std::shared_ptr<const WallClock> wall_clock)
    : clock(std::move(wall_clock)), T_map_start(modules.T_map_start) {
  const MissionConfig& config = mission.config;
  const auto staged = [this](const auto& module, const char* stage, const PluginChoice& choice) {
    using Module = typename std::decay_t<decltype(module)>::element_type;
    return module ? Staged<Module>(module, clock, clock.add(stage, choice.name)) : Staged<Module>();
  };
  tick = clock.add("tick", "");
  sensor = staged(modules.sensor, "sensor", config.sensor);
  localizer = staged(modules.localizer, "localizer", config.localizer);
  loop_closer = clock.add(kLoopCloserStage, config.loop_closer.name);
  loop_closer_calls = modules.loop_closer_calls;
  mapper = staged(modules.mapper, "map", config.map);
  detector = staged(modules.detector, "detector", config.detector);
  if (config.markers) marker_detector = staged(modules.marker_detector, "marker detector", config.markers->detector);
  planner = staged(modules.planner, "planner", config.planner);
  routes = staged(modules.planner, "routes", config.planner);
  controller = staged(modules.controller, "controller", config.controller);
  const std::vector<const TreeNode*> nodes = behaviours_of(mission.steps);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    behaviours.push_back(staged(modules.behaviours[i], "behaviour", nodes[i]->choice));
  find_myself = staged(modules.find_myself, "behaviour", {kFindMyself, {}});
  drive = clock.add("drive", config.sensor.name);
  has_drive = sensor && sensor.call([](Sensor& source) { return source.drive(); }) != nullptr;
  if (MissionDisplay* const shown = sensor ? sensor.call([](Sensor& source) { return source.display(); }) : nullptr)
    display = {sensor.part(shown), clock, clock.add("display", config.sensor.name)};
}

StageClock::Id StagedModules::culprit_of(StageClock::Id stage) const {
  return stage == localizer.stage() && *loop_closer_calls > 0 ? loop_closer : stage;
}

}  // namespace cairn
