// Faults of the simulated robot, as its settings list them.
#pragma once

#include <optional>
#include <vector>

#include "framework/config/fields.hpp"
#include "framework/files/fault_rates.hpp"

namespace cairn {

enum class DeadReading { no_echo, nothing };
enum class Wheel { left, right, both };
enum class RingPart { none, whole, left, right };

struct StuckConfig {
  int sonar = 0;
  std::optional<double> range_m;  // none: its last reading
  static void describe(Fields<StuckConfig>& fields);
};

struct SlipConfig {
  Wheel wheel = Wheel::both;
  double ratio = 0.5;
  static void describe(Fields<SlipConfig>& fields);
};

struct KidnapConfig {
  Point to_m{0.0, 0.0};
  std::optional<double> angle_rad;  // none: as it was turned
  static void describe(Fields<KidnapConfig>& fields);
};

// One fault: exactly one of dead, deaf, stuck, slip, compass_jump, silent and kidnap.
struct FaultConfig {
  double at_s = 0.0;
  std::optional<double> for_s;  // none: for ever
  std::vector<double> dead;     // whole numbers
  DeadReading reads = DeadReading::no_echo;
  RingPart deaf = RingPart::none;  // becomes a list of dead ones
  std::optional<StuckConfig> stuck;
  std::optional<SlipConfig> slip;
  std::optional<double> compass_jump_rad;
  bool silent = false;
  std::optional<KidnapConfig> kidnap;
  SourcePlace place;  // in the file; none of a random fault
  static void describe(Fields<FaultConfig>& fields);
};

struct RandomFaultsConfig {
  FaultRates per_hour;
  double for_s = 10.0;
  static void describe(Fields<RandomFaultsConfig>& fields);
};

// Throws ConfigError where an item of the list holds what its fields alone do not rule out, and notes the places.
void check_faults(std::vector<FaultConfig>& faults, const ConfigValue& list);

}  // namespace cairn
