// Between the cells and between the orientation steps: where the mismatch is least.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plugins/template_matcher/match.hpp"

namespace cairn::template_matcher {

// The least value of a parabola that passes through these values at -1, 0 and 1, and where it lies: within
// +-0.5, and at 0 when they do not curve upwards.
struct Minimum {
  double at = 0.0;
  double value = 0.0;
};
[[nodiscard]] Minimum parabola_minimum(double before, double here, double after);

// The best place within a cell: its offset from the centre, in cells, and the mismatch there, as the parabolas
// along x and y foretell it; never above that at the centre. The field covers the template at the cells around
// `at` too.
struct PlaceInCell {
  Point offset{0.0, 0.0};
  std::int32_t mismatch = 0;
};
[[nodiscard]] PlaceInCell place_in_cell(const GradientField& field, const LandmarkTemplate& shape, Cell at);

// Which templates show the same category turned by one step, and were rendered the same way.
class OrientationNeighbours {
 public:
  explicit OrientationNeighbours(const TemplateSet& set);
  // The templates turned by one step to either side; the template's own index where there is none.
  struct Pair {
    std::size_t before = 0;
    std::size_t after = 0;
  };
  [[nodiscard]] Pair of(std::size_t index) const { return pairs_[index]; }
  // Angle between a template's orientation and the one that its neighbours' mismatches point to;
  // 0 for templates without two neighbours.
  [[nodiscard]] double offset_rad(std::size_t index, std::span<const TemplateMatch> matches,
                                  std::span<const LandmarkTemplate> templates) const;

 private:
  void join(const TemplateSet& set, std::span<const std::size_t> family);

  double step_rad_;
  std::vector<Pair> pairs_;  // one a template
};

}  // namespace cairn::template_matcher
