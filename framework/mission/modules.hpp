// The modules of one mission, built in the order in which they need each other.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/marker_detector.hpp"
#include "framework/mission/loop_closing.hpp"
#include "framework/mission/mission.hpp"
#include "framework/mission/orders/order_text.hpp"
#include "framework/modules/module_library.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

// A run that leaves its map alone: what the localizer begins with.
struct LocalizerStart {
  Pose2 T_map_start;
  StartUncertainty uncertainty;
  const KeptSubmaps* saved_submaps = nullptr;  // of the map that the pose is in
};

// What a run can go on with of the map's submaps; null: there are none, or there is a fault in them (fault_of()).
[[nodiscard]] const KeptSubmaps* usable_submaps(const SavedMap* map);

struct MissionModules {
  std::shared_ptr<Sensor> sensor;
  std::shared_ptr<Localizer> localizer;
  std::shared_ptr<CallsUnderWay> loop_closer_calls =
      std::make_shared<CallsUnderWay>(0);  // by localizers of the mission
  std::shared_ptr<Mapper> mapper;
  std::shared_ptr<const TemplateSet> templates;        // null without a detector
  std::shared_ptr<Detector> detector;                  // may be null
  std::shared_ptr<MarkerDetector> marker_detector;     // may be null
  std::shared_ptr<Planner> planner;                    // may be null
  std::shared_ptr<Controller> controller;              // null when the default one is not installed
  std::vector<std::shared_ptr<Behaviour>> behaviours;  // in the order of behaviours_of()
  std::shared_ptr<Behaviour> find_myself;              // for a robot that was carried; may be null
  Pose2 T_map_start;
  double begin_s = 0.0;  // the mission's clock
};

// The behaviour that drives a robot that does not know where it is.
inline constexpr const char* kFindMyself = "find_myself";

// Of making modules, which may wait.
struct BuildOptions {
  const std::atomic<bool>* cancel = nullptr;                   // ends what is under way: a log that is read, a wait
  std::function<void(const std::string& sentence)> on_wait{};  // what is waited for, by another thread
};

// resume: the map to go on from, or null. start: where the robot is said to be, whatever the sensor or that map says;
// without resume, of a run that leaves its map alone, which needs no detector, and whose mapper begins with nothing.
// Throws ConfigError or ModuleFault; StoreError when the map does not fit.
[[nodiscard]] MissionModules build_modules(const Mission& mission, const ModuleLibrary& library,
                                           const SavedMap* resume = nullptr, const BuildOptions& options = {},
                                           const std::optional<LocalizerStart>& start = std::nullopt);

// The mission's localizer alone, with a loop closer when it takes one, whose calls are counted.
[[nodiscard]] std::shared_ptr<Localizer> build_localizer(const Mission& mission, const ModuleLibrary& library,
                                                         const LocalizerStart& start,
                                                         std::shared_ptr<CallsUnderWay> loop_closer_calls);

// The mission's map module alone. grid_so_far: what it begins with, or null.
[[nodiscard]] std::shared_ptr<Mapper> build_map(const Mission& mission, const ModuleLibrary& library,
                                                const OccupancyGrid* grid_so_far);

// What is wrong with the mission's modules and their settings, each as `cairn run` would report the first: every module
// is made once. Costs no rendering of templates.
[[nodiscard]] std::vector<std::string> check_modules(const Mission& mission, const ModuleLibrary& library);

// Throws ConfigError when an order has settings that its step does not take.
void check_orders(const std::vector<RecordedOrder>& orders, const Mission& mission, const ModuleLibrary& library);

// Templates as the mission's detector gets them: rendered for the mission's cell size, or taken from the
// user's cache.
[[nodiscard]] TemplateSet render_templates(const Mission& mission, double cell_m, const ModuleLibrary& modules);

// The mission's detector alone, with its templates for grids of this cell size. Throws ConfigError or
// ModuleFault.
[[nodiscard]] std::shared_ptr<Detector> build_detector(const Mission& mission, const ModuleLibrary& library,
                                                       double cell_m);

// The mission's sensor alone, from the mission's start.
[[nodiscard]] std::shared_ptr<Sensor> build_sensor(const Mission& mission, const ModuleLibrary& library);

// A seed of its own for each module of a mission.
[[nodiscard]] std::uint64_t module_seed(std::int64_t mission_seed, PluginKind kind, std::size_t index = 0);

}  // namespace cairn
