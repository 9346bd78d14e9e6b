// A mission as its detector lives through it: what each tick changes of OG1.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn::bench {

struct RecordedTick {
  CellChanges changes;           // as the mapper reported them
  CellBox bounds;                // of the grid from then on
  std::vector<LogOdds> written;  // of the cells of the spans, one after the other
};

struct RecordedDrive {
  std::shared_ptr<const TemplateSet> templates;  // as the mission's detector gets them
  OccupancyGrid start;
  std::vector<RecordedTick> ticks;
};

// Runs the mission and maps its readings once more, noting what the map module changes.
[[nodiscard]] RecordedDrive record_drive(const std::filesystem::path& mission_file, std::int64_t seed);

// Makes the grid what it was after the tick.
void write(OccupancyGrid& grid, const RecordedTick& tick);

}  // namespace cairn::bench
