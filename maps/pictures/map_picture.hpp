// A map as a PNG: OG1 with whatever is known on top of it, about 1000 pixels on its longer side unless asked otherwise.
//
// White is free, black occupied, grey unknown; y is up. What is not given is not drawn, and the legend
// names only what is. The same input gives the same bytes.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "maps/clustering/cluster_tree.hpp"
#include "maps/geometry/contour.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"

namespace cairn {

// A place with a few words beside it.
struct MarkedPlace {
  Point at_m{0.0, 0.0};
  std::string words;
};

// A rectangle along the axes of the map, and words in its middle.
struct MarkedArea {
  Point min_m{0.0, 0.0};
  Point max_m{0.0, 0.0};
  std::string words;
};

struct MapPicture {
  const OccupancyGrid* grid = nullptr;  // none or empty: a blank page
  const LandmarkGraph* graph = nullptr;
  const ClusterTree* clusters = nullptr;      // with any, dots are coloured by cluster
  std::vector<LandmarkShape> shapes;          // outlines of the graph's categories; a dot where there is none
  std::vector<std::vector<Point>> truth;      // walls and outlines of the true world, drawn under all but the grid
  std::vector<Point> driven;                  // in the map frame, as all below
  std::vector<Point> planned;                 // on top of the graph and its labels
  std::vector<LandmarkId> planned_landmarks;  // that the planned path passes: their labels come first
  // Of a world that changes: the leaves of its doors, and where its people and carts go.
  std::vector<std::vector<Point>> doors;
  std::vector<std::vector<Point>> mover_paths;
  std::vector<Pose2> robot_path;         // the robot's outline is drawn at both ends and some way apart between
  std::vector<MarkedArea> areas;         // tinted, over the truth
  std::vector<MarkedPlace> near_misses;  // something like a landmark, but not like enough
  std::optional<Point> start;
  std::optional<Point> goal;
  std::optional<Pose2> robot;
  double robot_radius_m = 0.0;
  std::vector<Point> robot_polygon_m;  // in the robot's frame, of robot_path; empty: a disc of that radius
  bool has_three_greys = false;        // free, unknown, occupied and nothing between: a small file
  std::string title;
  double longer_side_px = 930.0;  // of the map itself, about
};

// Throws std::runtime_error with the file and the reason when it cannot be written.
void write_map_picture(const std::filesystem::path& file, const MapPicture& picture);

}  // namespace cairn
