#include "plugins/template_matcher/match.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace cairn::template_matcher {
namespace {

constexpr int kLane = GradientField::kPadding;  // rows are summed in whole multiples of this
constexpr std::size_t kCellsBetweenChecks = 12;
constexpr TemplateMatch kNoMatch{{0, 0}, std::numeric_limits<std::int32_t>::max()};

// Adds one template cell's distances at `count` neighbouring places. Kept apart and simple: the
// compiler turns it into vector instructions.
void add_distances(const float* __restrict x, const float* __restrict y, float wanted_x, float wanted_y, int count,
                   std::int32_t* __restrict sums) {
  for (int i = 0; i < count; ++i) sums[i] += gradient_distance(x[i] - wanted_x, y[i] - wanted_y);
}

// Visiting every k-th cell, k near the golden section of the count and prime to it, meets all sides of
// the contour early.
std::size_t spreading_step(std::size_t count) {
  auto step = static_cast<std::size_t>(0.618 * static_cast<double>(count));
  while (step > 1 && std::gcd(step, count) != 1) --step;
  return std::max<std::size_t>(step, 1);
}

}  // namespace

int reach_of(std::span<const LandmarkTemplate> templates) {
  int reach = 0;
  for (const LandmarkTemplate& t : templates) {
    for (const TemplateCell& cell : t.cells) reach = std::max(reach, distance8(cell.offset, {0, 0}));
  }
  return reach;
}

std::int32_t mismatch_at(const GradientField& field, const LandmarkTemplate& shape, Cell at) {
  std::int32_t sum = 0;
  for (const TemplateCell& cell : shape.cells) {
    const Cell there = at + cell.offset;
    sum += gradient_distance(*field.x_from(there) - static_cast<float>(cell.gradient_x),
                             *field.y_from(there) - static_cast<float>(cell.gradient_y));
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
    TemplateMatch best = kNoMatch;
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

PrunedMatcher::PrunedMatcher(std::span<const LandmarkTemplate> templates) {
  for (const LandmarkTemplate& t : templates) {
    PreparedTemplate prepared;
    const std::size_t step = spreading_step(t.cells.size());
    for (std::size_t i = 0; i < t.cells.size(); ++i) {
      const TemplateCell& cell = t.cells[i * step % t.cells.size()];
      prepared.push_back({cell.offset, static_cast<float>(cell.gradient_x), static_cast<float>(cell.gradient_y)});
    }
    templates_.push_back(std::move(prepared));
  }
}

void PrunedMatcher::match_span(const GradientField& field, const CellSpan& span, const PreparedTemplate& shape,
                               std::vector<std::int32_t>& sums, TemplateMatch& best) {
  const int width = span.x_end - span.x_begin;
  const int padded = (width + kLane - 1) / kLane * kLane;
  sums.assign(static_cast<std::size_t>(padded), 0);
  for (std::size_t i = 0; i < shape.size();) {
    const std::size_t stop = std::min(i + kCellsBetweenChecks, shape.size());
    for (; i < stop; ++i) {
      const Cell first = Cell{span.x_begin, span.y} + shape[i].offset;
      add_distances(field.x_from(first), field.y_from(first), shape[i].gradient_x, shape[i].gradient_y, padded,
                    sums.data());
    }
    // Distances are never negative, and an equal sum further on would lose the tie.
    if (*std::min_element(sums.begin(), sums.begin() + width) >= best.mismatch) return;
  }
  const auto least = std::min_element(sums.begin(), sums.begin() + width);
  best = {{span.x_begin + static_cast<int>(least - sums.begin()), span.y}, *least};
}

std::vector<TemplateMatch> PrunedMatcher::match(const GradientField& field, std::span<const CellSpan> region) const {
  std::vector<TemplateMatch> matches;
  std::vector<std::int32_t> sums;
  for (const PreparedTemplate& shape : templates_) {
    TemplateMatch best = kNoMatch;
    for (const CellSpan& span : region) match_span(field, span, shape, sums, best);
    matches.push_back(best);
  }
  return matches;
}

}  // namespace cairn::template_matcher
