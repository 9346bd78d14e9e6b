#include "plugins/baselines/murphy_map/config.hpp"

namespace cairn::murphy_map {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 1.0}, "m", "side of a cell of OG1");
  fields.number("clamp_nat", &Config::clamp_nat, {0.5, 100.0}, "nat", "bound of a cell's log-odds");
  fields.number("range_m", &Config::range_m, {0.1, 100.0}, "m",
                "R of the model, the range at which belief has fallen to 0; a shorter sensor's max_m takes its place");
  fields.number("tolerance_m", &Config::tolerance_m, {0.001, 10.0}, "m",
                "cells this near to the echo's range are region I (occupied), nearer ones region II (empty)");
  fields.number("max_occupied_p", &Config::max_occupied_p, {0.5, 0.999}, "",
                "the most that one echo makes anyone believe in an occupied cell");
  fields.flag("keep_sign", &Config::keep_sign,
              "far out and off the axis the textbook's belief falls below one half and so says the opposite; true "
              "makes such a cell learn nothing");
}

}  // namespace cairn::murphy_map
