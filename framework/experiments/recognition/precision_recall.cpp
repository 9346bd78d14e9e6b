#include "framework/experiments/recognition/precision_recall.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace cairn {
namespace {

FoundCounts counts_at(const WorldCounts& world, double threshold) {
  FoundCounts counts{world.truly, 0, 0};
  // The first one that is below.
  const auto end = std::ranges::partition_point(world.counts,
                                                [&](const ThresholdCount& count) { return count.degree >= threshold; });
  if (end == world.counts.begin()) return counts;
  counts.found = std::prev(end)->found;
  counts.right = std::prev(end)->right;
  return counts;
}

}  // namespace

FoundCounts& FoundCounts::operator+=(const FoundCounts& more) {
  truly += more.truly;
  found += more.found;
  right += more.right;
  return *this;
}

double FoundCounts::f1() const {
  return truly + found == 0 ? 0.0 : 2.0 * static_cast<double>(right) / static_cast<double>(truly + found);
}

Interval f1_of(std::span<const FoundCounts> worlds) {
  return resampled(worlds.size(), [&](std::span<const std::size_t> taken) {
    FoundCounts some;
    for (const std::size_t index : taken) some += worlds[index];
    return some.f1();
  });
}

std::vector<CurvePoint> precision_recall(std::span<const WorldCounts> worlds) {
  std::set<double, std::greater<>> thresholds;
  for (const WorldCounts& world : worlds)
    for (const ThresholdCount& count : world.counts) thresholds.insert(count.degree);
  std::vector<CurvePoint> curve;
  for (const double threshold : thresholds) {
    FoundCounts all;
    for (const WorldCounts& world : worlds) all += counts_at(world, threshold);
    curve.push_back({threshold, share_of(all.right, all.found).value, share_of(all.right, all.truly).value, all.f1()});
  }
  return curve;
}

CurveFigures figures_at(std::span<const WorldCounts> worlds, double threshold) {
  std::vector<FoundCounts> counts;
  FoundCounts all;
  for (const WorldCounts& world : worlds) all += counts.emplace_back(counts_at(world, threshold));
  return {threshold, share_of(all.right, all.found), share_of(all.right, all.truly), f1_of(counts)};
}

CurveFigures best_figures(std::span<const WorldCounts> worlds) {
  const std::vector<CurvePoint> curve = precision_recall(worlds);
  const auto best = std::ranges::max_element(curve, {}, &CurvePoint::f1);
  return best == curve.end() ? CurveFigures{} : figures_at(worlds, best->threshold);
}

}  // namespace cairn
