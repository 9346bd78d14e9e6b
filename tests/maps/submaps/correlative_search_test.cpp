#include "maps/submaps/correlative_search.hpp"

#include <gtest/gtest.h>

#include "tests/maps/submaps/seen_room.hpp"

namespace cairn {
namespace {

LikelihoodField random_field(std::mt19937_64& random, int echoes) {
  std::uniform_real_distribution<double> place_m(0.0, 6.0);
  std::vector<Point> echoes_m;
  for (int i = 0; i < echoes; ++i) {
    const double x_m = place_m(random);
    echoes_m.emplace_back(x_m, place_m(random));
  }
  return {echoes_m, 0.1, 0.15};
}

TEST(CorrelativeSearch, BranchAndBoundFindsWhatTryingEveryPoseFinds) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::mt19937_64 random(seed);
    const FieldPyramid pyramid(random_field(random, 60), 1 + static_cast<int>(seed % 5));
    std::uniform_real_distribution<double> place_m(-1.5, 1.5);
    std::vector<Point> points_m;
    for (int i = 0; i < 25; ++i) {
      const double x_m = place_m(random);
      points_m.emplace_back(x_m, place_m(random));
    }
    const SearchWindow window{{3.0, 3.0, place_m(random)}, 0.8, 0.3};
    const auto all = search_all(pyramid.field(), points_m, window, 0.1);
    const auto fast = search(pyramid, points_m, window, 0.1);
    ASSERT_EQ(all.has_value(), fast.has_value()) << seed;
    if (!all) continue;
    EXPECT_EQ(all->T_field_scan, fast->T_field_scan) << seed;
    EXPECT_EQ(all->score, fast->score) << seed;
    EXPECT_NEAR(score_of(pyramid.field(), points_m, fast->T_field_scan), fast->score, 0.06) << seed;
  }
}

TEST(CorrelativeSearch, FindsWhereAScanWasTaken) {
  const std::vector<DrawnWall> room = drawn_room();
  const std::vector<Point> map_m = seen_from(room, {3.0, 2.0, 0.0}, 720, 0.01, 1);  // in its own frame
  const FieldPyramid pyramid(LikelihoodField(map_m, 0.1, 0.12), 5);
  const Pose2 T_field_scan{0.7, -0.4, 0.25};
  const std::vector<Point> scan_m = seen_from(room, Pose2{3.0, 2.0, 0.0} * T_field_scan, 180, 0.01, 2);
  const auto found = search(pyramid, scan_m, {{0.0, 0.0, 0.0}, 1.5, 0.4}, 0.5);
  ASSERT_TRUE(found);
  EXPECT_LT((found->T_field_scan.position() - T_field_scan.position()).norm(), 0.12);
  EXPECT_NEAR(found->T_field_scan.theta_rad, 0.25, 0.03);
}

TEST(CorrelativeSearch, FindsNothingBelowTheLeastScoreOrWithoutPoints) {
  const std::vector<Point> map_m = {{0.05, 0.05}};
  const FieldPyramid pyramid(LikelihoodField(map_m, 0.1, 0.1), 3);
  const std::vector<Point> scan_m = {{0.05, 0.05}, {3.0, 0.0}};
  EXPECT_FALSE(search(pyramid, scan_m, {{}, 0.5, 0.1}, 0.7)) << "half of the points fit at most";
  EXPECT_TRUE(search(pyramid, scan_m, {{}, 0.5, 0.1}, 0.4));
  EXPECT_FALSE(search(pyramid, {}, {{}, 0.5, 0.1}, 0.0));
}

}  // namespace
}  // namespace cairn
