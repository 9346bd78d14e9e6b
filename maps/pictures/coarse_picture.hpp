// OG2 as a PNG: one grey block a coarse cell, its value written in it where there is room, and a bar
// that says what the greys mean. Blocks above the trigger threshold are framed, those of a region tinted.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "maps/grid/coarse_grid.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct CoarsePicture {
  const CoarseGrid* coarse = nullptr;
  const OccupancyGrid* grid = nullptr;  // the OG1 below it: where its cells lie
  std::optional<double> trigger_ol;     // tau_trigger
  std::vector<Cell> region;             // coarse cells where templates are matched
  std::string title;
};

// Throws std::invalid_argument without both grids, std::runtime_error when the file cannot be written.
void write_coarse_picture(const std::filesystem::path& file, const CoarsePicture& picture);

}  // namespace cairn
