// Template matching (docs/method.md 7.1; paper section 3.3): where each template fits best, and how badly.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "maps/landmarks/landmark_template.hpp"
#include "plugins/template_matcher/gradient_field.hpp"

namespace cairn::template_matcher {

// Mismatches are sums of gradient distances in fixed point, so their order does not matter.
inline constexpr int kMismatchPerUnit = 16;

// |gradient difference| in 1/16. dx and dy are whole numbers within +-2040, so the sum of squares
// and the scaling are exact and the root is correctly rounded: the same on every machine.
[[nodiscard]] inline std::int32_t gradient_distance(float dx, float dy) {
  // Not lround, which cannot be vectorised.
  const float exact = kMismatchPerUnit * std::sqrt(dx * dx + dy * dy);
  return static_cast<std::int32_t>(exact + 0.5F);  // NOLINT(bugprone-incorrect-roundings)
}

inline constexpr std::int32_t kUnmatched = std::numeric_limits<std::int32_t>::max();

// The place where one template fits best: least mismatch, ties to the smaller (y, x). kUnmatched where
// no place fits well enough for the question asked.
struct TemplateMatch {
  Cell at;
  std::int32_t mismatch = kUnmatched;
  bool operator==(const TemplateMatch&) const = default;
};

// The mismatch of one template centred on one cell. The field covers the template there.
[[nodiscard]] std::int32_t mismatch_at(const GradientField& field, const LandmarkTemplate& shape, Cell at);

// The same over floor that nothing is known of.
[[nodiscard]] std::int32_t unseen_mismatch(const LandmarkTemplate& shape);

// Best place of every template over all cells of the spans, which are not empty and sorted by
// (y, x). The field's box holds the spans grown by the templates' reach. The plain loop: the oracle.
[[nodiscard]] std::vector<TemplateMatch> match_exhaustively(const GradientField& field,
                                                            std::span<const CellSpan> region,
                                                            std::span<const LandmarkTemplate> templates);

}  // namespace cairn::template_matcher
