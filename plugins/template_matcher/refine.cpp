#include "plugins/template_matcher/refine.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

namespace cairn::template_matcher {
namespace {

bool is_whole(double ratio) {
  return std::abs(ratio - std::round(ratio)) < 1e-6;
}

double mean_mismatch(std::size_t index, std::span<const TemplateMatch> matches,
                     std::span<const LandmarkTemplate> templates) {
  return static_cast<double>(matches[index].mismatch) / static_cast<double>(templates[index].scored_cells());
}

}  // namespace

Minimum parabola_minimum(double before, double here, double after) {
  const double curvature = before - 2.0 * here + after;
  if (curvature <= 0.0) return {0.0, here};
  const double at = std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
  return {at, here + 0.5 * at * (after - before + at * curvature)};
}

PlaceInCell place_in_cell(const GradientField& field, const LandmarkTemplate& shape, Cell at) {
  const auto mismatch = [&](int x, int y) { return static_cast<double>(mismatch_at(field, shape, at + Cell{x, y})); };
  const double here = mismatch(0, 0);
  const Minimum x = parabola_minimum(mismatch(-1, 0), here, mismatch(1, 0));
  const Minimum y = parabola_minimum(mismatch(0, -1), here, mismatch(0, 1));
  const double least = std::max(0.0, x.value + y.value - here);
  return {{x.at, y.at}, static_cast<std::int32_t>(std::lround(std::min(least, here)))};
}

OrientationNeighbours::OrientationNeighbours(const TemplateSet& set) : step_rad_(set.step_rad) {
  // A family: one category, and of each orientation's templates the one at the same rank.
  std::map<std::pair<std::string, std::size_t>, std::vector<std::size_t>> families;
  std::size_t rank = 0;
  for (std::size_t i = 0; i < set.templates.size(); ++i) {
    const LandmarkTemplate& t = set.templates[i];
    const bool is_same = i > 0 && set.templates[i - 1].category == t.category &&
                         set.templates[i - 1].orientation_rad == t.orientation_rad;
    rank = is_same ? rank + 1 : 0;
    families[{t.category, rank}].push_back(i);
    pairs_.push_back({i, i});
  }
  for (const auto& [name, family] : families) join(set, family);
}

void OrientationNeighbours::join(const TemplateSet& set, std::span<const std::size_t> family) {
  const std::size_t count = family.size();
  const double period_rad = step_rad_ * static_cast<double>(count);
  // The family closes on itself when it is one period of a symmetry.
  const bool is_cyclic = count >= 3 && is_whole(2.0 * std::numbers::pi / period_rad);
  for (std::size_t k = 0; k < count; ++k) {
    const double expected_rad = set.templates[family[0]].orientation_rad + step_rad_ * static_cast<double>(k);
    if (std::abs(set.templates[family[k]].orientation_rad - expected_rad) > 1e-9) return;  // steps are missing
  }
  for (std::size_t k = 0; k < count; ++k) {
    const bool has_both = is_cyclic || (k > 0 && k + 1 < count);
    if (has_both) pairs_[family[k]] = {family[(k + count - 1) % count], family[(k + 1) % count]};
  }
}

double OrientationNeighbours::offset_rad(std::size_t index, std::span<const TemplateMatch> matches,
                                         std::span<const LandmarkTemplate> templates) const {
  const Pair& pair = pairs_[index];
  if (pair.before == index || pair.after == index) return 0.0;
  return step_rad_ * parabola_minimum(mean_mismatch(pair.before, matches, templates),
                                      mean_mismatch(index, matches, templates),
                                      mean_mismatch(pair.after, matches, templates))
                         .at;
}

}  // namespace cairn::template_matcher
