#include "plugins/template_matcher/template_matcher.hpp"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

using ::testing::HasSubstr;

std::shared_ptr<const TemplateSet> paper_templates() {
  return std::make_shared<TemplateSet>(paper_set());
}

std::string error_of(const Config& config, std::shared_ptr<const TemplateSet> templates) {
  try {
    TemplateMatcher matcher(config, std::move(templates));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

const Detection* best_detection(const DetectionReport& report) {
  const Detection* best = nullptr;
  for (const Matching& m : report.matchings) {
    if (m.detection && (best == nullptr || m.detection->degree > best->degree)) best = &*m.detection;
  }
  return best;
}

// Ideal templates fit ideal paintings best; the thresholds for sensed maps do not matter here.
Config plain() {
  Config config;
  config.tau_match = 0.6;
  return config;
}

TEST(TemplateMatcher, FindsEachPaintedLandmarkWithItsPlaceAndOrientation) {
  for (const LandmarkShape& shape : paper_set().shapes) {
    TemplateMatcher matcher(plain(), paper_templates());
    OccupancyGrid grid(0.05);
    const Point at = grid.centre_of({17, -9});
    paint(grid, shape.contour, {at.x(), at.y(), radians(30.0)}, {{-20, -45}, {55, 30}});
    const DetectionReport report = matcher.detect(grid, everything_in(grid.bounds()), {});
    const Detection* found = best_detection(report);
    ASSERT_NE(found, nullptr) << shape.category;
    EXPECT_EQ(found->category, shape.category);
    EXPECT_NEAR(found->T_map_landmark.x_m, at.x(), 0.01) << shape.category;
    EXPECT_NEAR(found->T_map_landmark.y_m, at.y(), 0.01) << shape.category;
    EXPECT_GT(found->degree, 0.85);
    ASSERT_FALSE(found->templates.empty());
    EXPECT_EQ(found->templates.front().category, shape.category);
    const double expected_deg = shape.category == "circle" ? 0.0 : 30.0;
    EXPECT_NEAR(degrees(found->T_map_landmark.theta_rad), expected_deg, 4.0);
  }
}

TEST(TemplateMatcher, StaysOnTheCellsAndStepsWithoutBetweenCells) {
  Config config = plain();
  config.between_cells = false;
  OccupancyGrid grid(0.05);
  const Point beside = grid.centre_of({17, -9}) + Point(0.02, 0.01);
  paint(grid, square_shape().contour, {beside.x(), beside.y(), radians(34.0)}, {{-20, -45}, {55, 30}});
  TemplateMatcher matcher(config, paper_templates());
  const DetectionReport report = matcher.detect(grid, everything_in(grid.bounds()), {});
  const Detection* found = best_detection(report);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->T_map_landmark.position(), grid.centre_of({17, -9}));
  EXPECT_NEAR(degrees(found->T_map_landmark.theta_rad), 30.0, 1e-9);
}

TEST(TemplateMatcher, ReportsEveryCategoryInEveryMatching) {
  TemplateMatcher matcher(plain(), paper_templates());
  OccupancyGrid grid(0.05);
  paint(grid, square_shape().contour, {}, {{-25, -25}, {25, 25}});
  const DetectionReport report = matcher.detect(grid, everything_in(grid.bounds()), {});
  ASSERT_FALSE(report.matchings.empty());
  for (const Matching& m : report.matchings) {
    EXPECT_EQ(m.fits_above, 0.6);
    ASSERT_EQ(m.degrees.size(), 3U);
    EXPECT_EQ(m.degrees[0].category, "circle");
    EXPECT_EQ(m.degrees[1].category, "square");
    EXPECT_EQ(m.degrees[2].category, "triangle");
    EXPECT_GE(m.region_cells, 9 * 25);
    EXPECT_LE(m.region_cells, 25 * 25);
  }
}

void expect_same_detection(const Matching& a, const Matching& b) {
  ASSERT_EQ(a.detection.has_value(), b.detection.has_value());
  if (!a.detection) return;
  EXPECT_EQ(a.detection->category, b.detection->category);
  EXPECT_EQ(a.detection->degree, b.detection->degree);
  EXPECT_EQ(a.detection->T_map_landmark.x_m, b.detection->T_map_landmark.x_m);
  EXPECT_EQ(a.detection->T_map_landmark.y_m, b.detection->T_map_landmark.y_m);
  EXPECT_EQ(a.detection->T_map_landmark.theta_rad, b.detection->T_map_landmark.theta_rad);
  ASSERT_EQ(a.detection->templates.size(), b.detection->templates.size());
  for (std::size_t i = 0; i < a.detection->templates.size(); ++i) {
    EXPECT_EQ(a.detection->templates[i].category, b.detection->templates[i].category);
    EXPECT_EQ(a.detection->templates[i].orientation_rad, b.detection->templates[i].orientation_rad);
    EXPECT_EQ(a.detection->templates[i].degree, b.detection->templates[i].degree);
  }
}

TEST(TemplateMatcher, FindsTheSameLandmarksByEitherSearchAndWithEitherDegrees) {
  int detections = 0;
  for (const LandmarkShape& shape : paper_set().shapes) {
    for (const double margin : {0.0, 0.1}) {
      OccupancyGrid grid(0.05);
      paint(grid, shape.contour, {0.013, 0.021, 0.7}, {{-25, -25}, {25, 25}});
      std::vector<DetectionReport> reports;
      for (const Search search : {Search::exhaustive, Search::pruned}) {
        for (const Degrees degrees : {Degrees::all, Degrees::above_threshold}) {
          Config config = plain();
          config.search = search;
          config.degrees = degrees;
          config.min_margin = margin;
          reports.push_back(TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {}));
        }
      }
      for (const DetectionReport& report : reports) {
        ASSERT_EQ(report.matchings.size(), reports[0].matchings.size());
        for (std::size_t i = 0; i < report.matchings.size(); ++i) {
          EXPECT_EQ(report.matchings[i].trigger, reports[0].matchings[i].trigger);
          expect_same_detection(report.matchings[i], reports[0].matchings[i]);
          detections += report.matchings[i].detection ? 1 : 0;
        }
      }
      for (std::size_t i = 0; i < reports[0].matchings.size(); ++i) {
        const auto& expected = reports[0].matchings[i].degrees;
        const auto& found = reports[2].matchings[i].degrees;
        ASSERT_EQ(found.size(), 3U);
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_EQ(found[k].degree, expected[k].degree);
          EXPECT_EQ(found[k].at_m, expected[k].at_m);
        }
      }
    }
  }
  EXPECT_GE(detections, 12);
}

TEST(TemplateMatcher, ReportsTheDegreeOfEveryTemplateWhenAskedTo) {
  OccupancyGrid grid(0.05);
  paint(grid, square_shape().contour, {0.013, 0.021, 0.7}, {{-25, -25}, {25, 25}});
  Config config = plain();
  const DetectionReport all = TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {});
  config.degrees = Degrees::each_template;
  const DetectionReport each =
      TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {});
  config.search = Search::exhaustive;
  const DetectionReport oracle =
      TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {});
  ASSERT_GT(each.matchings.size(), 0U);
  ASSERT_EQ(each.matchings.size(), oracle.matchings.size());
  for (std::size_t i = 0; i < each.matchings.size(); ++i) {
    EXPECT_EQ(each.matchings[i].templates.size(), 15U) << "1 circle, 6 squares, 8 triangles";
    EXPECT_EQ(each.matchings[i].templates, oracle.matchings[i].templates);
    expect_same_detection(each.matchings[i], all.matchings[i]);
    EXPECT_TRUE(all.matchings[i].templates.empty());
  }
}

TEST(TemplateMatcher, ReportsOnlyDegreesAboveTauMatchWhenAskedTo) {
  OccupancyGrid grid(0.05);
  paint(grid, square_shape().contour, {}, {{-25, -25}, {25, 25}});
  Config config = plain();
  const auto all = TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {});
  config.degrees = Degrees::above_threshold;
  const auto above = TemplateMatcher(config, paper_templates()).detect(grid, everything_in(grid.bounds()), {});
  ASSERT_EQ(above.matchings.size(), all.matchings.size());
  std::size_t left_out = 0;
  for (std::size_t i = 0; i < all.matchings.size(); ++i) {
    std::vector<CategoryDegree> expected = all.matchings[i].degrees;
    std::erase_if(expected, [&](const CategoryDegree& d) { return d.degree <= config.tau_match; });
    ASSERT_EQ(above.matchings[i].degrees.size(), expected.size());
    for (std::size_t k = 0; k < expected.size(); ++k) {
      EXPECT_EQ(above.matchings[i].degrees[k].category, expected[k].category);
      EXPECT_EQ(above.matchings[i].degrees[k].degree, expected[k].degree);
      EXPECT_EQ(above.matchings[i].degrees[k].orientation_rad, expected[k].orientation_rad);
    }
    left_out += 3 - expected.size();
  }
  EXPECT_GT(left_out, 0U);
}

TEST(TemplateMatcher, MatchesNothingOnAnEmptyGrid) {
  TemplateMatcher matcher(plain(), paper_templates());
  const OccupancyGrid grid(0.05);
  EXPECT_TRUE(matcher.detect(grid, {}, {}).matchings.empty());
  EXPECT_TRUE(matcher.detect(grid, everything_in({{0, 0}, {40, 40}}), {}).matchings.empty());
}

TEST(TemplateMatcher, MatchesNothingOnFreeFloor) {
  TemplateMatcher matcher(plain(), paper_templates());
  OccupancyGrid grid(0.05);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) grid.set_log_odds({x, y}, -1024);
  }
  EXPECT_TRUE(matcher.detect(grid, everything_in(grid.bounds()), {}).matchings.empty());
}

TEST(TemplateMatcher, ScoresUnseenFloorNearATenth) {
  // One occupied coarse cell far from any contour triggers; all around nothing is known. Paper, Table 1.
  Config config = plain();
  config.tau_trigger = 100.0;
  const auto matchings = [&](MismatchScale mu) {
    config.mu = mu;
    TemplateMatcher matcher(config, paper_templates());
    OccupancyGrid grid(0.05);
    grid.include({{0, 0}, {40, 40}});
    return matcher.detect(grid, everything_in({{0, 0}, {5, 5}}), {}).matchings;
  };
  const auto by_sobel = matchings(MismatchScale::sobel);
  ASSERT_EQ(by_sobel.size(), 1U);
  EXPECT_FALSE(by_sobel.front().detection.has_value());
  for (const CategoryDegree& d : by_sobel.front().degrees) {
    EXPECT_GT(d.degree, 0.05) << d.category;
    EXPECT_LT(d.degree, 0.25) << d.category;
  }
  const auto by_literal = matchings(MismatchScale::literal);
  for (const CategoryDegree& d : by_literal.front().degrees) EXPECT_NEAR(d.degree, 0.55, 0.08) << d.category;
}

TEST(TemplateMatcher, WorksAtTheEdgeOfTheGrid) {
  // The painting ends half a cell outside the ring: templates reach into what was never written.
  TemplateMatcher matcher(plain(), paper_templates());
  OccupancyGrid grid(0.05);
  const Point at = grid.centre_of({0, 0});
  paint(grid, circle_shape().contour, {at.x(), at.y(), 0.0}, {{-7, -7}, {8, 8}});
  const DetectionReport report = matcher.detect(grid, everything_in(grid.bounds()), {});
  const Detection* found = best_detection(report);
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->category, "circle");
}

TEST(TemplateMatcher, DoesNotMatchAgainUntilMoreIsKnown) {
  TemplateMatcher matcher(plain(), paper_templates());
  OccupancyGrid grid(0.05);
  paint(grid, circle_shape().contour, {}, {{-25, -25}, {25, 25}});
  EXPECT_FALSE(matcher.detect(grid, everything_in(grid.bounds()), {}).matchings.empty());
  EXPECT_TRUE(matcher.detect(grid, everything_in(grid.bounds()), {}).matchings.empty());
}

TEST(TemplateMatcher, StopsWithTheBudgetAndGoesOnWithTheNextChange) {
  OccupancyGrid grid(0.05);
  paint(grid, circle_shape().contour, {}, {{-25, -25}, {25, 25}});
  TemplateMatcher matcher(plain(), paper_templates());
  Budget none;
  none.iterations = 0;
  EXPECT_TRUE(matcher.detect(grid, everything_in(grid.bounds()), none).matchings.empty());
  Budget one;
  one.iterations = 1;
  EXPECT_EQ(matcher.detect(grid, everything_in(grid.bounds()), one).matchings.size(), 1U);
  const std::atomic<bool> cancelled = true;
  Budget over;
  over.cancel = &cancelled;
  EXPECT_TRUE(matcher.detect(grid, everything_in(grid.bounds()), over).matchings.empty());
}

TEST(TemplateMatcher, KeepsACoarseGridThatEqualsARecomputation) {
  TemplateMatcher matcher(plain(), paper_templates());
  OccupancyGrid grid(0.05);
  paint(grid, square_shape().contour, {}, {{-25, -25}, {25, 25}});
  (void)matcher.detect(grid, everything_in(grid.bounds()), {});
  CoarseGrid fresh(5, plain().alpha_og2);
  fresh.rebuild(grid);
  ASSERT_NE(matcher.coarse_grid(), nullptr);
  EXPECT_EQ(*matcher.coarse_grid(), fresh);
}

TEST(TemplateMatcher, RefusesCoarseCellsLargerThanTheSmallestLandmark) {
  Config config = plain();
  config.coarse_cells = 11;
  EXPECT_THAT(error_of(config, paper_templates()),
              HasSubstr("m across, smaller than one cell of OG2, 0.55 m (11 cells); coarse_cells can be 10 at most"));
  config.coarse_cells = 10;
  EXPECT_EQ(error_of(config, paper_templates()), "no error");
}

TEST(TemplateMatcher, RefusesToLookForNothing) {
  EXPECT_THAT(error_of(plain(), nullptr), HasSubstr("no templates"));
  EXPECT_THAT(error_of(plain(), std::make_shared<TemplateSet>()), HasSubstr("no templates"));
  auto hollow = std::make_shared<TemplateSet>(paper_set());
  hollow->templates.front().cells.clear();
  EXPECT_THAT(error_of(plain(), hollow), HasSubstr("category \"circle\" has no cells"));
}

TEST(TemplateMatcher, RefusesAGridOfOtherCells) {
  TemplateMatcher matcher(plain(), paper_templates());
  const OccupancyGrid grid(0.1);
  EXPECT_THROW((void)matcher.detect(grid, {}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace cairn::template_matcher
