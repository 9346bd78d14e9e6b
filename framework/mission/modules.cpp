#include "framework/mission/modules.hpp"

#include "framework/behaviour_tree/parameters.hpp"
#include "framework/mission/resume.hpp"
#include "framework/modules/fence.hpp"
#include "framework/templates/sensed_templates.hpp"
#include "maps/base/portable_random.hpp"
#include "maps/base/text.hpp"

namespace cairn {
namespace {

template <class Interface>
std::shared_ptr<Interface> build(const ModuleLibrary& library, const PluginChoice& choice,
                                 const ModuleContext& context) {
  return fenced_making(choice.name, [&] { return library.make<Interface>(choice, context); });
}

ModuleContext context_for(const Mission& mission, const ModuleLibrary& library, const MissionModules& built,
                          PluginKind kind, std::size_t index = 0) {
  ModuleContext context{mission.robot};
  context.world = mission.world ? &*mission.world : nullptr;
  context.T_map_start = built.T_map_start;
  context.seed = module_seed(mission.config.seed, kind, index);
  context.templates = built.templates;
  context.modules = &library;
  for (const LandmarkShape& shape : mission.shapes) context.categories.push_back(shape.category);
  context.begin_s = built.begin_s;
  return context;
}

void add_detector(const Mission& mission, const ModuleLibrary& library, double cell_m, MissionModules& built) {
  const PluginChoice& detector = mission.config.detector;
  (void)library.find(PluginKind::detector, detector.name, detector.config.place);
  built.templates = std::make_shared<TemplateSet>(
      fenced_making(mission.config.map.name, [&] { return render_templates(mission, cell_m, library); }));
  built.detector = build<Detector>(library, detector, context_for(mission, library, built, PluginKind::detector));
}

// What is no behaviour may be meant for a node.
[[noreturn]] void fail_unknown(const ModuleLibrary& library, const TreeNode& node) {
  std::vector<std::string> known;
  for (const ModuleEntry& entry : library.entries())
    if (entry.module->kind == PluginKind::behaviour) known.push_back(entry.module->name);
  const std::vector<std::string> nodes = node_names();
  std::vector<std::string> names = known;
  names.insert(names.end(), nodes.begin(), nodes.end());
  std::string sentence = "unknown behaviour plugin " + shown(node.choice.name) + did_you_mean(node.choice.name, names) +
                         "; known are: " + (known.empty() ? "none" : joined(known)) +
                         "; and these nodes: " + joined(nodes);
  for (const std::string& fault : library.faults()) sentence += "\n  not loaded: " + fault;
  throw ConfigError(node.place, sentence);
}

std::shared_ptr<Behaviour> build_behaviour(const ModuleLibrary& library, const TreeNode& node,
                                           const ModuleContext& context) {
  if (library.find_any(node.choice.name) == nullptr) fail_unknown(library, node);
  try {
    return build<Behaviour>(library, node.choice, context);
  } catch (const ConfigError& error) {
    // A module knows no place for a setting that is not there.
    const std::string text = error.what();
    if (text.starts_with(": ")) throw ConfigError(node.place, text.substr(2));
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

Pose2 start_of(const MissionConfig& config) {
  return {config.start.at_m.x(), config.start.at_m.y(), config.start.angle_rad};
}

std::shared_ptr<Mapper> mapper_that_goes_on(const ModuleLibrary& library, const PluginChoice& map,
                                            ModuleContext context, const Mapper& empty, const OccupancyGrid& saved) {
  check_same_cells(saved, fenced("map", map.name, [&]() -> const OccupancyGrid& { return empty.grid(); }));
  context.grid_so_far = &saved;
  std::shared_ptr<Mapper> mapper = build<Mapper>(library, map, context);
  if (fenced("map", map.name, [&]() -> const OccupancyGrid& { return mapper->grid(); }) != saved)
    throw StoreError("cannot go on with this mission: its map module " + map.name +
                     " does not begin with a grid that is given to it");
  return mapper;
}

}  // namespace

std::uint64_t module_seed(std::int64_t mission_seed, PluginKind kind, std::size_t index) {
  return mixed_seed(static_cast<std::uint64_t>(mission_seed) * 1000003U + static_cast<std::uint64_t>(kind) * 101U +
                    index);
}

TemplateSet render_templates(const Mission& mission, double cell_m, const ModuleLibrary& modules) {
  const TemplateSettings& config = mission.template_settings;
  if (mission.shapes.empty() || config.rendering == Rendering::ideal || mission.robot.sonars.empty())
    return render_ideal_set(mission.shapes, config.step_rad, cell_m, config.sizes);
  PluginChoice simulator{"simulated_robot", {}};
  simulator.config.kind = ConfigValue::Kind::map;
  simulator.config.place = mission.config.sensor.config.place;
  if (mission.config.sensor.name == simulator.name) simulator = mission.config.sensor;
  SensedOptions options;
  options.sizes = config.sizes;
  return render_sensed_set(mission.shapes, config.step_rad, cell_m, options, mission.robot, simulator,
                           mission.config.map, modules, TemplateCache(template_cache_folder()));
}

std::shared_ptr<Detector> build_detector(const Mission& mission, const ModuleLibrary& library, double cell_m) {
  MissionModules built;
  built.T_map_start = start_of(mission.config);
  add_detector(mission, library, cell_m, built);
  return built.detector;
}

MissionModules build_modules(const Mission& mission, const ModuleLibrary& library, const SavedMap* resume) {
  const MissionConfig& config = mission.config;
  MissionModules built;
  built.T_map_start = start_of(config);
  if (resume != nullptr) {
    check_resumable(*resume, mission);
    built.begin_s = resume->progress->time_s + paused_before(*resume);
    // A simulated robot stands where it really was; what knows of it begins where it was thought to be.
    built.T_map_start = resume->progress->true_T_map_robot.value_or(resume->progress->T_map_robot);
  }
  const auto context = [&](PluginKind kind, std::size_t index = 0) {
    return context_for(mission, library, built, kind, index);
  };
  built.sensor = build<Sensor>(library, config.sensor, context(PluginKind::sensor));
  check_has_steps(config, mission.steps, *built.sensor);
  const auto start = fenced("sensor", config.sensor.name, [&] { return built.sensor->start(); });
  if (start) built.T_map_start = *start;
  if (resume != nullptr) built.T_map_start = resume->progress->T_map_robot;
  built.localizer = build<Localizer>(library, config.localizer, context(PluginKind::localizer));
  built.mapper = build<Mapper>(library, config.map, context(PluginKind::map));
  if (resume != nullptr)
    built.mapper = mapper_that_goes_on(library, config.map, context(PluginKind::map), *built.mapper, resume->grid);
  if (!config.detector.name.empty()) add_detector(mission, library, built.mapper->grid().cell_m(), built);
  if (!config.planner.name.empty())
    built.planner = build<Planner>(library, config.planner, context(PluginKind::planner));
  for (const TreeNode* node : behaviours_of(mission.steps))
    built.behaviours.push_back(
        build_behaviour(library, *node, context(PluginKind::behaviour, built.behaviours.size())));
  return built;
}

std::vector<std::string> check_modules(const Mission& mission, const ModuleLibrary& library) {
  std::vector<std::string> errors;
  const auto attempt = [&](auto make) {
    try {
      make();
    } catch (const ConfigError& error) {
      errors.emplace_back(error.what());
    } catch (const ModuleFault& fault) {
      errors.emplace_back(fault.what());
    }
  };
  const MissionConfig& config = mission.config;
  MissionModules built;
  built.T_map_start = start_of(config);
  const auto context = [&](PluginKind kind, std::size_t index = 0) {
    return context_for(mission, library, built, kind, index);
  };
  attempt([&] {
    const auto sensor = build<Sensor>(library, config.sensor, context(PluginKind::sensor));
    check_has_steps(config, mission.steps, *sensor);
  });
  attempt([&] { (void)build<Localizer>(library, config.localizer, context(PluginKind::localizer)); });
  attempt([&] { built.mapper = build<Mapper>(library, config.map, context(PluginKind::map)); });
  attempt([&] {
    if (config.detector.name.empty() || !built.mapper) return;
    Mission ideal = mission;
    ideal.template_settings.rendering = Rendering::ideal;
    add_detector(ideal, library, built.mapper->grid().cell_m(), built);
  });
  attempt([&] {
    if (!config.planner.name.empty()) (void)build<Planner>(library, config.planner, context(PluginKind::planner));
  });
  for (const TreeNode* node : behaviours_of(mission.steps))
    attempt([&] { (void)build_behaviour(library, *node, context(PluginKind::behaviour)); });
  return errors;
}

}  // namespace cairn
