#include "plugins/odometry_compass/config.hpp"

namespace cairn::odometry_compass {

void Config::describe(Fields<Config>& fields) {
  fields.number("start_position_m", &Config::start_position_m, {0.0, 100.0}, "m",
                "standard deviation of the start position, in x and in y");
  fields.angle("start_heading_deg", &Config::start_heading_rad, {0.0, 180.0},
               "standard deviation of the start heading");
  fields.number("min_distance_ratio", &Config::min_distance_ratio, {0.0, 1.0}, "",
                "least odometry error, of the distance driven and independent from metre to metre, along and across");
  fields.angle("min_heading_deg_per_m", &Config::min_heading_rad_per_m, {0.0, 45.0},
               "least odometry error of the heading, each metre");
  fields.number("turn_as_distance_m_per_rad", &Config::turn_as_distance_m_per_rad, {0.0, 10.0}, "m/rad",
                "driven distance that a turn in place counts as for the heading error of the odometry");
  fields.flag("use_compass", &Config::use_compass, "false: odometry and landmarks only");
  fields.angle("min_compass_noise_deg", &Config::min_compass_noise_rad, {0.01, 90.0},
               "least standard deviation of one compass reading");
  fields.number("local_bias_ratio", &Config::local_bias_ratio, {0.0, 1.0}, "",
                "standard deviation of the compass's local bias over the bound that the robot's file gives");
  fields.angle("unstated_bias_deg", &Config::unstated_bias_rad, {0.0, 90.0},
               "standard deviation of the compass's local bias that a second tracker allows for where the robot's file "
               "gives none: walls decide which one is right; 0: there is no second tracker");
  fields.number("compass_gate_sigmas", &Config::compass_gate_sigmas, {1.0, 100.0}, "",
                "compass readings further off than this many standard deviations are refused");
  fields.number("compass_drift_sigmas", &Config::compass_drift_sigmas, {1.0, 100.0}, "",
                "when the compass and the heading part, little by little, by so many standard deviations of the last "
                "readings' mean, the heading is the suspect: wheels slip");
  fields.number("compass_jump_sigmas", &Config::compass_jump_sigmas, {1.0, 100.0}, "",
                "what the compass turns more than the wheels from one reading to the next, by so many standard "
                "deviations, is a disturbance: what it reads then is refused while it is beyond the gate");
  fields.number("compass_refused_at_most_s", &Config::compass_refused_at_most_s, {0.0, 1e6}, "s",
                "after so long beyond the gate the compass is believed nevertheless, and the heading is the suspect");
  fields.flag("bound_bias", &Config::bound_bias,
              "the compass's local bias is kept within the bound that the robot's file gives");
  fields.flag("use_walls", &Config::use_walls, "straight walls that sonars meet again correct the pose");
  fields.number("wall_gate_sigmas", &Config::wall_gate_sigmas, {1.0, 100.0}, "",
                "known walls further off than this (Mahalanobis distance) are refused");
  fields.flag("use_landmarks", &Config::use_landmarks, "known landmarks that are seen again correct the pose");
  fields.number("landmark_noise_m", &Config::landmark_noise_m, {0.0, 10.0}, "m",
                "added to every landmark sighting: how well the map knows where the landmark is");
  fields.number("landmark_gate_sigmas", &Config::landmark_gate_sigmas, {1.0, 100.0}, "",
                "landmark sightings further off than this (Mahalanobis distance) are refused");
  fields.flag("use_landmark_heading", &Config::use_landmark_heading,
              "correct the heading by the landmark's orientation too, as far as the sighting knows it");
  fields.integer("landmark_refusals", &Config::landmark_refusals, {1, 1000000},
                 "after so many refusals in a row that agree, sightings are believed and the position is the suspect");
  fields.number("refusals_agree_m", &Config::refusals_agree_m, {0.0, 10.0}, "m",
                "refused sightings agree when they would move the robot to within this of each other");
}

}  // namespace cairn::odometry_compass
