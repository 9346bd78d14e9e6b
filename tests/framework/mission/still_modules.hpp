// Modules that do nothing, linked in: what is left of a tick is the host's own work.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <utility>

#include "framework/contracts/marker_detector.hpp"
#include "framework/contracts/optional/marker_families.hpp"
#include "framework/mission/runner.hpp"
#include "framework/modules/module_library.hpp"

namespace cairn::still {

struct SensorConfig {
  int ticks = 1000;
  static void describe(Fields<SensorConfig>& fields) {
    fields.integer("ticks", &SensorConfig::ticks, {0.0, 1e9}, "observations before the data ends");
  }
};

// on_tick is called at the begin of each tick.
inline std::function<void(int)> on_tick;  // NOLINT: shared by the modules of one test program

inline std::function<void(const Twist&)> on_command;  // NOLINT: the same

// Whether there is a reading in each tick, that nothing is ahead: without one the stop layer lets nothing move.
inline bool sees_ahead = false;  // NOLINT: the same

inline RangeReading nothing_ahead() {
  RangeReading reading;
  reading.half_beam_rad = radians(15.0);
  reading.max_m = 5.0;
  reading.range_m = std::numeric_limits<double>::infinity();
  return reading;
}

class Sensor : public cairn::Sensor, public Drive {
 public:
  explicit Sensor(int ticks) : ticks_(ticks) {}
  SensorStep next(const Budget&) override {
    if (on_tick) on_tick(tick_);
    SensorStep step;
    if (tick_++ >= ticks_) return step;
    step.state = SensorState::observation;
    step.observation.stamp_s = 0.04 * tick_;
    if (sees_ahead) step.observation.ranges.push_back(nothing_ahead());
    return step;
  }
  Drive* drive() override { return this; }
  void command(const Twist& twist, double /*valid_for_s*/) override {
    if (on_command) on_command(twist);
  }
  void stop() noexcept override {}

 private:
  int ticks_;
  int tick_ = 0;
};

class Localizer : public cairn::Localizer {
 public:
  PoseEstimate update(const Observation&, const KnownMap&) override { return {}; }
};

class Mapper : public cairn::Mapper {
 public:
  const CellChanges& integrate(const Observation&, const PoseEstimate&) override { return changes_; }
  [[nodiscard]] const OccupancyGrid& grid() const override { return grid_; }

 private:
  OccupancyGrid grid_{0.1};
  CellChanges changes_;
};

class Detector : public cairn::Detector {
 public:
  DetectionReport detect(const OccupancyGrid&, const CellChanges&, const Budget&) override { return {}; }
};

class Behaviour : public cairn::Behaviour {
 public:
  Status tick(const WorldView&, BehaviourContext& orders) override {
    orders.drive({0.1, 0.0});
    return {};
  }
  void halt() override {}
};

// Looks for one small family of tags, and sees none.
class Tags : public MarkerDetector, public MarkerFamilies {
 public:
  std::vector<MarkerSighting> detect(std::span<const CameraImage>, const Budget&) override { return {}; }
  [[nodiscard]] std::vector<MarkerFamily> families() const override { return {MarkerFamily::tag25h9}; }
};

inline ModuleLibrary library() {
  Registrar registrar;
  registrar.add<cairn::Sensor, SensorConfig>(
      "still_sensor", "gives observations of nothing",
      [](const SensorConfig& config, const ModuleContext&) { return std::make_unique<Sensor>(config.ticks); });
  const auto plain = [&registrar]<class Interface, class Type>(const char* name, std::type_identity<Interface>,
                                                               std::type_identity<Type>) {
    registrar.add<Interface, NoConfig>(name, "does nothing",
                                       [](const NoConfig&, const ModuleContext&) { return std::make_unique<Type>(); });
  };
  plain("still_localizer", std::type_identity<cairn::Localizer>(), std::type_identity<Localizer>());
  plain("still_map", std::type_identity<cairn::Mapper>(), std::type_identity<Mapper>());
  plain("still_detector", std::type_identity<cairn::Detector>(), std::type_identity<Detector>());
  plain("still_tags", std::type_identity<MarkerDetector>(), std::type_identity<Tags>());
  registrar.add<cairn::Localizer, NoConfig>("still_refuser", "takes no settings",
                                            [](const NoConfig&, const ModuleContext&) -> std::unique_ptr<Localizer> {
                                              throw ConfigError({}, "these do not go together");
                                            });
  plain("still_step", std::type_identity<cairn::Behaviour>(), std::type_identity<Behaviour>());
  ModuleLibrary library({});
  library.add("(linked in)", registrar);
  return library;
}

// A mission of nothing but these modules.
inline Mission mission(int ticks) {
  Mission mission;
  mission.config.mission = "still";
  const auto choice = [](const char* name) {
    PluginChoice c{name, {}};
    c.config.kind = ConfigValue::Kind::map;
    return c;
  };
  mission.config.sensor = choice("still_sensor");
  ConfigValue::Entry& entry = mission.config.sensor.config.entries.emplace_back();
  entry.key = "ticks";
  entry.value.kind = ConfigValue::Kind::scalar;
  entry.value.scalar = std::to_string(ticks);
  mission.config.localizer = choice("still_localizer");
  mission.config.map = choice("still_map");
  mission.config.detector = choice("still_detector");
  mission.steps.push_back({NodeKind::behaviour, "still_step", choice("still_step"), "1"});
  mission.config.at_most_s = 1e9;
  return mission;
}

}  // namespace cairn::still
