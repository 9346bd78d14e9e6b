// The pictures of a run: map.png (OG1, landmarks, graph, driven path), coarse.png (OG2), degrees.png (matching degrees
// over time), pose_error.png (error of the position over time, where the truth is known) and timeline.png (when each
// node of the tree ran).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/mission/runner.hpp"
#include "framework/reporting/report.hpp"
#include "maps/pictures/map_picture.hpp"
#include "maps/store/map_store.hpp"

namespace cairn {

struct RunPictures {
  std::vector<std::string> files;    // names in the folder
  std::vector<std::string> missing;  // sentences on those that could not be drawn
};

[[nodiscard]] RunPictures draw_run(const std::filesystem::path& out, const Mission& mission,
                                   const MissionRunner& runner, const MissionResult& result, const RunReport& report);

// A saved map with its landmarks, routes and driven path. Throws as write_map_picture() does.
void draw_saved_map(const std::filesystem::path& file, const SavedMap& map, const std::string& title);

// The true world below a map: its walls and objects, and what only those know who have made it.
struct DrawnTruth {
  const World* world = nullptr;
  std::vector<std::vector<Point>> doors;  // lines across them
  std::vector<MarkedArea> not_entered;    // rooms
};
// Small, in three greys, with the driven path only. Throws as write_map_picture() does.
void draw_over_truth(const std::filesystem::path& file, const SavedMap& map, const DrawnTruth& truth,
                     const std::string& title);

}  // namespace cairn
