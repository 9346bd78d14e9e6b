// From mismatches to degrees and a class (docs/method.md 7.1, 7.3; paper section 3.3).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "framework/contracts/detector.hpp"
#include "plugins/template_matcher/match.hpp"

namespace cairn::template_matcher {

struct ScoreRule {
  double mu = 0.0;  // gradient distance that counts as no match at all
  double tau_match = 0.0;
  double min_margin = 0.0;        // by which the best category must lead the next one
  double min_above_unseen = 0.0;  // see above_unseen()
};

// 1 - mismatch / (cells * mu), at least 0.
[[nodiscard]] double degree_of(std::int32_t mismatch, std::size_t cells, double mu);

// The smallest mismatch that gives no more than this degree.
[[nodiscard]] std::int32_t mismatch_ceiling(double degree, std::size_t cells, double mu);

// The degree on a scale where unseen floor has 0 and a perfect match 1; negative below. What unseen
// floor scores depends on the template (a sensed one has many faint cells), a believable match on this
// scale does not.
[[nodiscard]] double above_unseen(std::int32_t mismatch, const LandmarkTemplate& shape);

// By mean mismatch, compared without division, so that equal is equal.
[[nodiscard]] bool fits_better(const TemplateMatch& a, const LandmarkTemplate& shape_a, const TemplateMatch& b,
                               const LandmarkTemplate& shape_b);

// Whether a template fits that needs no tolerance for it.
[[nodiscard]] bool fits_without_tolerance(std::span<const TemplateMatch> matches,
                                          std::span<const LandmarkTemplate> templates, const ScoreRule& rule);
// Raises the mismatches of tolerant templates so that their degrees are those without tolerance, to 0.002: where
// something fits without, it must not be beaten by what does not. above_unseen() then has the raised mismatch, too.
void take_tolerance(std::span<TemplateMatch> matches, std::span<const LandmarkTemplate> templates);

// Index of the template that fits best; ties go to the first.
[[nodiscard]] std::size_t best_template(std::span<const TemplateMatch> matches,
                                        std::span<const LandmarkTemplate> templates);

// Whether the class of the best template may be believed: its degree is above tau_match, and above
// that of unseen floor by enough, and no template of another category reaches it or comes within the
// margin.
[[nodiscard]] bool is_decided(std::size_t best, std::span<const TemplateMatch> matches,
                              std::span<const LandmarkTemplate> templates, const ScoreRule& rule);

// The best degree of every category, in the order of the set, with its place; without the categories that
// are unmatched.
[[nodiscard]] std::vector<CategoryDegree> degrees_by_category(std::span<const TemplateMatch> matches,
                                                              const TemplateSet& set, const OccupancyGrid& grid,
                                                              const ScoreRule& rule);

// All templates above tau_match, best first. Of several templates of one orientation the best.
[[nodiscard]] std::vector<TemplateDegree> templates_above(std::span<const TemplateMatch> matches,
                                                          std::span<const LandmarkTemplate> templates,
                                                          const ScoreRule& rule);

}  // namespace cairn::template_matcher
