// Many matchings over one grid that grows and changes: memory that serves again must never show.
#include <gmock/gmock.h>
#include <hwy/targets.h>

#include <random>

#include "plugins/template_matcher/template_matcher.hpp"
#include "tests/plugins/template_matcher/drawn_grid.hpp"

namespace cairn::template_matcher {
namespace {

using Random = std::mt19937_64;

int between(Random& random, int least, int most) {
  return least + static_cast<int>(random() % static_cast<std::uint64_t>(most - least + 1));
}

// A beam's worth of cells becomes more or less certain; now and then a landmark or a block of noise stands there.
CellChanges change(OccupancyGrid& grid, Random& random, const std::vector<LandmarkShape>& shapes, int reach) {
  const Cell first{between(random, -reach, reach), between(random, -reach, reach)};
  const CellBox box{first, first + Cell{between(random, 1, 25), between(random, 1, 25)}};
  const int kind = between(random, 0, 9);
  if (kind == 0) {
    const Point at = grid.centre_of(first) + 0.05 * Point{between(random, 0, 9) / 9.0, between(random, 0, 9) / 9.0};
    const double angle_rad = radians(between(random, 0, 359));
    const CellBox around = CellBox{first, first}.grown(12);
    paint(grid, shapes[random() % shapes.size()].contour, {at.x(), at.y(), angle_rad}, around);
    return everything_in(around);
  }
  for (int y = box.min.y; y < box.max.y; ++y) {
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (kind == 1 && random() % 2 == 0) grid.set_log_odds({x, y}, static_cast<LogOdds>(between(random, -800, 1024)));
      if (kind > 1 && random() % 3 == 0) grid.add_log_odds({x, y}, kind > 6 ? 150 : -150);
    }
  }
  return everything_in(box);
}

void expect_same(const Matching& a, const Matching& b) {
  EXPECT_EQ(a.trigger, b.trigger);
  EXPECT_EQ(a.region_cells, b.region_cells);
  ASSERT_EQ(a.degrees.size(), b.degrees.size());
  for (std::size_t i = 0; i < a.degrees.size(); ++i) {
    EXPECT_EQ(a.degrees[i].category, b.degrees[i].category);
    EXPECT_EQ(a.degrees[i].degree, b.degrees[i].degree);
    EXPECT_EQ(a.degrees[i].orientation_rad, b.degrees[i].orientation_rad);
    EXPECT_EQ(a.degrees[i].at_m, b.degrees[i].at_m);
  }
  ASSERT_EQ(a.detection.has_value(), b.detection.has_value());
  if (!a.detection) return;
  EXPECT_EQ(a.detection->category, b.detection->category);
  EXPECT_EQ(a.detection->degree, b.detection->degree);
  EXPECT_EQ(a.detection->T_map_landmark.x_m, b.detection->T_map_landmark.x_m);
  EXPECT_EQ(a.detection->T_map_landmark.y_m, b.detection->T_map_landmark.y_m);
  EXPECT_EQ(a.detection->T_map_landmark.theta_rad, b.detection->T_map_landmark.theta_rad);
  EXPECT_EQ(a.detection->templates, b.detection->templates);
}

struct Seen {
  int matchings = 0;
  int detections = 0;
};

// One exhaustive matcher and, for every instruction set of this machine, a pruned one, through the same changes.
Seen live_through(const Config& config, std::uint64_t seed, int steps) {
  const auto set = std::make_shared<const TemplateSet>(paper_set());
  const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  Config plain = config;
  plain.search = Search::exhaustive;
  TemplateMatcher oracle(plain, set);
  std::vector<std::unique_ptr<TemplateMatcher>> pruned;
  for (std::size_t i = 0; i < targets.size(); ++i) pruned.push_back(std::make_unique<TemplateMatcher>(config, set));
  OccupancyGrid grid(0.05);
  Random random(seed);
  Seen seen;
  for (int step = 0; step < steps && !testing::Test::HasFailure(); ++step) {
    SCOPED_TRACE(step);
    const CellChanges changes = change(grid, random, set->shapes, 10 + step / 20);
    const DetectionReport expected = oracle.detect(grid, changes, {});
    for (std::size_t k = 0; k < targets.size(); ++k) {
      SCOPED_TRACE(hwy::TargetName(targets[k]));
      hwy::SetSupportedTargetsForTest(targets[k]);
      const DetectionReport found = pruned[k]->detect(grid, changes, {});
      EXPECT_EQ(found.matchings.size(), expected.matchings.size());
      if (found.matchings.size() != expected.matchings.size()) continue;
      for (std::size_t i = 0; i < found.matchings.size(); ++i) expect_same(found.matchings[i], expected.matchings[i]);
    }
    hwy::SetSupportedTargetsForTest(0);
    seen.matchings += static_cast<int>(expected.matchings.size());
    for (const Matching& m : expected.matchings) seen.detections += m.detection ? 1 : 0;
  }
  return seen;
}

class MatchingSequence : public testing::TestWithParam<Degrees> {};

TEST_P(MatchingSequence, GivesWhatTheExhaustiveMatcherGivesAtEveryStep) {
  Config config;
  config.degrees = GetParam();
  config.tau_match = 0.6;
  const Seen seen = live_through(config, 11, 2000);
  EXPECT_GT(seen.matchings, 500);
  EXPECT_GT(seen.detections, 50);
}

INSTANTIATE_TEST_SUITE_P(BothWaysToAsk, MatchingSequence, testing::Values(Degrees::above_threshold, Degrees::all));

}  // namespace
}  // namespace cairn::template_matcher
