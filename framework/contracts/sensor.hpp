// Sensor: the source of observations; a source that moves is also driven.
#pragma once

#include "framework/contracts/budget.hpp"
#include "framework/contracts/module_context.hpp"
#include "framework/contracts/observation.hpp"

namespace cairn {

class GroundTruthSource;
class MissionDisplay;
struct World;

// The wheels. They stop by themselves: a command counts for a time only, so that a robot stands whose software hangs or
// dies.
class Drive {
 public:
  virtual ~Drive() = default;
  // Wanted velocity from now on, within the robot's limits, for at most valid_for_s (> 0) of the source's own time:
  // when no other command has come by then, the wheels stop. What is not finite is refused by an exception or ignored.
  // Hot: no allocation.
  virtual void command(const Twist& twist, double valid_for_s) = 0;
  // Stops the wheels; the next command() drives again. From any thread, also while next() or command() does not return,
  // and from a signal handler: no lock, no allocation, returns at once.
  virtual void stop() noexcept = 0;
};

class Sensor {
 public:
  virtual ~Sensor() = default;
  // The next observation in order of time, or end of data, or a fault with its reason.
  virtual SensorStep next(const Budget& budget) = 0;
  // The wheels behind this source; null for a log.
  virtual Drive* drive() { return nullptr; }
  // The first pose in the map frame when the source knows it (a log with poses).
  [[nodiscard]] virtual std::optional<Pose2> start() const { return std::nullopt; }
  // Where it really is, for reports (framework/contracts/ground_truth.hpp); null when the source never knows.
  [[nodiscard]] virtual const GroundTruthSource* truth() const { return nullptr; }
  // Where it shows the mission to people (framework/contracts/optional/mission_display.hpp); null when it cannot. Part
  // of the sensor.
  [[nodiscard]] virtual MissionDisplay* display() { return nullptr; }
};

struct SensorContext : ModuleContext {
  const World* world = nullptr;  // simulation only
  Pose2 T_map_start{};           // where the mission says the robot begins
  double begin_s = 0.0;          // the mission's clock as this run begins: not 0 when it goes on from a saved map
  Budget budget{};               // of making the sensor: who reads a file looks at it at least once a MiB
  bool wants_images = false;     // something in the mission reads Observation::images; otherwise leave them out
};

template <>
struct PluginTraits<Sensor> {
  static constexpr PluginKind kKind = PluginKind::sensor;
  using Context = SensorContext;
};

}  // namespace cairn
