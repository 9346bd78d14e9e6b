#include "maps/geometry/map_move.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// Along x, a pose each 0.1 m.
std::vector<Pose2> way(double length_m) {
  std::vector<Pose2> poses;
  for (double x_m = 0.0; x_m <= length_m + 1e-9; x_m += 0.1) poses.push_back({x_m, 0.0, 0.0});
  return poses;
}

template <class Function>
MapMove bent(const Function& to) {
  std::vector<Pose2> after;
  for (const Pose2& pose : way(10.0)) after.push_back(to(pose));
  return {way(10.0), after};
}

const std::vector<Point> kPath{{0.0, 1.0}, {5.0, 1.0}, {9.0, 0.0}};

TEST(MapMove, APlaceMovesAsTheWayNearBy) {
  const MapMove move = bent([](const Pose2& pose) { return Pose2{pose.x_m, pose.x_m < 5.0 ? 0.0 : 0.5, 0.0}; });
  EXPECT_NEAR((move.near({1.0, 2.0}) * Point(1.0, 2.0) - Point(1.0, 2.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((move.near({9.0, 2.0}) * Point(9.0, 2.0) - Point(9.0, 2.5)).norm(), 0.0, 1e-9);
}

TEST(MovedPath, ThatWasTurnedAndShiftedAsAWholeIsNotBent) {
  const Pose2 T{3.0, -2.0, radians(70.0)};
  const MovedPath moved = moved_path(bent([&](const Pose2& pose) { return T * pose; }), kPath);
  EXPECT_NEAR(moved.bend_m, 0.0, 1e-9);
  EXPECT_NEAR((moved.points.front() - T * kPath.front()).norm(), 0.0, 1e-9);
  EXPECT_NEAR((moved.points.back() - T * kPath.back()).norm(), 0.0, 1e-9);
}

TEST(MovedPath, IsBentWhereTheWayIs) {
  // As a parabola, its end by 1 m.
  const MapMove move = bent([](const Pose2& pose) {
    return Pose2{pose.x_m, pose.x_m * pose.x_m / 100.0, pose.x_m / 50.0};
  });
  const std::vector<Point> straight{{0.0, 0.0}, {10.0, 0.0}};
  const MovedPath moved = moved_path(move, straight);
  // A line fits a parabola of 1 m to a sixth of that at its ends.
  EXPECT_NEAR(moved.bend_m, 1.0 / 6.0, 0.03);
  EXPECT_GT(moved.points.size(), 30U) << "or it would still be straight";
  EXPECT_NEAR((moved.points[moved.points.size() / 2] - Point(5.0, 0.25)).norm(), 0.0, 0.05);
}

TEST(MovedPath, DoesNotJumpBetweenTwoPassesThatHaveMovedDifferently) {
  // There and back beside each other; only the way back has moved.
  std::vector<Pose2> before = way(5.0);
  std::vector<Pose2> after = before;
  for (double x_m = 5.0; x_m >= 0.0; x_m -= 0.1) {
    before.push_back({x_m, 0.02, 0.0});
    after.push_back({x_m, 0.17, 0.0});
  }
  const std::vector<Point> between{{0.0, 0.01}, {5.0, 0.01}};
  const MovedPath moved = moved_path({before, after}, between);
  for (std::size_t i = 1; i < moved.points.size(); ++i)
    EXPECT_LT(std::abs(moved.points[i].y() - moved.points[i - 1].y()), 0.1);
}

TEST(MovedPath, OfNothingIsEmpty) {
  EXPECT_TRUE(moved_path(bent([](const Pose2& pose) { return pose; }), {}).points.empty());
}

}  // namespace
}  // namespace cairn
