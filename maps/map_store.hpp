// The saved map: one SQLite 3 file (application_id "CRN1", user_version = schema version).
//
// save_map replaces the file in one step: after a kill at any moment it holds the old or the new
// content, never a mixture. The same SavedMap gives the same bytes, whatever the file held before.
// load_map checks every checksum and every value, and never returns half a map.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "maps/cluster_tree.hpp"
#include "maps/landmark_graph.hpp"
#include "maps/landmark_template.hpp"
#include "maps/occupancy_grid.hpp"

namespace cairn {

inline constexpr int kMapSchemaVersion = 3;

class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SavedMap {
  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  ClusterTree clusters;
  std::vector<LandmarkShape> shapes;              // the categories the map was made with
  std::vector<Pose2> driven_path;                 // estimated poses, thinned
  std::map<std::string, std::string> properties;  // mission, seed, robot_radius_m, ...
};

// Throws StoreError with the file and the reason when it cannot be written, or is there already and is
// no SQLite file; std::invalid_argument when the map would not load again (a value that is not finite).
// In both cases what the file held stays.
void save_map(const std::filesystem::path& file, const SavedMap& map);
// Throws StoreError with the file, the table and what is wrong.
[[nodiscard]] SavedMap load_map(const std::filesystem::path& file);

}  // namespace cairn
