// Conformance of modules of kind `detector`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyDetector, DetectorConformance,
//                            testing::Values(module<cairn::Detector>(FOLDER, "my_detector", "{min_size_m: 0.2}")));
//   }
//
// The detector gets ideal templates of a circle, a square and a triangle, and grids with one of them drawn.
#pragma once

#include "maps/geometry/segments.hpp"
#include "tests/conformance/allocations.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class DetectorConformance : public Conformance<Detector> {
 protected:
  [[nodiscard]] double cell_m() const { return setup().templates->cell_m; }
  // A cell's centre for each shape, on both sides of the lattice's origin.
  [[nodiscard]] std::vector<Pose2> places() const {
    std::vector<Pose2> places;
    const OccupancyGrid lattice(cell_m());
    for (std::size_t i = 0; i < setup().templates->shapes.size(); ++i) {
      const Point at = lattice.centre_of(lattice.cell_at({i % 2 == 0 ? 5.0 : -5.0, 3.0 + static_cast<double>(i)}));
      places.push_back({at.x(), at.y(), 0.0});
    }
    return places;
  }
  [[nodiscard]] OccupancyGrid landmark_grid(std::size_t shape = 0) const {
    return grid_with_landmark(setup().templates->shapes[shape], places()[shape], cell_m());
  }
  static DetectionReport detect(Detector& detector, const OccupancyGrid& grid) {
    return detector.detect(grid, everything_changed(grid), Budget{});
  }
  static const Detection* first_detection(const DetectionReport& report) {
    for (const Matching& matching : report.matchings)
      if (matching.detection) return &*matching.detection;
    return nullptr;
  }
  static bool is_degree(double degree) { return degree >= 0.0 && degree <= 1.0; }
  // What is wrong with a report, or empty.
  [[nodiscard]] static std::string fault_of(const DetectionReport& report) {
    for (const Matching& matching : report.matchings) {
      if (matching.region_cells < 0) return "region_cells is negative";
      if (!matching.region_centre_m.allFinite()) return "region_centre_m is not finite";
      for (const CategoryDegree& d : matching.degrees) {
        if (!is_degree(d.degree)) return "degree of " + d.category + " is not in [0, 1]: " + text_of(d.degree);
        if (!d.at_m.allFinite()) return "place of " + d.category + " is not finite";
      }
      if (!matching.detection) continue;
      const Detection& found = *matching.detection;
      if (found.category.empty()) return "a detection without a category";
      if (!is_degree(found.degree)) return "degree of the detection is not in [0, 1]: " + text_of(found.degree);
      if (!is_finite(found.T_map_landmark)) return "the landmark's pose is not finite";
      for (std::size_t i = 0; i < found.templates.size(); ++i) {
        if (!is_degree(found.templates[i].degree)) return "degree of a template is not in [0, 1]";
        if (i > 0 && found.templates[i].degree > found.templates[i - 1].degree)
          return "the templates of a detection come best first";
      }
    }
    return {};
  }
};

TEST_P(DetectorConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(DetectorConformance, OutlivesTheLibraryThatMadeIt) {
  const auto detector = GetParam().make_outliving_library();
  EXPECT_FALSE(detect(*detector, landmark_grid()).matchings.empty()) << "a clear landmark led to no matching";
}

TEST_P(DetectorConformance, FindsALandmarkWhereItStands) {
  for (std::size_t i = 0; i < setup().templates->shapes.size(); ++i) {
    const auto detector = make();
    const DetectionReport report = detect(*detector, landmark_grid(i));
    const Detection* const found = first_detection(report);
    ASSERT_NE(found, nullptr) << "nothing was found on a grid with a clear " << setup().templates->shapes[i].category
                              << " on free ground; " << text_of(report);
    EXPECT_LT((found->T_map_landmark.position() - places()[i].position()).norm(), 0.3) << text_of(report);
  }
}

TEST_P(DetectorConformance, ReportsKeepTheirContract) {
  const auto detector = make();
  for (std::size_t i = 0; i < setup().templates->shapes.size(); ++i)
    EXPECT_EQ(fault_of(detect(*detector, landmark_grid(i))), "");
}

TEST_P(DetectorConformance, FindsNothingOnFreeOrUnknownGround) {
  const auto detector = make();
  OccupancyGrid grid(cell_m());
  EXPECT_EQ(first_detection(detect(*detector, grid)), nullptr) << "on an empty grid";
  grid.include({{-20, -20}, {20, 20}});
  EXPECT_EQ(first_detection(detect(*detector, grid)), nullptr) << "on unknown ground";
  for (int y = -20; y < 20; ++y)
    for (int x = -20; x < 20; ++x) grid.set_log_odds({x, y}, -1000);
  EXPECT_EQ(first_detection(detect(*detector, grid)), nullptr) << "on free ground";
}

TEST_P(DetectorConformance, UnchangedGroundIsNotReportedAgain) {
  const auto detector = make();
  const OccupancyGrid grid = landmark_grid();
  (void)detect(*detector, grid);
  const DetectionReport report = detector->detect(grid, {}, Budget{});
  EXPECT_EQ(first_detection(report), nullptr)
      << "no cell has changed, so nothing new is known: the host counts each detection as a confirmation";
}

TEST_P(DetectorConformance, TheSameGridsGiveTheSameReports) {
  const auto first = make(7);
  const auto second = make(7);
  for (std::size_t i = 0; i < setup().templates->shapes.size(); ++i)
    EXPECT_EQ(text_of(detect(*first, landmark_grid(i))), text_of(detect(*second, landmark_grid(i))))
        << "the answer must depend on config, seed and input only";
}

TEST_P(DetectorConformance, TwoObjectsShareNothing) {
  const auto alone = make(7);
  const std::string expected = text_of(detect(*alone, landmark_grid()));
  const auto detector = make(7);
  const auto other = make(7);
  (void)detect(*other, landmark_grid());
  EXPECT_EQ(text_of(detect(*detector, landmark_grid())), expected)
      << "another object of the module changed what this one finds";
}

TEST_P(DetectorConformance, AUsedUpBudgetEndsACallPromptlyWithoutAMatching) {
  const UsedUpBudget used_up;
  for (const Budget& budget : {used_up.cancelled(), UsedUpBudget::past_deadline()}) {
    const auto detector = make();
    const OccupancyGrid grid = landmark_grid();
    DetectionReport report;
    EXPECT_LT(seconds_of([&] { report = detector->detect(grid, everything_changed(grid), budget); }), kPromptly_s);
    EXPECT_TRUE(report.matchings.empty()) << "budget.exhausted() on entry: begin no matching";
    EXPECT_FALSE(detect(*detector, grid).matchings.empty())
        << "what a budget cut off is made up for at the next change";
  }
}

TEST_P(DetectorConformance, OddChangesAreHarmless) {
  const auto detector = make();
  const OccupancyGrid grid = landmark_grid();
  const std::vector<CellSpan> odd{
      {0, 5, 5}, {0, 9, 2}, {1 << 20, 0, 10}, {-(1 << 20), -10, 0}, {60, -(1 << 30), 1 << 30}, {60, 1 << 28, 1 << 29}};
  for (const CellSpan& span : odd) {
    CellChanges changes;
    changes.spans = {span};
    DetectionReport report;
    ASSERT_NO_THROW(report = detector->detect(grid, changes, Budget{}))
        << "span in row " << span.y << " from " << span.x_begin << " to " << span.x_end;
    EXPECT_EQ(fault_of(report), "");
  }
  EXPECT_EQ(fault_of(detect(*detector, grid)), "") << "a good call after odd ones";
}

TEST_P(DetectorConformance, AGridOfOtherCellsIsRefusedOrUsedAndForgotten) {
  const auto detector = make();
  const TemplateSet& templates = *setup().templates;
  try {
    const OccupancyGrid coarse = grid_with_landmark(templates.shapes[0], places()[0], 3.7 * cell_m());
    EXPECT_EQ(fault_of(detect(*detector, coarse)), "");
  } catch (const std::exception& error) {
    EXPECT_STRNE(error.what(), "") << "say which cell sizes do not fit";
    EXPECT_FALSE(detect(*detector, landmark_grid()).matchings.empty()) << "a good call after a refused one";
  }
}

TEST_P(DetectorConformance, CoarseGridStaysTheSameObject) {
  const auto detector = make();
  const CoarseGrid* const before = detector->coarse_grid();
  (void)detect(*detector, landmark_grid());
  EXPECT_EQ(detector->coarse_grid(), before) << "pictures keep the pointer";
}

TEST_P(DetectorConformance, AllocatesNothingWithoutAMatching) {
  const auto detector = make();
  const OccupancyGrid grid = landmark_grid();
  const CellChanges changes = everything_changed(grid);
  for (int i = 0; i < 20; ++i) (void)detector->detect(grid, changes, Budget{});
  const AllocationCount allocations;
  const bool idle = detector->detect(grid, changes, Budget{}).matchings.empty();
  const std::int64_t allocated = allocations.count();
  EXPECT_TRUE(!idle || allocated == 0)
      << allocated << " allocations by changes that led to no matching: keep the buffers as members";
  const AllocationCount without_changes;
  (void)detector->detect(grid, {}, Budget{});
  EXPECT_EQ(without_changes.count(), 0) << "no changes at all";
}

}  // namespace cairn::conformance
