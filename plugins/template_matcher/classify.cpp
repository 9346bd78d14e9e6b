#include "plugins/template_matcher/classify.hpp"

#include <algorithm>
#include <cmath>

namespace cairn::template_matcher {
bool fits_better(const TemplateMatch& a, const LandmarkTemplate& shape_a, const TemplateMatch& b,
                 const LandmarkTemplate& shape_b) {
  return static_cast<std::int64_t>(a.mismatch) * static_cast<std::int64_t>(shape_b.scored_cells()) <
         static_cast<std::int64_t>(b.mismatch) * static_cast<std::int64_t>(shape_a.scored_cells());
}

double degree_of(std::int32_t mismatch, std::size_t cells, double mu) {
  return std::max(0.0, 1.0 - mismatch / (kMismatchPerUnit * mu * static_cast<double>(cells)));
}

std::int32_t mismatch_ceiling(double degree, std::size_t cells, double mu) {
  const double exact = (1.0 - degree) * kMismatchPerUnit * mu * static_cast<double>(cells);
  auto mismatch = static_cast<std::int32_t>(std::clamp(exact, 1.0, kUnmatched - 1.0));
  // Rounding must not decide: the degree itself does.
  while (mismatch > 0 && degree_of(mismatch - 1, cells, mu) <= degree) --mismatch;
  while (mismatch < kUnmatched && degree_of(mismatch, cells, mu) > degree) ++mismatch;
  return mismatch;
}

double above_unseen(std::int32_t mismatch, const LandmarkTemplate& shape) {
  const std::int32_t unseen = unseen_mismatch(shape);
  return unseen == 0 ? 0.0 : 1.0 - static_cast<double>(mismatch) / unseen;
}

bool fits_without_tolerance(std::span<const TemplateMatch> matches, std::span<const LandmarkTemplate> templates,
                            const ScoreRule& rule) {
  for (std::size_t i = 0; i < matches.size(); ++i)
    if (degree_of(matches[i].mismatch, templates[i].cells.size(), rule.mu) > rule.tau_match) return true;
  return false;
}

void take_tolerance(std::span<TemplateMatch> matches, std::span<const LandmarkTemplate> templates) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].mismatch == kUnmatched || templates[i].tolerance == 1.0) continue;
    matches[i].mismatch =
        static_cast<std::int32_t>(std::min(std::round(templates[i].tolerance * matches[i].mismatch), kUnmatched - 1.0));
  }
}

std::size_t best_template(std::span<const TemplateMatch> matches, std::span<const LandmarkTemplate> templates) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < matches.size(); ++i) {
    if (fits_better(matches[i], templates[i], matches[best], templates[best])) best = i;
  }
  return best;
}

bool is_decided(std::size_t best, std::span<const TemplateMatch> matches, std::span<const LandmarkTemplate> templates,
                const ScoreRule& rule) {
  const double degree = degree_of(matches[best].mismatch, templates[best].scored_cells(), rule.mu);
  if (degree <= rule.tau_match) return false;
  if (above_unseen(matches[best].mismatch, templates[best]) < rule.min_above_unseen) return false;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (templates[i].category == templates[best].category) continue;
    const double other = degree_of(matches[i].mismatch, templates[i].scored_cells(), rule.mu);
    if (!fits_better(matches[best], templates[best], matches[i], templates[i])) return false;
    if (degree - other < rule.min_margin) return false;
  }
  return true;
}

std::vector<CategoryDegree> degrees_by_category(std::span<const TemplateMatch> matches, const TemplateSet& set,
                                                const OccupancyGrid& grid, const ScoreRule& rule) {
  std::vector<CategoryDegree> degrees;
  for (const LandmarkShape& shape : set.shapes) {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < matches.size(); ++i) {
      if (set.templates[i].category != shape.category || matches[i].mismatch == kUnmatched) continue;
      if (!best || fits_better(matches[i], set.templates[i], matches[*best], set.templates[*best])) best = i;
    }
    if (!best) continue;
    const LandmarkTemplate& t = set.templates[*best];
    const double degree = degree_of(matches[*best].mismatch, t.scored_cells(), rule.mu);
    degrees.push_back({shape.category, degree, wrap_angle(t.orientation_rad), grid.centre_of(matches[*best].at),
                       degree > rule.tau_match});
  }
  return degrees;
}

std::vector<TemplateDegree> templates_above(std::span<const TemplateMatch> matches,
                                            std::span<const LandmarkTemplate> templates, const ScoreRule& rule) {
  std::vector<TemplateDegree> above;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const double degree = degree_of(matches[i].mismatch, templates[i].scored_cells(), rule.mu);
    if (degree > rule.tau_match) {
      above.push_back({templates[i].category, wrap_angle(templates[i].orientation_rad), degree});
    }
  }
  std::stable_sort(above.begin(), above.end(),
                   [](const TemplateDegree& a, const TemplateDegree& b) { return a.degree > b.degree; });
  std::vector<TemplateDegree> distinct;
  for (const TemplateDegree& t : above) {
    const bool is_known = std::any_of(distinct.begin(), distinct.end(), [&](const TemplateDegree& d) {
      return d.category == t.category && d.orientation_rad == t.orientation_rad;
    });
    if (!is_known) distinct.push_back(t);
  }
  return distinct;
}

}  // namespace cairn::template_matcher
