#include "plugins/odometry_compass/wall_finder.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>
#include <random>

#include "plugins/odometry_compass/pose_filter.hpp"

namespace cairn::odometry_compass {
namespace {

// Drives straight on, with a transducer to each side and one ahead, past something that answers as `range_from` says.
class WallFinderTest : public testing::Test {
 protected:
  using RangeFrom = std::function<std::optional<double>(const Pose2&)>;

  std::optional<SeenWall> drive(double way_m, const RangeFrom& range_from) {
    std::optional<SeenWall> last;
    for (double driven_m = 0.0; driven_m < way_m; driven_m += 0.02) {
      Observation seen;
      robot_ = robot_ * Pose2{0.02, 0.0, 0.0};
      seen.T_odom_robot = robot_;
      seen.stamp_s = stamp_s_ += 0.1;
      for (const double angle_rad : {radians(90.0), 0.0, radians(-90.0)}) {
        RangeReading reading;
        reading.T_robot_sensor = Pose2{0.0, 0.0, angle_rad} * Pose2{0.1, 0.0, 0.0};
        reading.half_beam_rad = radians(15.0);
        reading.min_m = 0.1;
        reading.max_m = 5.0;
        const auto range = range_from(robot_ * reading.T_robot_sensor);
        reading.range_m = range ? *range + 0.01 * normal_(random_) : std::numeric_limits<double>::infinity();
        seen.ranges.push_back(reading);
      }
      finder_.take(seen);
      if (!finder_.is_due()) continue;
      if (const auto wall = finder_.find()) last = wall;
    }
    return last;
  }
  // The line y = 1.5 m, where its perpendicular is in the beam.
  static std::optional<double> wall(const Pose2& sensor) {
    return std::abs(wrap_angle(sensor.theta_rad - radians(90.0))) <= radians(15.0) ? std::optional(1.5 - sensor.y_m)
                                                                                   : std::nullopt;
  }

  WallFinder finder_{{}};
  Pose2 robot_{0.0, 0.2, radians(4.0)};
  double stamp_s_ = 0.0;
  std::mt19937_64 random_{3};
  std::normal_distribution<double> normal_;
};

TEST_F(WallFinderTest, FindsAWallThatIsDrivenAlong) {
  const auto found = drive(0.9, wall);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->is_conservatively_straight);
  EXPECT_NEAR(found->bearing_rad, radians(86.0), 3.0 * std::sqrt(found->covariance(0, 0)));
  EXPECT_NEAR(found->distance_m, 1.5 - robot_.y_m, 0.1);
  EXPECT_LT(std::sqrt(found->covariance(0, 0)), radians(4.0));
}

TEST_F(WallFinderTest, TakesNoPoleForAStraightWall) {
  const auto found = drive(1.2, [](const Pose2& sensor) -> std::optional<double> {
    const Point way = Point(0.5, 0.9) - sensor.position();
    const double off_rad = wrap_angle(std::atan2(way.y(), way.x()) - sensor.theta_rad);
    return std::abs(off_rad) <= radians(15.0) ? std::optional(way.norm() - 0.05) : std::nullopt;
  });
  EXPECT_FALSE(found && found->is_conservatively_straight);
}

TEST_F(WallFinderTest, FindsNothingWithoutEchoesOrWhereItStands) {
  EXPECT_FALSE(drive(1.0, [](const Pose2&) { return std::nullopt; }));
  WallFinder standing({});
  for (int i = 0; i < 100; ++i) {
    Observation seen;
    RangeReading reading;
    reading.half_beam_rad = radians(15.0);
    reading.max_m = 5.0;
    reading.range_m = 1.0;
    seen.ranges.push_back(reading);
    standing.take(seen);
    EXPECT_FALSE(standing.is_due() && standing.find()) << "from one place every direction of the beam is as good";
  }
}

SeenWall seen_from(const Pose2& T_map_robot, double normal_rad, double at_m) {
  SeenWall seen;
  const Point normal(std::cos(normal_rad), std::sin(normal_rad));
  seen.bearing_rad = wrap_angle(normal_rad - T_map_robot.theta_rad);
  seen.distance_m = at_m - normal.dot(T_map_robot.position());
  seen.covariance.diagonal() << 1e-4, 1e-4;
  seen.begin_m = -0.5;
  seen.end_m = 0.5;
  seen.is_conservatively_straight = true;
  return seen;
}

TEST(PoseFilterWalls, HoldAgainstDriftWhereTheyWereMetFirst) {
  // There and back between two walls, with odometry that counts 5 % too much and turns 1 degree a metre.
  MotionNoise noise;
  noise.along_ratio = 0.05;
  noise.across_ratio = 0.01;
  noise.heading_rad_per_m = radians(2.0);
  PoseFilter with({}, {0.01, 0.01, 0.05, 0.0});
  PoseFilter without = with;
  Pose2 truth;
  for (int i = 0; i < 4000; ++i) {
    const Pose2 step{0.02 * (i / 100 % 2 == 0 ? 1.0 : -1.0), 0.0, 0.0};
    truth = truth * step;
    const Pose2 counted{1.05 * step.x_m, 0.0, radians(0.02)};
    with.predict(counted, noise);
    without.predict(counted, noise);
    if (i % 10 == 0) (void)with.meet(seen_from(truth, i % 20 == 0 ? 0.0 : radians(90.0), i % 20 == 0 ? 4.0 : 2.0), 3.5);
  }
  EXPECT_EQ(with.walls(), 2);
  EXPECT_LT((with.estimate().T_map_robot.position() - truth.position()).norm(), 0.05);
  EXPECT_LT(std::abs(with.estimate().T_map_robot.theta_rad), radians(1.5));
  EXPECT_GT((without.estimate().T_map_robot.position() - truth.position()).norm(), 0.2);
}

TEST(PoseFilterWalls, AreNeverMoreThanThereIsRoomFor) {
  PoseFilter filter({}, {0.01, 0.01, 0.0, 0.0});
  for (int i = 0; i < 200; ++i) (void)filter.meet(seen_from({}, 0.03 * i, 1.0 + i), 3.5);
  EXPECT_EQ(filter.walls(), PoseFilter::kMaxWalls);
  const Eigen::Matrix3d c = filter.estimate().covariance;
  EXPECT_GT(c.determinant(), 0.0);
}

}  // namespace
}  // namespace cairn::odometry_compass
