#include "plugins/submap_graph/config.hpp"

#include <string>

namespace cairn::submap_graph {

namespace {

void describe_scans(Fields<Config>& fields) {
  fields.number("longest_m", &Config::longest_m, {0.1, 1000.0}, "m", "echoes from farther away are left out");
  fields.number("point_spacing_m", &Config::point_spacing_m, {0.0, 10.0}, "m",
                "of a scan's echoes in one square of this side the first is used; 0: all");
  fields.angle("widest_half_beam_deg", &Config::widest_half_beam_rad, {0.0, 90.0},
               "readings of wider beams are left out: their echoes are no points");
  fields.number("sweep_s", &Config::sweep_s, {0.0, 60.0}, "s",
                "a laser that turns shows a part of its round in each observation: what comes in so much time is one "
                "scan, put together by odometry; 0: each observation is one");
}

void describe_matching(Fields<Config>& fields) {
  fields.number("surface_cell_m", &Config::surface_cell_m, {0.01, 10.0}, "m",
                "side of a submap's cells; the line of a cell is fitted to its echoes and its neighbours'");
  fields.number("echo_sigma_m", &Config::echo_sigma_m, {0.001, 10.0}, "m", "standard deviation of one echo");
  fields.number("search_m", &Config::search_m, {0.0, 10.0}, "m",
                "a scan is also searched for so far around where odometry puts it");
  fields.angle("search_deg", &Config::search_rad, {0.0, 180.0}, "the same for the heading");
  fields.number("search_sigma_m", &Config::search_sigma_m, {0.01, 10.0}, "m",
                "there: of the likelihood of an echo by its distance to the submap's nearest one");
  fields.number("odometry_ratio", &Config::odometry_ratio, {0.001, 10.0}, "",
                "standard deviation of a step of odometry, of its length");
  fields.angle("odometry_deg_per_m", &Config::odometry_rad_per_m, {0.01, 180.0},
               "standard deviation of a step's turn, each metre");
  fields.number("odometry_turn_ratio", &Config::odometry_rad_per_rad, {0.001, 10.0}, "",
                "standard deviation of a step's turn, of the turn");
  fields.number("odometry_turn_bias_ratio", &Config::odometry_turn_bias_ratio, {0.0, 1.0}, "",
                "with gather_m: standard deviation of what the wheels count too much of each turn over the whole run; "
                "it is found with the poses; 0: nothing");
  fields.number("odometry_length_bias_ratio", &Config::odometry_length_bias_ratio, {0.0, 1.0}, "",
                "the same of lengths; only where markers close the loops: the robot's own drawings are as much too "
                "long as its way");
}

void describe_compass(Fields<Config>& fields) {
  fields.flag("use_compass", &Config::use_compass, "the headings of the pose graph's nodes are tied to the compass");
  fields.angle("min_compass_noise_deg", &Config::min_compass_noise_rad, {0.1, 90.0},
               "standard deviation of a reading of the compass, at least: more where the robot's file says so");
  fields.angle("compass_bias_deg", &Config::compass_bias_rad, {0.1, 180.0},
               "standard deviation of the compass's bias of the whole run; it is found with the poses");
  fields.angle("min_compass_local_bias_deg", &Config::min_compass_local_bias_rad, {0.1, 90.0},
               "and of the bias that changes along the way, at least");
}

void describe_submaps(Fields<Config>& fields) {
  fields.number("node_m", &Config::node_m, {0.01, 100.0}, "m", "distance between two nodes of the pose graph");
  fields.angle("node_deg", &Config::node_rad, {0.1, 180.0}, "or turn between them");
  fields.number("submap_m", &Config::submap_m, {0.1, 1000.0}, "m",
                "way on which a submap is drawn; a turn of one radian counts as a metre");
  fields.number(
      "gather_m", &Config::gather_m, {0.0, 1000.0}, "m",
      "for sonars: a single scan is not matched, odometry counts from node to node; closures are searched with "
      "the echoes of so much of the way; 0: for lasers");
}

void describe_closures(Fields<Config>& fields) {
  fields.number(
      "drift_ratio", &Config::drift_ratio, {0.0, 1.0}, "",
      "drift of the pose since the last closure, of the way: the loop closer looks around so far, and closures "
      "may disagree");
  fields.number("witness_m", &Config::witness_m, {0.1, 1000.0}, "m",
                "a closure waits so far on the way for a second one that agrees");
  fields.integer("solve_every_nodes", &Config::solve_every_nodes, {1, 100000},
                 "nodes between two solutions of the pose graph");
}

void describe_moved(Fields<Config>& fields) {
  fields.moved("field_sigma_m",
               "`loop_closer.field_sigma_m`, and here `search_sigma_m` for the search around odometry");
  for (const char* key : {"min_window_m", "max_window_m", "window_deg", "min_score", "min_matched_ratio"})
    fields.moved(key, "`loop_closer." + std::string(key) + "`");
}

}  // namespace

void Config::describe(Fields<Config>& fields) {
  describe_scans(fields);
  describe_matching(fields);
  describe_compass(fields);
  describe_submaps(fields);
  describe_closures(fields);
  describe_moved(fields);
}

}  // namespace cairn::submap_graph
