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

std::vector<Point> random_points(std::mt19937_64& random, int count) {
  std::uniform_real_distribution<double> place_m(-1.5, 1.5);
  std::vector<Point> points_m;
  for (int i = 0; i < count; ++i) {
    const double x_m = place_m(random);
    points_m.emplace_back(x_m, place_m(random));
  }
  return points_m;
}

// Every pose of the window that the scan's origin can have, in order, and the best of them that are apart: no bounds,
// no squares.
std::vector<ScanMatch> plainly_distinct(std::span<const SearchLayer> layers, const LikelihoodField& standing,
                                        const SearchWindow& window, const DistinctRules& rules) {
  const double cell_m = standing.cell_m();
  double farthest_m = cell_m;
  double points = 0.0;
  for (const SearchLayer& layer : layers)
    for (const Point& point_m : layer.points_m) {
      farthest_m = std::max(farthest_m, point_m.norm());
      points += 1.0;
    }
  const double step_rad = cell_m / farthest_m;
  const int turns = static_cast<int>(window.half_angle_rad / step_rad);
  const int side = static_cast<int>(window.half_side_m / cell_m);
  std::vector<ScanMatch> all;
  for (int turn = -turns; turn <= turns; ++turn)
    for (int y = -side; y <= side; ++y)
      for (int x = -side; x <= side; ++x) {
        const Pose2& middle = window.T_field_scan;
        const double heading_rad = wrap_angle(middle.theta_rad + turn * step_rad);
        const auto at = [&](const LikelihoodField& field, const Point& point_m) {
          const Point seen_m = Pose2{middle.x_m, middle.y_m, heading_rad} * point_m;
          return static_cast<int>(field.value(field.cell_of(seen_m.x()) + x, field.cell_of(seen_m.y()) + y));
        };
        if (at(standing, {0.0, 0.0}) == 0) continue;
        int sum = 0;
        for (const SearchLayer& layer : layers)
          for (const Point& point_m : layer.points_m) sum += at(layer.pyramid->field(), point_m);
        all.push_back({{middle.x_m + x * cell_m, middle.y_m + y * cell_m, heading_rad}, sum / (255.0 * points)});
      }
  std::stable_sort(all.begin(), all.end(), [](const ScanMatch& a, const ScanMatch& b) { return a.score > b.score; });
  std::vector<ScanMatch> found;
  for (const ScanMatch& match : all) {
    if (match.score < rules.min_score - 1e-9 || found.size() == rules.at_most) break;
    if (!found.empty() && match.score < rules.min_of_best_ratio * found.front().score - 1e-9) break;
    const bool is_apart = std::ranges::all_of(found, [&](const ScanMatch& other) {
      const Pose2& a = match.T_field_scan;
      const Pose2& b = other.T_field_scan;
      return (a.position() - b.position()).norm() >= rules.apart_m - 1e-9 ||
             std::abs(wrap_angle(a.theta_rad - b.theta_rad)) >= rules.apart_rad;
    });
    if (is_apart) found.push_back(match);
  }
  return found;
}

TEST(CorrelativeSearch, FindsTheSameDistinctPosesAsTryingEveryPose) {
  std::size_t several = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::mt19937_64 random(seed);
    const int levels = 1 + static_cast<int>(seed % 5);
    const FieldPyramid echoes(random_field(random, 60), levels);
    const FieldPyramid free(random_field(random, 90), levels);
    const FieldPyramid standing(random_field(random, 150), levels);
    const std::vector<Point> echoes_m = random_points(random, 20);
    const std::vector<Point> free_m = random_points(random, 8);
    const std::vector<SearchLayer> layers = {{&echoes, echoes_m}, {&free, free_m}};
    const SearchWindow window{{3.0, 3.0, 0.1 * static_cast<double>(seed)}, 1.2, seed % 2 == 0 ? 0.4 : 3.0};
    const DistinctRules rules{.min_score = 0.2, .min_of_best_ratio = 0.7, .apart_m = 0.65, .apart_rad = 0.3};
    const auto plain = plainly_distinct(layers, standing.field(), window, rules);
    const auto fast = search_distinct(layers, &standing, window, rules);
    ASSERT_EQ(plain.size(), fast.size()) << seed;
    several += plain.size() > 2 ? 1 : 0;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_EQ(plain[i].T_field_scan, fast[i].T_field_scan) << seed << ", pose " << i;
      EXPECT_NEAR(plain[i].score, fast[i].score, 1e-12) << seed << ", pose " << i;
    }
  }
  EXPECT_GT(several, 15U) << "most searches should have had poses to tell apart";
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
