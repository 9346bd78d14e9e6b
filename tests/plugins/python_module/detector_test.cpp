#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/plugins/python_module/python_file.hpp"

namespace cairn::testing_python {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::MatchesRegex;

OccupancyGrid grid_with_a_cell() {
  OccupancyGrid grid(0.1);
  grid.include({{-2, -1}, {3, 4}});
  grid.set_log_odds({1, 2}, 512);
  return grid;
}

DetectionReport report_of(Detector& detector, const Budget& budget = {}) {
  const OccupancyGrid grid = grid_with_a_cell();
  return detector.detect(grid, everything_in(grid.bounds()), budget);
}

std::string detecting(const std::string& body) {
  return "import numpy as np\n"
         "class It:\n"
         "  def __init__(self, context): self.context = context\n"
         "  def detect(self, grid, changes):\n" +
         body;
}

std::string error_of_report(const std::string& body) {
  const auto detector = detector_of(detecting(body));
  return error_of([&] { (void)report_of(*detector); });
}

TEST(PythonDetector, SeesTheGridAsArraysWithTheirPlaces) {
  const auto detector = detector_of(
      detecting("    assert grid.shape == (5, 5) and abs(grid.cell_m - 0.1) < 1e-12\n"
                "    assert np.allclose(grid.origin_m, (-0.2, -0.1))\n"
                "    (row, column), = np.argwhere(grid.log_odds() == 2.0)\n"
                "    assert (row, column) == (3, 3) == grid.cell_of(0.15, 0.25)\n"
                "    assert grid.probability()[row, column] > 0.8 and grid.ol()[0, 0] == 127\n"
                "    part = grid.part((3, 99), (2, 4))\n"
                "    assert part.shape == (2, 2) and part.log_odds()[0, 1] == 2.0\n"
                "    assert np.allclose(part.centre_of(0, 1), grid.centre_of(3, 3))\n"
                "    assert grid.part((9, 12), (-5, -3)).log_odds().size == 0\n"
                "    return [{'category': 'post', 'pose': grid.centre_of(3, 3), 'degree': np.float32(0.5)}]\n"));
  const DetectionReport report = report_of(*detector);
  ASSERT_EQ(report.matchings.size(), 1U);
  ASSERT_TRUE(report.matchings[0].detection);
  EXPECT_EQ(report.matchings[0].detection->category, "post");
  EXPECT_NEAR(report.matchings[0].detection->T_map_landmark.x_m, 0.15, 1e-9);
  EXPECT_NEAR(report.matchings[0].detection->T_map_landmark.y_m, 0.25, 1e-9);
  EXPECT_EQ(report.matchings[0].detection->degree, 0.5);
  EXPECT_EQ(report.matchings[0].trigger, (Cell{1, 2}));
}

TEST(PythonDetector, SeesTheChangesThatLieWithinTheGrid) {
  const auto detector =
      detector_of(detecting("    assert changes.box == ((1, 3), (0, 2)), changes.box\n"
                            "    mask = changes.mask()\n"
                            "    assert mask.shape == grid.shape and mask.sum() == 3\n"
                            "    assert mask[1, 0] and mask[1, 1] and mask[2, 1]\n"));
  const OccupancyGrid grid = grid_with_a_cell();
  CellChanges changes;
  changes.spans = {{-7, 0, 9}, {0, -9, 0}, {1, -1, 0}, {3, 7, 5}};
  EXPECT_TRUE(detector->detect(grid, changes, Budget{}).matchings.empty());
}

TEST(PythonDetector, IsNotCalledWithoutChanges) {
  const auto detector = detector_of(detecting("    raise ValueError('called')\n"));
  const OccupancyGrid grid = grid_with_a_cell();
  EXPECT_NO_THROW((void)detector->detect(grid, {}, Budget{}));
}

TEST(PythonDetector, AMatchingThatIsNotFoundIsNoDetection) {
  const auto detector = detector_of(detecting(
      "    return ({'category': 'post', 'pose': (0, 0, 1), 'degree': 0.2, 'found': False} for _ in range(2))\n"));
  const DetectionReport report = report_of(*detector);
  ASSERT_EQ(report.matchings.size(), 2U);
  EXPECT_FALSE(report.matchings[0].detection);
  EXPECT_FALSE(report.matchings[0].degrees.at(0).fits);
}

TEST(PythonDetector, MoreThanTheBudgetAllowsComesWithTheNextCall) {
  const auto detector =
      detector_of(detecting("    return [{'category': c, 'pose': (0, 0), 'degree': 1} for c in ('a', 'b', 'c')]\n"));
  Budget two;
  two.iterations = 2;
  EXPECT_EQ(report_of(*detector, two).matchings.size(), 2U);
  const DetectionReport rest = detector->detect(grid_with_a_cell(), {}, Budget{});
  ASSERT_EQ(rest.matchings.size(), 1U);
  EXPECT_EQ(rest.matchings[0].detection->category, "c");
}

TEST(PythonDetector, WhatItReturnsIsCheckedAndFaultsAreNamed) {
  const std::string good = "'category': 'post', 'pose': (0, 0), 'degree': 0.5";
  EXPECT_THAT(error_of_report("    return 3\n"), HasSubstr("detect() must return a list of dicts, found int 3"));
  EXPECT_THAT(error_of_report("    return {" + good + "}\n"), HasSubstr("detect() must return a list of dicts"));
  EXPECT_THAT(error_of_report("    return [3]\n"),
              AllOf(HasSubstr("item 1 of what "), HasSubstr("detect() returned must be a dict, found int 3")));
  EXPECT_THAT(error_of_report("    return [{" + good + ", 'fond': True}]\n"),
              HasSubstr("unknown key \"fond\" in item 1 of what"));
  EXPECT_THAT(error_of_report("    return [{" + good + "}, {'category': 'post'}]\n"),
              HasSubstr("lacks the key \"pose\""));
  EXPECT_THAT(error_of_report("    return [{'category': 'post', 'pose': (0, 0), 'degree': 1.5}]\n"),
              HasSubstr("must be a number from 0 to 1, found 1.5"));
  EXPECT_THAT(error_of_report("    return [{'category': 7, 'pose': (0, 0), 'degree': 1}]\n"),
              AllOf(HasSubstr("category of item 1"), HasSubstr("must be text, found int 7")));
  for (const char* pose : {"3", "(1,)", "'ab'", "(0, float('nan'))", "(0, None)", "np.zeros(4)"})
    EXPECT_THAT(error_of_report(std::string("    return [{'category': 'post', 'degree': 1, 'pose': ") + pose + "}]\n"),
                HasSubstr("must be (x, y) or (x, y, heading), finite numbers, found"))
        << pose;
}

TEST(PythonDetector, WhatItRaisesHasItsLineAndTrace) {
  EXPECT_THAT(
      error_of_report("    x = 0\n    return 1 / x\n"),
      MatchesRegex("[^\n]*\\.py:6:[0-9]+: ZeroDivisionError: division by zero\nTraceback .*line 6, in detect.*"));
  EXPECT_THAT(error_of_report("    raise SystemExit\n"), HasSubstr("SystemExit"));
  EXPECT_THAT(error_of_report("    raise KeyboardInterrupt\n"), HasSubstr("KeyboardInterrupt"));
  EXPECT_THAT(error_of_report("    return self.detect(grid, changes)\n"), HasSubstr("RecursionError"));
}

TEST(PythonDetector, WhatIsLentCannotBeUsedAfterTheCall) {
  const auto detector =
      detector_of(detecting("    if hasattr(self, 'kept'): self.kept.log_odds()\n"
                            "    self.kept = grid\n"));
  (void)report_of(*detector);
  EXPECT_THAT(error_of([&] { (void)report_of(*detector); }), HasSubstr("during the call only: copy what you keep"));
}

TEST(PythonDetector, ABudgetCanBeAskedFor) {
  const auto detector = detector_of(detecting("    assert not self.context.exhausted()\n"));
  EXPECT_NO_THROW((void)report_of(*detector));
}

}  // namespace
}  // namespace cairn::testing_python
