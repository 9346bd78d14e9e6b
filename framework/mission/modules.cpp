#include "framework/mission/modules.hpp"

#include "framework/behaviour_tree/parameters.hpp"
#include "framework/contracts/optional/marker_families.hpp"
#include "framework/mission/making_errors.hpp"
#include "framework/mission/named_values.hpp"
#include "framework/mission/resume.hpp"
#include "framework/mission/start_wait.hpp"
#include "framework/modules/fence.hpp"
#include "framework/modules/making.hpp"
#include "framework/templates/sensed_templates.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/base/text.hpp"
#include "maps/landmarks/ring_template.hpp"
#include "maps/submaps/kept_submaps.hpp"

namespace cairn {
namespace {

// place: of what is wrong with several settings together, for which a module knows none.
template <class Interface>
std::shared_ptr<Interface> build_at(const SourcePlace& place, const ModuleLibrary& library, const PluginChoice& choice,
                                    const ContextOf<Interface>& context) {
  const ModuleMaking making(choice.name, std::is_same_v<Interface, Sensor>);
  try {
    return fenced_making(choice.name, [&] { return library.make<Interface>(choice, context); });
  } catch (const ConfigError& error) {
    throw each_changed(error, [&](const ConfigError& one) -> ConfigError {
      return one.place().file.empty() ? ConfigError(place, one.sentence()) : one;
    });
  }
}

template <class Interface>
std::shared_ptr<Interface> build(const ModuleLibrary& library, const PluginChoice& choice,
                                 const ContextOf<Interface>& context) {
  return build_at<Interface>(choice.config.place, library, choice, context);
}

// What factories of all kinds get.
ModuleContext context_for(const Mission& mission, const ModuleLibrary& library, PluginKind kind,
                          std::size_t index = 0) {
  return {mission.robot, module_seed(mission.config.seed, kind, index), &library};
}

std::shared_ptr<Sensor> build_sensor(const Mission& mission, const ModuleLibrary& library, const MissionModules& built,
                                     const std::atomic<bool>* cancel = nullptr) {
  const World* const world = mission.world ? &*mission.world : nullptr;
  return build<Sensor>(library, mission.config.sensor,
                       {context_for(mission, library, PluginKind::sensor), world, built.T_map_start, built.begin_s,
                        Budget{.cancel = cancel}, mission.config.markers.has_value()});
}

std::shared_ptr<MarkerDetector> build_marker_detector(const Mission& mission, const ModuleLibrary& library) {
  if (!mission.config.markers) return nullptr;
  const MarkersConfig& config = *mission.config.markers;
  auto detector =
      build<MarkerDetector>(library, config.detector, context_for(mission, library, PluginKind::marker_detector));
  if (const auto* const known = dynamic_cast<const MarkerFamilies*>(detector.get()))
    check_marker_numbers(config.categories,
                         fenced("marker detector", config.detector.name, [&] { return known->families(); }));
  return detector;
}

std::shared_ptr<LoopCloser> build_loop_closer(const Mission& mission, const ModuleLibrary& library,
                                              std::shared_ptr<CallsUnderWay> calls) {
  const PluginChoice& choice = mission.config.loop_closer;
  auto closer = build<LoopCloser>(library, choice, context_for(mission, library, PluginKind::loop_closer));
  return std::make_shared<FencedLoopCloser>(std::move(closer), choice.name, std::move(calls));
}

std::shared_ptr<Mapper> build_mapper(const Mission& mission, const ModuleLibrary& library,
                                     const OccupancyGrid* grid_so_far = nullptr) {
  return build<Mapper>(library, mission.config.map, {context_for(mission, library, PluginKind::map), grid_so_far});
}

std::shared_ptr<Planner> build_planner(const Mission& mission, const ModuleLibrary& library) {
  return build<Planner>(library, mission.config.planner, context_for(mission, library, PluginKind::planner));
}

void add_detector(const Mission& mission, const ModuleLibrary& library, double cell_m, MissionModules& built) {
  const PluginChoice& detector = mission.config.detector;
  (void)library.find(PluginKind::detector, detector.name, detector.config.place);
  built.templates = std::make_shared<TemplateSet>(
      fenced_making(mission.config.map.name, [&] { return render_templates(mission, cell_m, library); }));
  built.detector =
      build<Detector>(library, detector, {context_for(mission, library, PluginKind::detector), built.templates});
}

// The default one is made only for a localizer that takes it.
bool is_chosen(const PluginChoice& loop_closer) {
  return loop_closer.name != default_loop_closer().name || !loop_closer.config.entries.empty();
}

// The default controller is not missed before a behaviour asks for it.
std::shared_ptr<Controller> build_controller(const Mission& mission, const ModuleLibrary& library) {
  const PluginChoice& choice = mission.config.controller;
  const ModuleContext context = context_for(mission, library, PluginKind::controller);
  const bool is_default = choice.config.kind == ConfigValue::Kind::null;
  if (!is_default) return build<Controller>(library, choice, context);
  if (library.find_of(PluginKind::controller, choice.name) == nullptr) return nullptr;
  PluginChoice usual = choice;
  usual.config.kind = ConfigValue::Kind::map;
  return build<Controller>(library, usual, context);
}

// What is no behaviour may be meant for a node.
[[noreturn]] void fail_unknown(const ModuleLibrary& library, const TreeNode& node) {
  std::vector<std::string> known;
  for (const KnownModule& module : library.known())
    if (module.kind == PluginKind::behaviour) known.push_back(module.name);
  const std::vector<std::string> nodes = node_names();
  std::vector<std::string> names = known;
  names.insert(names.end(), nodes.begin(), nodes.end());
  std::string sentence =
      "unknown behaviour plugin " + in_quotes(node.choice.name) + did_you_mean(node.choice.name, names) +
      "; known are: " + (known.empty() ? "none" : joined(known)) + "; and these nodes: " + joined(nodes);
  for (const std::string& fault : library.faults()) sentence += "\n  not loaded: " + fault;
  throw ConfigError(node.place, sentence);
}

std::shared_ptr<Behaviour> build_behaviour(const Mission& mission, const ModuleLibrary& library, const TreeNode& node,
                                           std::size_t index = 0) {
  BehaviourFactoryContext context{context_for(mission, library, PluginKind::behaviour, index)};
  context.categories = categories_of(mission);
  if (library.find_any(node.choice.name) == nullptr) fail_unknown(library, node);
  try {
    return build_at<Behaviour>(node.place, library, node.choice, context);
  } catch (const ConfigError& error) {
    throw with_place_of_use(error, node.choice.config, node.place);
  }
}

// Without a step such a mission would be done at once, and its map nothing but the first readings.
void check_has_steps(const MissionConfig& config, const std::vector<TreeNode>& steps, Sensor& sensor) {
  if (!steps.empty() || config.steps.kind != ConfigValue::Kind::null) return;
  if (fenced("sensor", config.sensor.name, [&] { return sensor.drive(); }) == nullptr) return;
  throw ConfigError(config.sensor.config.place, "the mission has no steps, and " + config.sensor.name +
                                                    " drives: say under `steps` what is to be done");
}

// A simulated robot knows at once whether it can stand where the mission puts it. A live one, whose mission may have a
// world to hold its landmarks against, is not connected to for that.
void check_can_start(const Mission& mission, Sensor& sensor) {
  if (!mission.world || fenced("sensor", mission.config.sensor.name, [&] { return sensor.truth(); }) == nullptr) return;
  const SensorStep step = fenced("sensor", mission.config.sensor.name, [&] { return sensor.next(Budget{}); });
  if (step.state == SensorState::fault) throw ConfigError(mission.start_place, step.reason);
}

Pose2 start_of(const MissionConfig& config) {
  return {config.start.at_m.x(), config.start.at_m.y(), config.start.angle_rad};
}

// Where the sensor says that the robot begins, which it may wait for.
std::optional<Pose2> start_from_sensor(const MissionConfig& config, const Sensor& sensor, const BuildOptions& options) {
  const auto is_cancelled = [&] { return options.cancel != nullptr && options.cancel->load(); };
  const bool was_cancelled = is_cancelled();
  const StartWait wait(sensor, options.on_wait);
  const ModuleMaking making(config.sensor.name, true);
  const auto start = fenced("sensor", config.sensor.name, [&] { return sensor.start(); });
  if (is_cancelled() && !was_cancelled)
    throw ConfigError(config.sensor.config.place, config.sensor.name + " was still being asked where the robot begins");
  return start;
}

std::shared_ptr<Mapper> mapper_that_goes_on(const Mission& mission, const ModuleLibrary& library, const Mapper& empty,
                                            const OccupancyGrid& saved) {
  const PluginChoice& map = mission.config.map;
  check_same_cells(saved, fenced("map", map.name, [&]() -> const OccupancyGrid& { return empty.grid(); }));
  std::shared_ptr<Mapper> mapper = build_mapper(mission, library, &saved);
  if (fenced("map", map.name, [&]() -> const OccupancyGrid& { return mapper->grid(); }) != saved)
    throw StoreError("cannot go on with this mission: its map module " + map.name +
                     " does not begin with a grid that is given to it");
  return mapper;
}

// Null where its module is not installed.
std::shared_ptr<Behaviour> build_find_myself(const Mission& mission, const ModuleLibrary& library, std::size_t index) {
  if (library.find_any(kFindMyself) == nullptr) return nullptr;
  TreeNode node;
  node.name = node.choice.name = kFindMyself;
  node.choice.config.kind = ConfigValue::Kind::map;
  node.choice.config.place = node.place = mission.config.steps.place;
  return build_behaviour(mission, library, node, index);
}

}  // namespace

std::uint64_t module_seed(std::int64_t mission_seed, PluginKind kind, std::size_t index) {
  // The first modules of a kind lie side by side, the kinds one behind the other; the rest lie behind all kinds.
  constexpr std::uint64_t kSideBySide = 101;
  constexpr std::uint64_t kKinds = 9;  // as many as there were first: seeds stay when kinds are added
  const std::uint64_t row = index / kSideBySide;
  return mixed_seed(static_cast<std::uint64_t>(mission_seed) * 1000003U +
                    (static_cast<std::uint64_t>(kind) + row * kKinds) * kSideBySide + index % kSideBySide);
}

TemplateSet render_templates(const Mission& mission, double cell_m, const ModuleLibrary& modules) {
  const TemplateSettings& config = mission.template_settings;
  const bool is_blind = mission.robot.sonars.empty() && mission.robot.lasers.empty();
  if (mission.shapes.empty() || config.rendering == Rendering::ideal || is_blind)
    return render_ring_set(mission.shapes, config.step_rad, cell_m, config.sizes, config.ring_offset_m);
  PluginChoice simulator{"simulated_robot", {}};
  simulator.config.kind = ConfigValue::Kind::map;
  simulator.config.place = mission.config.sensor.config.place;
  if (mission.config.sensor.name == simulator.name) simulator = mission.config.sensor;
  SensedOptions options;
  options.sizes = config.sizes;
  options.smooth_too = config.smooth_too;
  options.smooth_tolerance = config.smooth_tolerance;
  return render_sensed_set(mission.shapes, config.step_rad, cell_m, options, mission.robot, simulator,
                           mission.config.map, modules, TemplateCache(template_cache_folder()));
}

std::shared_ptr<Sensor> build_sensor(const Mission& mission, const ModuleLibrary& library) {
  MissionModules built;
  built.T_map_start = start_of(mission.config);
  return build_sensor(mission, library, built);
}

const KeptSubmaps* usable_submaps(const SavedMap* map) {
  return map == nullptr || map->submaps.empty() || !fault_of(map->submaps).empty() ? nullptr : &map->submaps;
}

std::shared_ptr<Localizer> build_localizer(const Mission& mission, const ModuleLibrary& library,
                                           const LocalizerStart& start,
                                           std::shared_ptr<CallsUnderWay> loop_closer_calls) {
  return build<Localizer>(
      library, mission.config.localizer,
      {context_for(mission, library, PluginKind::localizer), start.T_map_start, mission.shapes, start.uncertainty,
       [&mission, &library, calls = std::move(loop_closer_calls)] {
         return build_loop_closer(mission, library, calls);
       },
       start.saved_submaps});
}

std::shared_ptr<Mapper> build_map(const Mission& mission, const ModuleLibrary& library,
                                  const OccupancyGrid* grid_so_far) {
  return build_mapper(mission, library, grid_so_far);
}

std::shared_ptr<Detector> build_detector(const Mission& mission, const ModuleLibrary& library, double cell_m) {
  MissionModules built;
  built.T_map_start = start_of(mission.config);
  add_detector(mission, library, cell_m, built);
  return built.detector;
}

MissionModules build_modules(const Mission& mission, const ModuleLibrary& library, const SavedMap* resume,
                             const BuildOptions& options, const std::optional<LocalizerStart>& start_known) {
  const MissionConfig& config = mission.config;
  const bool is_left_alone = start_known && resume == nullptr;  // the map
  MissionModules built;
  built.T_map_start = start_of(config);
  if (resume != nullptr) {
    check_resumable(*resume, mission);
    built.begin_s = resume->progress->time_s + paused_before(*resume);
    // A simulated robot stands where it really was; what knows of it begins where it was thought to be.
    built.T_map_start = resume->progress->true_T_map_robot.value_or(resume->progress->T_map_robot);
  }
  built.sensor = build_sensor(mission, library, built, options.cancel);
  check_has_steps(config, mission.steps, *built.sensor);
  if (resume == nullptr && !start_known) {
    if (const auto start = start_from_sensor(config, *built.sensor, options)) built.T_map_start = *start;
  }
  if (resume != nullptr) built.T_map_start = resume->progress->T_map_robot;
  if (start_known) built.T_map_start = start_known->T_map_start;
  built.localizer = build_localizer(mission, library,
                                    start_known.value_or(LocalizerStart{built.T_map_start, {}, usable_submaps(resume)}),
                                    built.loop_closer_calls);
  // One that the localizer does not take (who takes one shares its calls) is made for its errors alone.
  if (is_chosen(config.loop_closer) && built.loop_closer_calls.use_count() == 1)
    (void)build_loop_closer(mission, library, built.loop_closer_calls);
  built.mapper = build_mapper(mission, library);
  if (resume != nullptr) built.mapper = mapper_that_goes_on(mission, library, *built.mapper, resume->grid);
  if (!config.detector.name.empty() && !is_left_alone)
    add_detector(mission, library, built.mapper->grid().cell_m(), built);
  built.marker_detector = build_marker_detector(mission, library);
  if (!config.planner.name.empty()) built.planner = build_planner(mission, library);
  built.controller = build_controller(mission, library);
  if (const std::vector<ConfigError> missing = missing_inputs(mission.steps, library); !missing.empty())
    throw missing.front();
  for (const TreeNode* node : behaviours_of(mission.steps))
    built.behaviours.push_back(build_behaviour(mission, library, *node, built.behaviours.size()));
  if (!is_left_alone && fenced("sensor", config.sensor.name, [&] { return built.sensor->drive(); }) != nullptr)
    built.find_myself = build_find_myself(mission, library, built.behaviours.size());
  return built;
}

std::vector<std::string> check_modules(const Mission& mission, const ModuleLibrary& library) {
  const MissionConfig& config = mission.config;
  MakingErrors errors;
  MissionModules built;
  built.T_map_start = start_of(config);
  errors.attempt([&] {
    if (config.sensor.name.empty()) return;
    const auto sensor = build_sensor(mission, library, built);
    check_has_steps(config, mission.steps, *sensor);
    check_can_start(mission, *sensor);
  });
  errors.attempt([&] {
    if (!config.localizer.name.empty())
      (void)build_localizer(mission, library, LocalizerStart{built.T_map_start, {}}, built.loop_closer_calls);
  });
  errors.attempt([&] {
    if (is_chosen(config.loop_closer)) (void)build_loop_closer(mission, library, built.loop_closer_calls);
  });
  errors.attempt([&] {
    if (!config.map.name.empty()) built.mapper = build_mapper(mission, library);
  });
  errors.attempt([&] {
    if (config.detector.name.empty() || !built.mapper) return;
    Mission ideal = mission;
    ideal.template_settings.rendering = Rendering::ideal;
    add_detector(ideal, library, built.mapper->grid().cell_m(), built);
  });
  errors.attempt([&] { (void)build_marker_detector(mission, library); });
  errors.attempt([&] {
    if (!config.planner.name.empty()) (void)build_planner(mission, library);
  });
  errors.attempt([&] { (void)build_controller(mission, library); });
  for (const ConfigError& error : missing_inputs(mission.steps, library)) errors.add(error.what());
  for (const TreeNode* node : behaviours_of(mission.steps))
    errors.attempt([&] { (void)build_behaviour(mission, library, *node); });
  return std::move(errors).take();
}

void check_orders(const std::vector<RecordedOrder>& orders, const Mission& mission, const ModuleLibrary& library) {
  for (const RecordedOrder& recorded : orders) {
    const Order& order = recorded.order;
    if (order.kind == "stop" || order.kind == "finish") continue;
    TreeNode step;
    step.choice = {order.kind, order.settings};
    step.place = order.settings.place;
    (void)build_behaviour(mission, library, step);
  }
}

}  // namespace cairn
