#include "plugins/baselines/bayes_map/config.hpp"

namespace cairn::bayes_map {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 1.0}, "m", "side of a cell of OG1");
  fields.number("clamp_nat", &Config::clamp_nat, {0.5, 100.0}, "nat",
                "bound of a cell's log-odds: how certain a cell may get, and so how fast it can be corrected");
  sonar_model::describe_beam_model(fields);
}

}  // namespace cairn::bayes_map
