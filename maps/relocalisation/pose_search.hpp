// Where in a saved map could the robot be? Searches the whole of it for the poses at which what the robot has seen
// around itself fits: echoes on what is occupied, free places on what is free, the robot itself on a free place.
//
// Correlative, by branch and bound over fields of raster_m cells (maps/submaps/correlative_search.hpp), then aligned
// with the map's surfaces. The score of a pose is the mean likelihood of all points there, from 0 to 1. Deterministic;
// const calls are thread-safe. Building it costs O(cells), find() tens to hundreds of milliseconds.
#pragma once

#include <optional>
#include <vector>

#include "maps/relocalisation/surroundings.hpp"
#include "maps/submaps/correlative_search.hpp"
#include "maps/submaps/surface_map.hpp"

namespace cairn {

struct PoseSearchSettings {
  double raster_m = 0.1;
  double sigma_m = 0.1;  // of echoes, around what is occupied
  DistinctRules distinct{.min_score = 0.5, .min_of_best_ratio = 0.85, .apart_m = 1.0, .apart_rad = radians(30.0)};
  double min_corner_ratio = 0.1;   // of what the echoes say of the worst known direction, over the best known
  double min_matched_ratio = 0.3;  // of the echoes: near a line of the map
  double beside_m = 0.5;
  double beside_rad = radians(10.0);
};

// A heading of the robot in the map, as a compass knows it: within the angle, for certain.
struct KnownHeading {
  double heading_rad = 0.0;
  double within_rad = 0.5;
};

struct PoseHypothesis {
  Pose2 T_map_robot;
  double score = 0.0;
  // Whether walls of two directions, or something as good, hold the pose in all directions: false in a bare corridor.
  bool is_held_by_corners = false;
  // Of all points: echoes in the open of the map, at least three sigmas from what is occupied, and free places on what
  // is occupied.
  double contradicted_ratio = 0.0;
};

class PoseSearch {
 public:
  explicit PoseSearch(const OccupancyGrid& map, const PoseSearchSettings& settings = {});

  // Distinct poses, best first; none when nothing fits, or when nothing has been seen.
  [[nodiscard]] std::vector<PoseHypothesis> find(const Surroundings& surroundings,
                                                 const std::optional<KnownHeading>& heading = std::nullopt) const;

  // How well what has been seen fits where the robot is believed to be: the best pose within settings.beside_m and
  // beside_rad of there, which odometry and compass may be off by after some metres. Score 0 where nothing fits.
  [[nodiscard]] PoseHypothesis at(const Surroundings& surroundings, const Pose2& T_map_robot) const;

 private:
  [[nodiscard]] double contradicted_ratio(const Surroundings& surroundings, const Pose2& T_map_robot) const;
  [[nodiscard]] PoseHypothesis aligned(const ScanMatch& match, const Surroundings& surroundings) const;

  PoseSearchSettings settings_;
  FieldPyramid occupied_;
  FieldPyramid free_;
  SurfaceMap surfaces_;
  Point middle_m_{0.0, 0.0};
  double half_side_m_ = 0.0;
};

}  // namespace cairn
