#include "plugins/muriel/config.hpp"

#include "plugins/muriel/independence_log.hpp"

namespace cairn::muriel {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 1.0}, "m", "side of a cell of OG1");
  fields.number("clamp_nat", &Config::clamp_nat, {0.5, 100.0}, "nat",
                "bound of a cell's log-odds: how certain a cell may get, and so how fast it can be corrected");
  sonar_model::describe_beam_model(fields);
  fields.flag("specular", &Config::specular, "whether a reading counts less the more likely the map makes it specular");
  fields.number("specular_prior", &Config::specular_prior, {0.0, 0.99}, "", "share of specular readings, s0");
  fields.number("specular_per_m", &Config::specular_per_m, {0.001, 100.0}, "1/m", "density g of specular ranges");
  fields.integer("specular_sectors", &Config::specular_sectors, {1, kMaxSectors},
                 "angular sectors of a beam; only the best target of each counts");
  fields.number("believed_p", &Config::believed_p, {0.5, 0.99}, "",
                "from this probability on a cell is believed to be a target that should have answered");
  fields.choice("log", &Config::log,
                {{"off", LogPolicy::off}, {"paper", LogPolicy::paper}, {"counted", LogPolicy::counted}},
                "independence log of a cell: off; paper: one reading from each bearing; counted: log_readings from "
                "each, the later the less");
  fields.integer("log_bearings", &Config::log_bearings, {4, kMaxBearings},
                 "directions to a cell that its log distinguishes");
  fields.integer("log_readings", &Config::log_readings, {1, kMaxReadings},
                 "counted: readings from one bearing that a cell takes");
  fields.number("log_fall", &Config::log_fall, {0.0, 1.0}, "", "counted: weight of a reading against the one before");
}

}  // namespace cairn::muriel
