// Detectors compared on one finished grid: what each finds there, right and wrong, at every threshold.
#pragma once

#include <string>
#include <vector>

#include "framework/experiments/config.hpp"
#include "framework/experiments/recognition/precision_recall.hpp"
#include "framework/mission/mission.hpp"
#include "framework/modules/module_library.hpp"
#include "maps/grid/occupancy_grid.hpp"

namespace cairn {

struct DetectorSweep {
  std::string detector;  // its name in the experiment
  WorldCounts counts;
  double wall_s = 0.0;  // of its one call; differs from run to run
};

// The mission with one of the experiment's detectors in place of its own. What that detector's settings
// leave open is as the mission's own detector has it, where the module knows such a setting; but tau_match
// is 0. Throws ConfigError.
[[nodiscard]] Mission with_detector(const Mission& mission, const ComparedDetector& detector,
                                    const ModuleLibrary& library);

// Of detections nearer to each other than the mission's merge_m the best one stays. A detection is right as
// in judge_recognition(): paired with a landmark of its category, no farther than tolerance_m.
[[nodiscard]] WorldCounts counts_of(const std::vector<Detection>& detections, const Mission& mission,
                                    double tolerance_m);

// A new detector sees the whole grid at once, without a budget. Throws ConfigError or ModuleFault.
[[nodiscard]] DetectorSweep sweep(const Mission& mission, const ComparedDetector& detector,
                                  const ModuleLibrary& library, const OccupancyGrid& grid, double tolerance_m);

}  // namespace cairn
