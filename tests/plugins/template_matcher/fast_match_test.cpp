#include "plugins/template_matcher/fast_match.hpp"

#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

using Random = std::mt19937_64;

int between(Random& random, int least, int most) {
  return least + static_cast<int>(random() % static_cast<std::uint64_t>(most - least + 1));
}

constexpr CellBox kDrawn{{-24, -24}, {25, 25}};

// Noise of few or many levels, a few points in a plain (most places tie), walls, or a landmark in noise.
OccupancyGrid random_grid(Random& random) {
  OccupancyGrid grid(0.05);
  const int kind = between(random, 0, 3);
  const int levels = between(random, 2, 20);
  const Point normal{std::cos(static_cast<double>(random() % 7)), std::sin(static_cast<double>(random() % 7))};
  if (kind == 3) paint(grid, square_shape().contour, {0.2, -0.1, 0.1 * between(random, 0, 15)}, kDrawn);
  for (int y = kDrawn.min.y; y < kDrawn.max.y; ++y) {
    for (int x = kDrawn.min.x; x < kDrawn.max.x; ++x) {
      int log_odds = grid.log_odds({x, y});
      if (kind == 0) log_odds = -1024 + 2048 * between(random, 0, levels - 1) / (levels - 1);
      if (kind == 1) log_odds = random() % 300 == 0 ? 1024 : 0;
      if (kind == 2) log_odds = static_cast<int>(200.0 * (x * normal.x() + y * normal.y())) % 1500;
      if (kind == 3 && random() % 4 == 0) log_odds += between(random, -300, 300);
      grid.set_log_odds({x, y}, static_cast<LogOdds>(log_odds));
    }
  }
  return grid;
}

// Rows with gaps and odd lengths, somewhere.
std::vector<CellSpan> random_region(Random& random) {
  std::vector<CellSpan> spans;
  const Cell first{between(random, -9, 3), between(random, -9, 3)};
  const int rows = between(random, 1, 12);
  const int width = between(random, 1, 40);
  for (int y = first.y; y < first.y + rows; ++y) {
    int x = first.x + between(random, 0, 2);
    do {
      const int end = x + between(random, 1, width);
      spans.push_back({y, x, end});
      x = end + between(random, 1, 4);
    } while (x < first.x + width);
  }
  return spans;
}

// Any gradients at any cells, what the grid shows somewhere, or a rendered shape.
LandmarkTemplate random_template(Random& random, const OccupancyGrid& grid) {
  static const TemplateSet rendered = paper_set();
  const int kind = between(random, 0, 2);
  if (kind == 0) return rendered.templates[random() % rendered.templates.size()];
  LandmarkTemplate shape{"any", 0.0, {}};
  const GradientField field(grid, kDrawn);
  const int reach = between(random, 0, 6);
  const Cell centre{between(random, -8, 8), between(random, -8, 8)};
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      if (random() % 3 == 0 && !shape.cells.empty()) continue;
      TemplateCell cell{{x, y}, *field.x_from(centre + Cell{x, y}), *field.y_from(centre + Cell{x, y})};
      if (kind == 1) {
        cell.gradient_x = static_cast<std::int16_t>(between(random, -1020, 1020));
        cell.gradient_y = static_cast<std::int16_t>(between(random, -1020, 1020));
      }
      shape.cells.push_back(cell);
    }
  }
  return shape;
}

std::vector<LandmarkTemplate> random_templates(Random& random, const OccupancyGrid& grid) {
  std::vector<LandmarkTemplate> templates;
  for (int i = between(random, 1, 4); i > 0; --i) templates.push_back(random_template(random, grid));
  return templates;
}

std::int32_t random_ceiling(Random& random, std::int32_t best) {
  const std::int32_t choices[] = {kUnmatched, kUnmatched, 0, best, best + 1, best / 2, best + 10000};
  return choices[random() % std::size(choices)];
}

std::vector<TemplateMatch> below(std::vector<TemplateMatch> matches, std::span<const std::int32_t> ceilings) {
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i].mismatch >= ceilings[i]) matches[i] = {};
  }
  return matches;
}

GradientField field_for(const OccupancyGrid& grid, const std::vector<CellSpan>& region,
                        std::span<const LandmarkTemplate> templates, int spare = 0) {
  return {grid, CellChanges{region}.box().grown(reach_of(templates) + spare)};
}

// Runs the check with every instruction set that this machine has, the plain code among them.
template <typename Check>
void on_each_instruction_set(const Check& check) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(FastMatcher, IsTestedOnMoreThanThePlainCode) {
  EXPECT_GE(hwy::SupportedAndGeneratedTargets().size(), 2U);
}

TEST(FastMatcher, AnswersAsTheExhaustiveMatcherToTheBit) {
  int found = 0;
  int too_bad = 0;
  for (std::uint64_t seed = 1; seed <= 1200 && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const OccupancyGrid grid = random_grid(random);
    const std::vector<LandmarkTemplate> templates = random_templates(random, grid);
    FastMatcher fast(templates);
    // The same matcher over regions of different sizes, one after the other.
    for (int round = 0; round < 2; ++round) {
      const std::vector<CellSpan> region = random_region(random);
      const GradientField field = field_for(grid, region, templates, between(random, 0, 2));
      const std::vector<TemplateMatch> best = match_exhaustively(field, region, templates);
      std::vector<std::int32_t> ceilings;
      for (const TemplateMatch& match : best) ceilings.push_back(random_ceiling(random, match.mismatch));
      const std::vector<TemplateMatch> expected = below(best, ceilings);
      on_each_instruction_set([&] { EXPECT_EQ(fast.match(field, region, ceilings), expected); });
      for (const TemplateMatch& match : expected) ++(match.mismatch == kUnmatched ? too_bad : found);
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_GT(too_bad, 1000);
}

TEST(FastMatcher, AnswersAsTheExhaustiveMatcherOverALargeRegion) {
  const TemplateSet set = paper_set();
  FastMatcher fast(set.templates);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    Random random(seed);
    const OccupancyGrid grid = random_grid(random);
    const std::vector<CellSpan> region = everything_in({{-20, -20}, {21, 20}}).spans;
    const GradientField field = field_for(grid, region, set.templates, 1);
    const std::vector<std::int32_t> any(set.templates.size(), kUnmatched);
    const std::vector<TemplateMatch> expected = match_exhaustively(field, region, set.templates);
    on_each_instruction_set([&] { EXPECT_EQ(fast.match(field, region, any), expected); });
  }
}

TEST(FastMatcher, GivesTiesToTheLowestRowThenTheLeftmostColumn) {
  const TemplateSet set = paper_set();
  const std::vector<CellSpan> region = {{2, 5, 9}, {2, 11, 13}, {3, 1, 6}, {9, 0, 70}};
  const GradientField field = field_for(OccupancyGrid(0.05), region, set.templates);
  const std::vector<std::int32_t> any(set.templates.size(), kUnmatched);
  on_each_instruction_set([&] {
    for (const TemplateMatch& match : FastMatcher(set.templates).match(field, region, any)) {
      EXPECT_EQ(match.at, (Cell{5, 2}));
    }
  });
}

TEST(FastMatcher, FindsALargeTemplateThatNeedsCoarserUnits) {
  Random random(5);
  OccupancyGrid grid(0.05);
  const CellBox box{{-60, -60}, {60, 60}};
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      grid.set_log_odds({x, y}, static_cast<LogOdds>(between(random, -1024, 1024)));
    }
  }
  const GradientField all(grid, box);
  std::vector<LandmarkTemplate> templates = {{"large", 0.0, {}}};
  for (int y = -35; y <= 35; ++y) {
    for (int x = -35; x <= 35; ++x) {
      const Cell there{x + 3, y - 2};
      templates[0].cells.push_back({{x, y}, *all.x_from(there), *all.y_from(there)});
    }
  }
  const std::vector<CellSpan> region = everything_in({{-9, -9}, {10, 10}}).spans;
  const GradientField field = field_for(grid, region, templates);
  const std::vector<std::int32_t> any = {kUnmatched};
  const std::vector<TemplateMatch> expected = match_exhaustively(field, region, templates);
  EXPECT_EQ(expected[0], (TemplateMatch{{3, -2}, 0}));
  on_each_instruction_set([&] { EXPECT_EQ(FastMatcher(templates).match(field, region, any), expected); });
}

TEST(FastMatcher, RefusesTemplatesThatItsSumsCannotHold) {
  const std::vector<LandmarkTemplate> templates = {
      {"palace", 0.0, std::vector<TemplateCell>(FastMatcher::kMaxCells + 1)}};
  try {
    const FastMatcher matcher(templates);
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "a template of category \"palace\" has 20001 cells, more than 20000; larger cells would do");
  }
}

}  // namespace
}  // namespace cairn::template_matcher
