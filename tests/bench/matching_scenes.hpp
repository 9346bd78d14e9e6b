// What the detector meets in missions: patches of OG1 as simulated runs make them, and the templates
// of those missions.
#pragma once

#include <string>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "maps/landmarks/landmark_template.hpp"

namespace cairn::bench {

struct MatchingScene {
  OccupancyGrid grid;
  std::vector<CellSpan> region;  // kRegionSide x kRegionSide cells about the centre of a matching
  bool has_landmark = false;     // a landmark's centre lies in the region
};

struct MatchingScenes {
  TemplateSet templates;  // as the mission's detector gets them
  std::vector<MatchingScene> scenes;

  [[nodiscard]] std::vector<const MatchingScene*> with_landmark(bool has_landmark) const;
};

inline constexpr int kRegionSide = 40;

// Runs the office mission with two seeds and keeps every n-th of its matchings.
[[nodiscard]] const MatchingScenes& matching_scenes();

}  // namespace cairn::bench
