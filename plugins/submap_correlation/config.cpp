#include "plugins/submap_correlation/config.hpp"

namespace cairn::submap_correlation {

void Config::describe(Fields<Config>& fields) {
  fields.number("field_sigma_m", &Config::field_sigma_m, {0.01, 10.0}, "m",
                "of the likelihood of an echo by its distance to a submap's nearest one");
  fields.number("min_window_m", &Config::min_window_m, {0.1, 100.0}, "m",
                "half side of the least window; it grows by what the localizer may have drifted");
  fields.number("max_window_m", &Config::max_window_m, {0.1, 100.0}, "m", "and of the greatest");
  fields.angle("window_deg", &Config::window_rad, {0.1, 180.0},
               "half angle of the windows, where the localizer knows none");
  fields.number("min_score", &Config::min_score, {0.0, 1.0}, "",
                "mean likelihood of a node's echoes in a submap, from which on it is proposed");
  fields.number("min_matched_ratio", &Config::min_matched_ratio, {0.0, 1.0}, "",
                "and the part of them that must lie on its walls");
}

}  // namespace cairn::submap_correlation
