#include "plugins/template_matcher/match.hpp"

namespace cairn::template_matcher {

std::int32_t mismatch_at(const GradientField& field, const LandmarkTemplate& shape, Cell at) {
  std::int32_t sum = 0;
  for (const TemplateCell& cell : shape.cells) {
    const Cell there = at + cell.offset;
    sum += gradient_distance(static_cast<float>(*field.x_from(there) - cell.gradient_x),
                             static_cast<float>(*field.y_from(there) - cell.gradient_y));
  }
  return sum;
}

std::int32_t unseen_mismatch(const LandmarkTemplate& shape) {
  std::int32_t sum = 0;
  for (const TemplateCell& cell : shape.cells) {
    sum += gradient_distance(static_cast<float>(cell.gradient_x), static_cast<float>(cell.gradient_y));
  }
  return sum;
}

std::vector<TemplateMatch> match_exhaustively(const GradientField& field, std::span<const CellSpan> region,
                                              std::span<const LandmarkTemplate> templates) {
  std::vector<TemplateMatch> matches;
  for (const LandmarkTemplate& shape : templates) {
    TemplateMatch best;
    for (const CellSpan& span : region) {
      for (int x = span.x_begin; x < span.x_end; ++x) {
        const std::int32_t mismatch = mismatch_at(field, shape, {x, span.y});
        if (mismatch < best.mismatch) best = {{x, span.y}, mismatch};
      }
    }
    matches.push_back(best);
  }
  return matches;
}

}  // namespace cairn::template_matcher
