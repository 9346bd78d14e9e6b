// What a module registers: named factories with their settings described, one a plugin.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/contracts/behaviour.hpp"
#include "framework/contracts/controller.hpp"
#include "framework/contracts/detector.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/contracts/mapper.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/contracts/sensor.hpp"
#include "framework/contracts/world.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn {

// New kinds are added at the end: the seeds of modules depend on the number of their kind.
enum class PluginKind { sensor, localizer, map, detector, planner, behaviour, controller };
// All of them, in the order in which people read them.
inline constexpr PluginKind kPluginKinds[] = {PluginKind::sensor,   PluginKind::localizer, PluginKind::map,
                                              PluginKind::detector, PluginKind::planner,   PluginKind::controller,
                                              PluginKind::behaviour};
[[nodiscard]] std::string_view name_of(PluginKind kind);

template <class Interface>
[[nodiscard]] constexpr PluginKind kind_of() {
  if constexpr (std::is_same_v<Interface, Sensor>) return PluginKind::sensor;
  if constexpr (std::is_same_v<Interface, Localizer>) return PluginKind::localizer;
  if constexpr (std::is_same_v<Interface, Mapper>) return PluginKind::map;
  if constexpr (std::is_same_v<Interface, Detector>) return PluginKind::detector;
  if constexpr (std::is_same_v<Interface, Planner>) return PluginKind::planner;
  if constexpr (std::is_same_v<Interface, Behaviour>) return PluginKind::behaviour;
  if constexpr (std::is_same_v<Interface, Controller>) return PluginKind::controller;
}

struct ModuleContext;

// Makes modules by name; the only way for one module to use another (a hybrid planner its router).
class ModuleMaker {
 public:
  virtual ~ModuleMaker() = default;
  template <class Interface>
  [[nodiscard]] std::shared_ptr<Interface> make(const PluginChoice& choice, const ModuleContext& context) const {
    return std::static_pointer_cast<Interface>(make_any(kind_of<Interface>(), choice, context));
  }

 private:
  // Throws ConfigError on an unknown name (with the nearest one) or a bad field.
  [[nodiscard]] virtual std::shared_ptr<void> make_any(PluginKind kind, const PluginChoice& choice,
                                                       const ModuleContext& context) const = 0;
};

// What a factory may use. References are valid during the call only: copy what you keep.
struct ModuleContext {
  const RobotModel& robot;
  const World* world = nullptr;                    // simulation only
  Pose2 T_map_start{};                             // where the mission says the robot begins
  std::uint64_t seed = 1;                          // of this module alone
  std::shared_ptr<const TemplateSet> templates{};  // rendered; for detectors
  const ModuleMaker* modules = nullptr;
  // For maps: what an earlier run of the mission has mapped, with the cells, origin and clamp that the settings give.
  // The new map begins with it. Null: with nothing.
  const OccupancyGrid* grid_so_far = nullptr;
  // The mission's clock as this run begins: not 0 when it goes on from a saved map. For simulations.
  double begin_s = 0.0;
  std::vector<std::string> categories{};  // of landmarks that the mission can find; empty: not known
};

struct RegisteredModule {
  PluginKind kind = PluginKind::sensor;
  std::string name;
  std::string summary;
  Schema schema;
  std::function<std::shared_ptr<void>(const ConfigValue& config, const ModuleContext& context)> make;
};

class Registrar {
 public:
  // make: (const Config&, const ModuleContext&) -> std::unique_ptr of something that is an Interface.
  template <class Interface, class Config, class Make>
  void add(std::string name, std::string summary, Make make) {
    RegisteredModule module;
    module.kind = kind_of<Interface>();
    std::string what = "plugin " + name;
    module.name = std::move(name);
    module.summary = std::move(summary);
    module.schema = schema_of<Config>();
    module.make = [make = std::move(make), schema = module.schema, what = std::move(what)](
                      const ConfigValue& value, const ModuleContext& context) -> std::shared_ptr<void> {
      Config config;
      schema.load_into(&config, value, what);
      std::unique_ptr<Interface> object = make(static_cast<const Config&>(config), context);
      if (!object) throw std::logic_error(what + ": its factory made nothing");
      return std::shared_ptr<Interface>(std::move(object));
    };
    modules_.push_back(std::move(module));
  }

  [[nodiscard]] const std::vector<RegisteredModule>& modules() const { return modules_; }

 private:
  std::vector<RegisteredModule> modules_;
};

// For modules without settings.
struct NoConfig {
  static void describe(Fields<NoConfig>&) {}
};

}  // namespace cairn
