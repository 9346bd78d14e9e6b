#include "plugins/scan_to_map/config.hpp"

namespace cairn::scan_to_map {

void Config::describe(Fields<Config>& fields) {
  fields.number("cell_m", &Config::cell_m, {0.005, 10.0}, "m",
                "side of a cell of the localizer's own map; echoes of one cell share its line");
  fields.number("range_noise_m", &Config::range_noise_m, {0.0001, 10.0}, "m", "standard deviation of one echo");
  fields.number("range_offset_m", &Config::range_offset_m, {-1.0, 1.0}, "m",
                "added to every echo's range here, but not in the mission's map: where walls need another range offset "
                "than landmarks, as of a laser that measures some surfaces too near");
  fields.number("pair_m", &Config::pair_m, {0.001, 100.0}, "m", "farther from its line than this, an echo is left out");
  fields.integer("iterations", &Config::iterations, {1, 1000}, "most steps of one correction");
  fields.integer("min_pairs", &Config::min_pairs, {3, 100000}, "with fewer echoes on lines, odometry alone");
  fields.number("beams_per_pair", &Config::beams_per_pair, {1.0, 100000.0}, "",
                "so many echoes of a scan count as one independent one: their errors are alike");
  fields.angle("widest_half_beam_deg", &Config::widest_half_beam_rad, {0.0, 90.0},
               "readings of wider beams are left out: their echoes are no points");
  fields.number("min_distance_ratio", &Config::min_distance_ratio, {0.0001, 1.0}, "",
                "least odometry error, of the distance driven, along and across");
  fields.angle("min_heading_deg_per_m", &Config::min_heading_rad_per_m, {0.01, 90.0},
               "least odometry error of the heading, each metre");
  fields.number("turn_as_distance_m_per_rad", &Config::turn_as_distance_m_per_rad, {0.0, 10.0}, "m/rad",
                "driven distance that a turn in place counts as for the errors of the odometry");
  fields.number("start_position_m", &Config::start_position_m, {0.0, 100.0}, "m",
                "standard deviation of the start position, in x and in y");
  fields.angle("start_heading_deg", &Config::start_heading_rad, {0.0, 180.0},
               "standard deviation of the start heading");
  fields.number("drift_ratio", &Config::drift_ratio, {0.0, 1.0}, "",
                "standard deviation that the map itself drifts by, of the distance driven");
}

}  // namespace cairn::scan_to_map
