#include "plugins/template_matcher/match.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

CellBox box_of(const std::vector<CellSpan>& spans) {
  return CellChanges{spans}.box();
}

TEST(GradientDistance, RoundsToSixteenths) {
  EXPECT_EQ(gradient_distance(3.0F, 4.0F), 80);
  EXPECT_EQ(gradient_distance(0.0F, 0.0F), 0);
  EXPECT_EQ(gradient_distance(1.0F, 1.0F), 23);  // 16 * 1.41421 = 22.63
  EXPECT_EQ(gradient_distance(-2040.0F, 2040.0F), 46160);
}

TEST(Match, GivesTiesToTheLowestRowThenTheLeftmostColumn) {
  const TemplateSet set = paper_set();
  const OccupancyGrid unseen(0.05);
  const std::vector<CellSpan> region = {{2, 5, 9}, {2, 11, 13}, {3, 1, 6}};
  const GradientField field(unseen, box_of(region).grown(reach_of(set.templates)));
  for (const TemplateMatch& match : match_exhaustively(field, region, set.templates)) {
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
    const std::vector<CellSpan> region = everything_in({{-5, -5}, {12, 12}}).spans;
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
