#include "plugins/bayes_map/config.hpp"

namespace cairn::bayes_map {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 1.0}, "m", "side of a cell of OG1");
  fields.number("clamp_nat", &Config::clamp_nat, {0.5, 100.0}, "nat",
                "bound of a cell's log-odds: how certain a cell may get, and so how fast it can be corrected");
  fields.number("alpha_max", &Config::alpha_max, {0.01, 0.99}, "",
                "chance that a target on the axis, close by, echoes");
  fields.number("alpha_range_m", &Config::alpha_range_m, {0.1, 100.0}, "m",
                "range at which that chance has fallen to 0; cells beyond learn nothing");
  fields.number("delta_m", &Config::delta_m, {0.001, 1.0}, "m", "range error at range 0, standard deviation");
  fields.number("delta_per_m", &Config::delta_per_m, {0.0, 0.3}, "", "what the range error grows by each metre");
  fields.number("false_echo_per_m", &Config::false_echo_per_m, {0.01, 100.0}, "1/m",
                "density F of echoes that come from anything else than the cell; smaller makes echoes count more");
}

}  // namespace cairn::bayes_map
