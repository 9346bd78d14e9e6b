#include "plugins/template_matcher/match.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

OccupancyGrid noise(std::uint64_t seed, const CellBox& box, int levels) {
  OccupancyGrid grid(0.05);
  std::mt19937_64 random(seed);
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      const int level = static_cast<int>(random() % static_cast<std::uint64_t>(levels));
      grid.set_log_odds({x, y}, static_cast<LogOdds>(-1024 + 2048 * level / std::max(1, levels - 1)));
    }
  }
  return grid;
}

// Rows with gaps and odd lengths.
std::vector<CellSpan> ragged_region(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<CellSpan> spans;
  for (int y = -6; y < 7; ++y) {
    int x = -8;
    while (x < 10) {
      const int begin = x + static_cast<int>(random() % 5);
      const int end = begin + 1 + static_cast<int>(random() % 9);
      spans.push_back({y, begin, end});
      x = end + 1;
    }
  }
  return spans;
}

CellBox box_of(const std::vector<CellSpan>& spans) {
  return CellChanges{spans}.box();
}

TEST(GradientDistance, RoundsToSixteenths) {
  EXPECT_EQ(gradient_distance(3.0F, 4.0F), 80);
  EXPECT_EQ(gradient_distance(0.0F, 0.0F), 0);
  EXPECT_EQ(gradient_distance(1.0F, 1.0F), 23);  // 16 * 1.41421 = 22.63
  EXPECT_EQ(gradient_distance(-2040.0F, 2040.0F), 46160);
}

TEST(PrunedMatcher, AnswersAsTheExhaustiveOneOnNoise) {
  const TemplateSet set = paper_set();
  const PrunedMatcher pruned(set.templates);
  const int reach = reach_of(set.templates);
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const std::vector<CellSpan> region = ragged_region(seed);
    const GradientField field(noise(seed, {{-30, -30}, {30, 30}}, 17), box_of(region).grown(reach));
    EXPECT_EQ(pruned.match(field, region), match_exhaustively(field, region, set.templates)) << "seed " << seed;
  }
}

TEST(PrunedMatcher, AnswersAsTheExhaustiveOneWhereManyPlacesTie) {
  const TemplateSet set = paper_set();
  const PrunedMatcher pruned(set.templates);
  const int reach = reach_of(set.templates);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    // A few occupied cells in a flat plain: most places score the same.
    OccupancyGrid grid(0.05);
    std::mt19937_64 random(seed);
    for (int i = 0; i < 4; ++i) {
      grid.set_log_odds({static_cast<int>(random() % 20) - 10, static_cast<int>(random() % 20) - 10}, 1024);
    }
    const std::vector<CellSpan> region = ragged_region(seed + 100);
    const GradientField field(grid, box_of(region).grown(reach));
    EXPECT_EQ(pruned.match(field, region), match_exhaustively(field, region, set.templates)) << "seed " << seed;
  }
}

TEST(PrunedMatcher, AnswersAsTheExhaustiveOneOnPaintedLandmarks) {
  const TemplateSet set = paper_set();
  const PrunedMatcher pruned(set.templates);
  const int reach = reach_of(set.templates);
  for (const LandmarkShape& shape : set.shapes) {
    OccupancyGrid grid(0.05);
    paint(grid, shape.contour, {0.03, -0.02, 0.4}, {{-30, -30}, {30, 30}});
    const std::vector<CellSpan> region = all_of({{-12, -12}, {13, 13}}).spans;
    const GradientField field(grid, box_of(region).grown(reach));
    EXPECT_EQ(pruned.match(field, region), match_exhaustively(field, region, set.templates)) << shape.category;
  }
}

TEST(Match, GivesTiesToTheLowestRowThenTheLeftmostColumn) {
  const TemplateSet set = paper_set();
  const OccupancyGrid unseen(0.05);
  const std::vector<CellSpan> region = {{2, 5, 9}, {2, 11, 13}, {3, 1, 6}};
  const GradientField field(unseen, box_of(region).grown(reach_of(set.templates)));
  for (const TemplateMatch& match : PrunedMatcher(set.templates).match(field, region)) {
    EXPECT_EQ(match.at, (Cell{5, 2}));
  }
}

TEST(Match, OfAPaintedTemplateWithItselfIsNear1AtItsPlace) {
  const TemplateSet set = paper_set();
  for (std::size_t i = 0; i < set.templates.size(); ++i) {
    const LandmarkTemplate& t = set.templates[i];
    const auto shape = std::find_if(set.shapes.begin(), set.shapes.end(),
                                    [&](const LandmarkShape& s) { return s.category == t.category; });
    OccupancyGrid grid(0.05);
    const Point centre = grid.centre_of({4, 3});
    paint(grid, shape->contour, {centre.x(), centre.y(), t.orientation_rad}, {{-30, -30}, {30, 30}});
    const std::vector<CellSpan> region = all_of({{-5, -5}, {12, 12}}).spans;
    const GradientField field(grid, box_of(region).grown(reach_of(set.templates)));
    const std::vector<TemplateMatch> matches = match_exhaustively(field, region, set.templates);
    EXPECT_EQ(matches[i].at, (Cell{4, 3})) << t.category << " " << degrees(t.orientation_rad);
    // The clamp keeps OL within 4 and 250, so a little is always missing.
    EXPECT_LT(matches[i].mismatch, 0.1 * kMismatchPerUnit * 1140.0 * static_cast<double>(t.cells.size()));
  }
}

TEST(Match, CountsAsManyTermsAsTheTemplateHasCells) {
  LandmarkTemplate dot{"dot", 0.0, {{{0, 0}, 300, 400}, {{2, 1}, 0, 0}}};
  const OccupancyGrid unseen(0.05);
  const GradientField field(unseen, {{-4, -4}, {5, 5}});
  EXPECT_EQ(mismatch_at(field, dot, {0, 0}), 500 * kMismatchPerUnit);
  EXPECT_EQ(reach_of(std::vector<LandmarkTemplate>{dot}), 2);
}

}  // namespace
}  // namespace cairn::template_matcher
