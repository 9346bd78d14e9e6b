#include "plugins/simulated_robot/fault_config.hpp"

#include <cmath>

namespace cairn {
namespace {

void check_fault(FaultConfig& fault, const ConfigValue& value) {
  const std::string kind = config_detail::exactly_one_of(value, schema_of<FaultConfig>().one_of, "a fault");
  fault.place = value.place;
  if (kind == "silent" && !fault.silent)
    throw ConfigError(value.find("silent")->place, "silent: false is no fault; leave the fault out");
  if (kind == "dead" && fault.dead.empty())
    throw ConfigError(value.find("dead")->place, "dead must list at least one transducer");
  for (std::size_t i = 0; i < fault.dead.size(); ++i)
    if (fault.dead[i] != std::floor(fault.dead[i]))
      throw ConfigError(
          value.find("dead")->items[i].place,
          "each item of dead must be the number of a transducer, found " + config_detail::number_text(fault.dead[i]));
  if (const ConfigValue* reads = value.find("reads"); reads != nullptr && kind != "dead" && kind != "deaf")
    throw ConfigError(reads->place, "reads goes with dead and deaf");
  if (const ConfigValue* for_s = value.find("for_s"); for_s != nullptr && kind == "kidnap")
    throw ConfigError(for_s->place, "kidnap happens once, at at_s; for_s goes with the other faults");
}

}  // namespace

void StuckConfig::describe(Fields<StuckConfig>& fields) {
  fields.integer("sonar", &StuckConfig::sonar, {0, 1e6}, "which, by its number (from 0)").required = true;
  fields.number("range_m", &StuckConfig::range_m, {0.0, 1000.0}, "m", "what it reads; without it, its last reading");
}

void SlipConfig::describe(Fields<SlipConfig>& fields) {
  fields.choice("wheel", &SlipConfig::wheel, {{"left", Wheel::left}, {"right", Wheel::right}, {"both", Wheel::both}},
                "which slips; the wheels are 2 x radius_m apart");
  fields.number("ratio", &SlipConfig::ratio, {0.0, 1.0}, "", "share of its turning that moves nothing");
}

void KidnapConfig::describe(Fields<KidnapConfig>& fields) {
  fields.point("to_m", &KidnapConfig::to_m, "m", "where it is put down; nothing that stands may be there").required =
      true;
  fields.angle("angle_deg", &KidnapConfig::angle_rad, {-360.0, 360.0},
               "how it is turned then, anticlockwise; without it, as before");
}

void FaultConfig::describe(Fields<FaultConfig>& fields) {
  using C = FaultConfig;
  fields.number("at_s", &C::at_s, {0.0, 1e9}, "s", "when it begins, in seconds since the robot's start").required =
      true;
  fields.number("for_s", &C::for_s, {0.0, 1e9}, "s", "how long it lasts; without it, to the end");
  fields.numbers("dead", &C::dead, {0, 1e6}, "", "transducers that receive nothing, by their numbers (from 0)").type =
      "list of integers";
  fields.choice("reads", &C::reads, {{"no_echo", DeadReading::no_echo}, {"nothing", DeadReading::nothing}},
                "of dead ones: no_echo, as a ranger reports it that waits in vain, or no reading at all");
  fields.choice("deaf", &C::deaf, {{"whole", RingPart::whole}, {"left", RingPart::left}, {"right", RingPart::right}},
                "all transducers are dead, or those that look to that side, straight ahead and straight back included");
  fields.group("stuck", &C::stuck, "a transducer that reads the same all the time");
  fields.group("slip", &C::slip, "the odometry counts what the wheels turn, the robot goes less far");
  fields.angle("compass_jump_deg", &C::compass_jump_rad, {-180.0, 180.0}, "so much is added to what the compass reads");
  fields.flag("silent", &C::silent, "no ranges at all; clock and odometry go on");
  fields.group("kidnap", &C::kidnap, "the robot is carried elsewhere, of which its wheels know nothing");
  fields.one_of({"dead", "deaf", "stuck", "slip", "compass_jump_deg", "silent", "kidnap"});
}

void RandomFaultsConfig::describe(Fields<RandomFaultsConfig>& fields) {
  fields.group("per_hour", &RandomFaultsConfig::per_hour, "how often each kind strikes, on average");
  fields.number("for_s", &RandomFaultsConfig::for_s, {0.0, 1e6}, "s", "how long each lasts");
}

void check_faults(std::vector<FaultConfig>& faults, const ConfigValue& list) {
  for (std::size_t i = 0; i < faults.size(); ++i) check_fault(faults[i], list.items[i]);
}

}  // namespace cairn
