#include "maps/submaps/surface_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "tests/maps/submaps/seen_room.hpp"

namespace cairn {
namespace {

SurfaceMap map_of(const std::vector<DrawnWall>& walls, const std::vector<Pose2>& seen_at) {
  SurfaceMap map(0.1);
  std::uint64_t seed = 100;
  for (const Pose2& T_map_robot : seen_at) {
    std::vector<Point> points_m;
    for (const Point& point_m : seen_from(walls, T_map_robot, 360, 0.01, ++seed))
      points_m.push_back(T_map_robot * point_m);
    map.add(points_m);
  }
  return map;
}

double error_m(const Pose2& found, const Pose2& truth) {
  return (found.position() - truth.position()).norm();
}

TEST(SurfaceMap, EchoesOfAWallGiveItsLineAndAHeapGivesNone) {
  SurfaceMap map(0.1);
  std::vector<Point> points_m;
  for (int i = 0; i < 30; ++i) points_m.emplace_back(0.01 * i, 0.05);
  for (int x = 0; x < 30; ++x)
    for (int y = 0; y < 30; ++y) points_m.emplace_back(2.0 + 0.01 * x, 2.0 + 0.01 * y);
  map.add(points_m);
  const SurfaceLine* line = map.nearest({0.15, 0.12});
  ASSERT_NE(line, nullptr);
  EXPECT_NEAR(std::abs(line->normal.y()), 1.0, 1e-9);
  EXPECT_NEAR(line->at_m.y(), 0.05, 1e-9);
  EXPECT_EQ(map.nearest({2.15, 2.15}), nullptr) << "a heap";
  EXPECT_EQ(map.nearest({5.0, 5.0}), nullptr) << "nothing near";
}

TEST(SurfaceMap, LeavesOutWhatIsNoPlace) {
  SurfaceMap map(0.1);
  for (const double odd : {1e7, -1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    const std::vector<Point> points_m = {{odd, 0.0}, {0.0, odd}};
    map.add(points_m);
    EXPECT_EQ(map.nearest({odd, 0.0}), nullptr);
  }
  EXPECT_TRUE(map.empty());
}

TEST(Align, FindsWhereScansOfARoomWereTakenToAFewMillimetres) {
  const std::vector<DrawnWall> room = drawn_room();
  const SurfaceMap map = map_of(room, {{2.0, 2.0, 0.0}, {3.0, 2.0, 0.5}, {4.0, 1.5, 0.0}});
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Pose2 truth{2.0 + 0.2 * static_cast<double>(seed), 1.8, 0.1 * static_cast<double>(seed)};
    const Pose2 start = truth * Pose2{0.08, -0.06, 0.05};
    const Alignment aligned = align(map, seen_from(room, truth, 180, 0.01, seed), start, {}, {});
    EXPECT_LT(error_m(aligned.T_map_scan, truth), 0.01) << seed;
    EXPECT_NEAR(wrap_angle(aligned.T_map_scan.theta_rad - truth.theta_rad), 0.0, 0.005) << seed;
    EXPECT_GT(aligned.matched_ratio, 0.9) << seed;
  }
}

TEST(Align, KnowsNothingAlongACorridorAndHoldsOnToThePredictionThere) {
  const std::vector<DrawnWall> corridor = {{{-50.0, 0.0}, {50.0, 0.0}}, {{-50.0, 2.0}, {50.0, 2.0}}};
  const SurfaceMap map = map_of(corridor, {{0.0, 1.0, 0.0}, {1.0, 1.0, 0.0}});
  const Pose2 truth{0.5, 1.1, 0.02};
  const PosePrediction prediction{{0.7, 1.05, 0.0}, 100.0 * Eigen::Matrix3d::Identity()};
  const Alignment aligned = align(map, seen_from(corridor, truth, 180, 0.01, 7), prediction.T_map_scan, prediction, {});
  EXPECT_NEAR(aligned.T_map_scan.x_m, 0.7, 0.03) << "the prediction's";
  EXPECT_NEAR(aligned.T_map_scan.y_m, 1.1, 0.01) << "the walls'";
  EXPECT_LT(aligned.information(0, 0), 0.02 * aligned.information(1, 1));
}

TEST(Align, WithoutSurfacesStaysWhereItIsPredicted) {
  const PosePrediction prediction{{1.0, 2.0, 0.5}, Eigen::Matrix3d::Identity()};
  const std::vector<Point> points_m = {{1.0, 0.0}, {0.0, 1.0}};
  const Alignment aligned = align(SurfaceMap(0.1), points_m, prediction.T_map_scan, prediction, {});
  EXPECT_NEAR(error_m(aligned.T_map_scan, prediction.T_map_scan), 0.0, 1e-12);
  EXPECT_EQ(aligned.matched_ratio, 0.0);
}

}  // namespace
}  // namespace cairn
