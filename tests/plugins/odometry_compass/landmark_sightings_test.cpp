#include "plugins/odometry_compass/landmark_sightings.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <optional>
#include <random>

#include "plugins/odometry_compass/outline_echo.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr double kSigma_m = 0.01;

// A robot that stands or drives while a fan of transducers looks at what there is; its odometry is right.
class LandmarkSightingsTest : public testing::Test {
 protected:
  LandmarkSightingsTest() { pose_.covariance.diagonal() << 1e-4, 1e-4, 1e-4; }

  LandmarkId put(const std::string& category, const Pose2& T_map_landmark) {
    Landmark landmark;
    landmark.category = category;
    landmark.T_map_landmark = T_map_landmark;
    const LandmarkId id = graph_.add(landmark);
    (void)sightings_.look({}, pose_, {}, {grid_, graph_});  // becomes known at this pose's covariance
    return id;
  }

  // 15 readings from the true pose; the robot believes to be at `believed`.
  std::vector<LandmarkSighting> look(const Pose2& truth, const Pose2& believed, double half_beam_rad = radians(15.0),
                                     double spread_rad = radians(12.0)) {
    Observation seen;
    seen.stamp_s = stamp_s_ += 0.5;
    seen.T_odom_robot = truth;
    for (int i = 0; i < 15; ++i) {
      RangeReading reading;
      const double share = i / 7.0 - 1.0;
      reading.T_robot_sensor = {0.1, 0.1 * share, spread_rad * share};
      reading.half_beam_rad = half_beam_rad;
      reading.min_m = 0.1;
      reading.max_m = 5.0;
      reading.range_m = 3.9;
      for (const auto& [id, landmark] : graph_.landmarks()) {
        const auto echo =
            expected_echo(landmark.category == "circle" ? circle_ : square_,
                          inverse(landmark.T_map_landmark) * (truth * reading.T_robot_sensor), half_beam_rad);
        if (echo) reading.range_m = std::min(reading.range_m, echo->range_m + kSigma_m * normal_(random_));
      }
      if (in_front_ && i % 4 == 0) reading.range_m = 0.4;
      seen.ranges.push_back(reading);
    }
    pose_.T_map_robot = believed;
    const auto reported = sightings_.look(seen, pose_, seen.T_odom_robot, {grid_, graph_});
    return {reported.begin(), reported.end()};
  }
  static Pose2 measured(const LandmarkSighting& seen) { return seen.T_map_landmark * inverse(seen.T_robot_landmark); }

  const Contour circle_ = Contour::circle(0.6);
  const Contour square_ = Contour::polygon({{-0.25, -0.25}, {0.25, -0.25}, {0.25, 0.25}, {-0.25, 0.25}});
  LandmarkSightings sightings_{{{"circle", circle_}, {"square", square_}}};
  LandmarkGraph graph_;
  OccupancyGrid grid_{0.05};
  PoseEstimate pose_;
  double stamp_s_ = 0.0;
  bool in_front_ = false;
  std::mt19937_64 random_{11};
  std::normal_distribution<double> normal_;
};

TEST_F(LandmarkSightingsTest, ReportHowFarOffTheRobotIs) {
  const LandmarkId id = put("circle", {3.0, 1.0, 0.0});
  const auto reported = look({1.5, 1.0, 0.0}, {1.42, 1.0, 0.0});
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(reported[0].landmark, id);
  EXPECT_NEAR(measured(reported[0]).x_m, 1.5, 0.03);
}

TEST_F(LandmarkSightingsTest, AreLongWhereOneSideSaysNothing) {
  put("square", {3.0, 1.0, 0.0});
  const auto reported = look({1.5, 1.0, 0.0}, {1.5, 1.0, 0.0}, radians(15.0), radians(3.0));
  ASSERT_EQ(reported.size(), 1U);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(reported[0].covariance.topLeftCorner<2, 2>());
  EXPECT_LT(std::sqrt(axes.eigenvalues()[0]), 0.05);
  EXPECT_GT(std::sqrt(axes.eigenvalues()[1]), 0.3);
  EXPECT_GT(std::abs(axes.eigenvectors().col(1).y()), 0.95) << "along the face";
}

TEST_F(LandmarkSightingsTest, HoldAgainstAPersonInFront) {
  put("circle", {3.0, 1.0, 0.0});
  in_front_ = true;
  const auto reported = look({1.5, 1.0, 0.0}, {1.42, 1.0, 0.0});
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_NEAR(measured(reported[0]).x_m, 1.5, 0.03);
}

TEST_F(LandmarkSightingsTest, AreNoneOfWhatIsTooFarOffOrHiddenOrInDoubt) {
  put("circle", {3.0, 1.0, 0.0});
  EXPECT_TRUE(look({1.5, 1.0, 0.0}, {0.8, 1.0, 0.0}).empty()) << "0.7 m off: of something else";
  for (int y = -20; y < 60; ++y) grid_.set_log_odds(grid_.cell_at({2.0, 0.05 * y}), log_odds_of(0.95));
  EXPECT_TRUE(look({1.5, 1.0, 0.0}, {1.45, 1.0, 0.0}).empty()) << "a wall stands between";
}

TEST_F(LandmarkSightingsTest, AreNoneBetweenTwoThatCompete) {
  put("circle", {3.0, 0.8, 0.0});
  put("circle", {3.0, 1.2, 0.0});
  EXPECT_TRUE(look({1.5, 1.0, 0.0}, {1.45, 1.0, 0.0}).empty());
}

TEST_F(LandmarkSightingsTest, AreNoneOfACategoryWithoutAShape) {
  put("circle", {3.0, 1.0, 0.0});
  graph_.find(1)->category = "place";
  EXPECT_TRUE(look({1.5, 1.0, 0.0}, {1.45, 1.0, 0.0}).empty());
}

TEST_F(LandmarkSightingsTest, CountFromWhereTheLandmarkWasWhenItBecameKnown) {
  put("circle", {3.0, 1.0, 0.0});
  const Pose2 before = graph_.find(1)->T_map_landmark;
  pose_.covariance *= 4.0;
  graph_.find(1)->T_map_landmark.x_m += 0.1;  // refined by a robot that has drifted
  (void)sightings_.look({}, pose_, {}, {grid_, graph_});
  graph_.find(1)->T_map_landmark = before;  // for the simulated readings
  auto reported = look({1.5, 1.0, 0.0}, {1.45, 1.0, 0.0});
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_EQ(reported[0].T_map_landmark, before);
  pose_.covariance /= 100.0;
  graph_.find(1)->T_map_landmark.x_m += 0.02;  // by one that knows where it is
  reported = look({1.5, 1.0, 0.0}, {1.45, 1.0, 0.0});
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_NEAR(reported[0].T_map_landmark.x_m, 3.02, 1e-12);
}

TEST_F(LandmarkSightingsTest, WorkForTheRaysOfALaser) {
  put("square", {3.0, 1.0, 0.3});
  const auto reported = look({1.5, 1.0, 0.0}, {1.45, 1.03, 0.02}, 0.0, radians(8.0));
  ASSERT_EQ(reported.size(), 1U);
  EXPECT_NEAR((inverse(reported[0].T_robot_landmark)).position().norm(),
              (Pose2{1.5, 1.0, 0.0}.position() - Point(3.0, 1.0)).norm(), 0.03);
}

TEST_F(LandmarkSightingsTest, HaveAnHonestCovariance) {
  put("circle", {0.0, 0.0, 0.0});
  double mean_squared = 0.0;
  Point mean_off(0.0, 0.0);
  int count = 0;
  for (int i = 0; i < 400; ++i) {
    const double around_rad = 0.01 * i;
    const Pose2 truth = Pose2{0.0, 0.0, around_rad} * Pose2{-1.3, 0.0, 0.0};
    const Pose2 believed = truth * Pose2{0.03 * normal_(random_), 0.03 * normal_(random_), 0.02 * normal_(random_)};
    for (const LandmarkSighting& seen : look(truth, believed)) {
      const Point off = seen.T_robot_landmark.position() - (inverse(truth) * seen.T_map_landmark).position();
      mean_squared += off.dot(seen.covariance.topLeftCorner<2, 2>().inverse() * off);
      mean_off += Point(off.x(), 0.0);  // ahead: across is hardly seen, and stays as it was believed
      ++count;
    }
  }
  ASSERT_GT(count, 200);
  EXPECT_LT(mean_squared / count, 3.0) << "2 for two numbers";
  EXPECT_LT(mean_off.norm() / count, 0.01);
}

}  // namespace
}  // namespace cairn::odometry_compass
