// The saved map: one SQLite 3 file (application_id "CRN1", user_version = schema version).
//
// save_map replaces the file in one step: after a kill at any moment it holds the old or the new
// content, never a mixture. The same SavedMap gives the same bytes, whatever the file held before.
// load_map checks every checksum and every value, and never returns half a map.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "maps/base/output_file.hpp"
#include "maps/clustering/cluster_tree.hpp"
#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_graph.hpp"
#include "maps/landmarks/landmark_template.hpp"
#include "maps/submaps/kept_submaps.hpp"

namespace cairn {

inline constexpr int kMapSchemaVersion = 2;  // the newest; without submaps and markers a map is written as 1

class StoreError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// How far the mission had come that made the map: what `cairn run --resume` goes on from.
struct MissionProgress {
  double time_s = 0.0;                    // of the mission's clock
  int step = 0;                           // under way, from 0; as many as the mission has: it has ended
  std::string step_name;                  // its behaviour; empty when the mission has ended
  Pose2 T_map_robot;                      // as estimated
  std::optional<Pose2> true_T_map_robot;  // simulation only
  double distance_m = 0.0;
  std::int64_t readings = 0;
  std::int64_t matchings = 0;
  std::int64_t collisions = 0;
  LandmarkGraph candidates;  // seen, but not often enough to be landmarks; ids of their own, no routes
  bool operator==(const MissionProgress&) const = default;
};

struct SavedMap {
  OccupancyGrid grid{0.05};
  LandmarkGraph graph;
  ClusterTree clusters;
  std::vector<LandmarkShape> shapes;              // the categories the map was made with
  std::vector<Pose2> driven_path;                 // estimated poses, thinned
  std::map<std::string, std::string> properties;  // mission, seed, robot_radius_m, ...
  std::optional<MissionProgress> progress;        // none: no mission made it
  KeptSubmaps submaps;                            // of laser SLAM; mostly none
};

// Throws StoreError with the file and the reason when it cannot be written, or is there already and is
// no saved map; std::invalid_argument when the map would not load again (a value that is not finite).
// In both cases what the file held stays. links: whether a symbolic link there is the map's name (its user has made it)
// or is replaced (in an output folder).
void save_map(const std::filesystem::path& file, const SavedMap& map, Links links = Links::follow);
// Throws StoreError with the file, the table and what is wrong.
[[nodiscard]] SavedMap load_map(const std::filesystem::path& file);

// A saved map of which only a part of the grid is read, for who needs no more of a large one. What is read is checked
// row by row as load_map does; the rest may be damaged. Keeps to the content that the file had when opened. Not
// thread-safe.
class MapFile {
 public:
  // Throws StoreError, like all below.
  explicit MapFile(const std::filesystem::path& file);
  MapFile(MapFile&&) noexcept;
  MapFile& operator=(MapFile&&) noexcept;
  ~MapFile();

  // The grid's lattice and its bounds, all unknown.
  [[nodiscard]] OccupancyGrid lattice() const;
  // All but the cells of the grid, which is lattice().
  [[nodiscard]] SavedMap without_cells() const;
  // The grid, unknown outside the box (cells), which its bounds do not exceed either.
  [[nodiscard]] OccupancyGrid grid_within(const CellBox& box) const;

 private:
  struct Opened;
  std::unique_ptr<Opened> opened_;
};

}  // namespace cairn
