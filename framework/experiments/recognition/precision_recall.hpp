// Precision and recall of detections at every threshold of their degree, over many worlds.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "framework/experiments/statistics.hpp"

namespace cairn {

// What counts in one world when the threshold lies just below a degree.
struct ThresholdCount {
  double degree = 0.0;
  std::int64_t found = 0;  // detections of at least this degree
  std::int64_t right = 0;  // of them, those of a landmark that is there
};

struct WorldCounts {
  std::int64_t truly = 0;              // landmarks of the world
  std::vector<ThresholdCount> counts;  // by falling degree, each degree once
};

// What was found against what is there.
struct FoundCounts {
  std::int64_t truly = 0;
  std::int64_t found = 0;
  std::int64_t right = 0;

  FoundCounts& operator+=(const FoundCounts& more);
  [[nodiscard]] double f1() const;
};
// Of all worlds together, with the 95 % interval from resampling them.
[[nodiscard]] Interval f1_of(std::span<const FoundCounts> worlds);

struct CurvePoint {
  double threshold = 0.0;
  double precision = 0.0;
  double recall = 0.0;
  double f1 = 0.0;  // harmonic mean of the two
};

// All worlds taken together: a point for each degree that any of them has, by falling threshold.
[[nodiscard]] std::vector<CurvePoint> precision_recall(std::span<const WorldCounts> worlds);

// With 95 % intervals: Wilson's of precision and recall; of F1 from resampling the worlds.
struct CurveFigures {
  double threshold = 0.0;
  Interval precision;
  Interval recall;
  Interval f1;
};
[[nodiscard]] CurveFigures figures_at(std::span<const WorldCounts> worlds, double threshold);
// Where F1 is highest, at the highest such threshold; all 0 when nothing was found.
[[nodiscard]] CurveFigures best_figures(std::span<const WorldCounts> worlds);

}  // namespace cairn
