#include "plugins/baselines/himm_map/config.hpp"

namespace cairn::himm_map {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 1.0}, "m", "side of a cell of OG1");
  fields.integer("increment", &Config::increment, {1, 200}, "what an echo adds to the cell at its range");
  fields.integer("decrement", &Config::decrement, {1, 200}, "what a reading takes from each cell before its range");
  fields.integer("certainty_max", &Config::certainty_max, {1, 200}, "largest certainty value; the smallest is 0");
  fields.number("range_m", &Config::range_m, {0.1, 100.0}, "m",
                "how far a reading without an echo empties cells, unless the sensor's max_m is shorter");
  fields.flag("growth", &Config::growth,
              "growth rate operator: an echo also adds half the sum of the eight neighbours' certainties");
}

}  // namespace cairn::himm_map
