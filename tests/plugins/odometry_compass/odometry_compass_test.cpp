#include "plugins/odometry_compass/odometry_compass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "plugins/odometry_compass/outline_echo.hpp"

namespace cairn::odometry_compass {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

RobotModel calibrated_robot() {
  RobotModel robot;
  robot.odometry_error = {0.01, 0.0, radians(0.5)};
  robot.compass_error = {radians(2.0), 0.0, 2.0};
  return robot;
}

Observation observed(const Pose2& T_odom_robot, std::optional<double> compass_rad = std::nullopt) {
  Observation observation;
  observation.T_odom_robot = T_odom_robot;
  observation.compass_rad = compass_rad;
  return observation;
}

OdometryCompass localizer(const Pose2& T_map_start = {}, const Config& config = {}) {
  return {config, calibrated_robot(), T_map_start};
}

LandmarkSighting sighting(const Pose2& T_map_landmark, const Pose2& T_map_robot) {
  LandmarkSighting seen;
  seen.T_map_landmark = T_map_landmark;
  seen.T_robot_landmark = inverse(T_map_robot) * T_map_landmark;
  seen.covariance = Eigen::Vector3d(1e-4, 1e-4, 1e-3).asDiagonal();
  return seen;
}

// Of a compass that has no bias, whatever its file leaves out.
Config without_bias() {
  Config config;
  config.unstated_bias_rad = 0.0;
  return config;
}

TEST(OdometryCompass, BeginsWhereTheMissionSaysWhateverTheOdometrysOrigin) {
  const Pose2 start{2.0, 3.0, 1.0};
  OdometryCompass at = localizer(start);
  EXPECT_EQ(at.update_by(observed({100.0, -50.0, 2.0}), {}).T_map_robot, start);
  const Pose2 moved = at.update_by(observed(Pose2{100.0, -50.0, 2.0} * Pose2{0.5, 0.0, 0.1}), {}).T_map_robot;
  const Pose2 expected = start * Pose2{0.5, 0.0, 0.1};
  EXPECT_NEAR(moved.x_m, expected.x_m, 1e-9);
  EXPECT_NEAR(moved.y_m, expected.y_m, 1e-9);
  EXPECT_NEAR(moved.theta_rad, expected.theta_rad, 1e-9);
}

TEST(OdometryCompass, SkipsOdometryThatIsNotFinite) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}), {});
  (void)at.update_by(observed({kNaN, 0.0, 0.0}), {});
  EXPECT_NEAR(at.update_by(observed({1.0, 0.0, 0.0}), {}).T_map_robot.x_m, 1.0, 1e-12);
}

TEST(OdometryCompass, GoesByOdometryAloneWithoutACompass) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}), {});
  (void)at.update_by(observed({}, kNaN), {});
  const PoseEstimate estimate = at.update_by(observed({4.0, 0.0, 0.0}), {});
  EXPECT_EQ(estimate.T_map_robot.theta_rad, 0.0);
  EXPECT_NEAR(std::sqrt(estimate.covariance(2, 2)), std::hypot(radians(0.5), radians(0.5) * 2.0), 1e-9);
}

TEST(OdometryCompass, LeavesTheCompassOutWhenAskedTo) {
  Config config;
  config.use_compass = false;
  OdometryCompass at = localizer({}, config);
  EXPECT_EQ(at.update_by(observed({}, 0.05), {}).T_map_robot.theta_rad, 0.0);
}

TEST(OdometryCompass, TurnsTowardsTheCompass) {
  OdometryCompass at = localizer({}, without_bias());
  for (int i = 0; i < 500; ++i) (void)at.update_by(observed({}, radians(1.0)), {});
  EXPECT_NEAR(at.update_by(observed({}, radians(1.0)), {}).T_map_robot.theta_rad, radians(1.0), radians(0.1));
}

TEST(OdometryCompass, RefusesAWildCompassReading) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}, 0.0), {});
  const PoseEstimate before = at.update_by(observed({}, 0.0), {});
  const PoseEstimate after = at.update_by(observed({}, 2.0), {});
  EXPECT_EQ(after.T_map_robot, before.T_map_robot);
  EXPECT_EQ(after.covariance, before.covariance);
}

Observation observed_at(double stamp_s, const Pose2& T_odom_robot, double compass_rad) {
  Observation observation = observed(T_odom_robot, compass_rad);
  observation.stamp_s = stamp_s;
  return observation;
}

TEST(OdometryCompass, BelievesACompassThatHasJumpedInTheEnd) {
  Config config;
  config.compass_refused_at_most_s = 2.0;
  OdometryCompass at = localizer({}, config);
  (void)at.update_by(observed_at(0.0, {}, 0.0), {});
  for (double s = 0.1; s < 2.05; s += 0.1)
    ASSERT_EQ(at.update_by(observed_at(s, {}, 2.0), {}).T_map_robot.theta_rad, 0.0);
  for (double s = 2.1; s < 2.6; s += 0.1) (void)at.update_by(observed_at(s, {}, 2.0), {});
  EXPECT_NEAR(at.update_by(observed_at(2.7, {}, 2.0), {}).T_map_robot.theta_rad, 2.0, 0.02);
}

TEST(OdometryCompass, IsNotTurnedByACompassThatJumpsAndComesBack) {
  OdometryCompass at = localizer();
  for (int i = 0; i < 600; ++i) {
    const double compass_rad = i >= 200 && i < 400 ? radians(25.0) : 0.0;
    const PoseEstimate estimate = at.update_by(observed_at(0.04 * i, {0.01 * i, 0.0, 0.0}, compass_rad), {});
    ASSERT_NEAR(estimate.T_map_robot.theta_rad, 0.0, radians(1.0)) << i;
  }
}

// Beyond the gate, too little for a jump: while the robot stands no wheel can have slipped.
TEST(OdometryCompass, IsNotTurnedWhileItStandsByWhatLooksLikeASlip) {
  OdometryCompass at = localizer();
  for (int i = 0; i < 100; ++i) (void)at.update_by(observed_at(0.04 * i, {0.01 * i, 0.0, 0.0}, 0.0), {});
  for (int i = 100; i < 150; ++i) (void)at.update_by(observed_at(0.04 * i, {1.0, 0.0, 0.0}, 0.0), {});
  for (int i = 150; i < 350; ++i) {
    const PoseEstimate estimate = at.update_by(observed_at(0.04 * i, {1.0, 0.0, 0.0}, radians(10.0)), {});
    ASSERT_NEAR(estimate.T_map_robot.theta_rad, 0.0, radians(1.0)) << i;
  }
}

// Encoders that begin anew: the compass has not moved.
TEST(OdometryCompass, AStepOfTheOdometryIsNotTheCompasss) {
  OdometryCompass at = localizer();
  for (int i = 0; i < 100; ++i) (void)at.update_by(observed_at(0.04 * i, {0.01 * i, 0.0, 0.0}, 0.0), {});
  PoseEstimate estimate;
  for (int i = 0; i < 100; ++i)
    estimate = at.update_by(observed_at(4.0 + 0.04 * i, {1.0 + 0.01 * i, 0.0, radians(60.0)}, 0.0), {});
  EXPECT_NEAR(estimate.T_map_robot.theta_rad, 0.0, radians(2.0));
}

// Once a second one wheel can turn the robot by more than any noise.
TEST(OdometryCompass, ASlipBetweenSlowReadingsIsNoJump) {
  OdometryCompass at = localizer({}, without_bias());
  Pose2 truth;
  Pose2 odometry;
  PoseEstimate estimate;
  for (int i = 0; i < 20; ++i) {
    const double lost_m = i >= 5 && i < 10 ? 0.06 : 0.0;
    odometry = odometry * Pose2{0.2, 0.0, 0.0};
    truth = truth * Pose2{0.2 - lost_m, 0.0, lost_m / calibrated_robot().radius_m};
    estimate = at.update_by(observed_at(1.0 * i, odometry, truth.theta_rad), {});
  }
  EXPECT_NEAR(wrap_angle(estimate.T_map_robot.theta_rad - truth.theta_rad), 0.0, radians(3.0));
}

// Left and right wheel, ahead and back: odometry counts what the wheel turns, the robot goes less far and turns.
TEST(OdometryCompass, FollowsAWheelThatSlips) {
  for (const double side : {1.0, -1.0})
    for (const double ahead : {1.0, -1.0}) {
      OdometryCompass at = localizer({}, without_bias());
      Pose2 truth;
      Pose2 odometry;
      PoseEstimate estimate;
      for (int i = 0; i < 400; ++i) {
        const bool slips = i >= 100 && i < 200;
        const double step_m = ahead * 0.012;
        const double lost_m = slips ? 0.35 * step_m : 0.0;  // of the robot's middle: 0.7 of one wheel's
        odometry = odometry * Pose2{step_m, 0.0, 0.0};
        truth = truth * Pose2{step_m - lost_m, 0.0, side * lost_m / calibrated_robot().radius_m};
        estimate = at.update_by(observed(odometry, truth.theta_rad), {});
      }
      EXPECT_NEAR(wrap_angle(estimate.T_map_robot.theta_rad - truth.theta_rad), 0.0, radians(2.0)) << side << ahead;
      const Point off_m = estimate.T_map_robot.position() - truth.position();
      EXPECT_LT(off_m.norm(), 0.2) << side << ahead;
      EXPECT_LT(std::abs(off_m.x()), 3.0 * std::sqrt(estimate.covariance(0, 0))) << side << ahead;
      EXPECT_LT(std::abs(off_m.y()), 3.0 * std::sqrt(estimate.covariance(1, 1))) << side << ahead;
    }
}

// A turn that odometry does not see would go into the bias, beyond what it can be.
TEST(OdometryCompass, KeepsTheBiasWithinWhatTheRobotsFileSays) {
  RobotModel robot = calibrated_robot();
  robot.compass_error.local_bias_rad = radians(5.0);
  const auto heading_after = [&](bool bound) {
    Config config;
    config.bound_bias = bound;
    OdometryCompass at(config, robot, {});
    PoseEstimate estimate;
    // Odometry goes straight on; the robot turns right by a degree in a metre, 10 degrees at the end.
    for (int i = 0; i < 1000; ++i) {
      const double heading_rad = -radians(10.0) * i / 1000.0;
      estimate = at.update_by(observed({0.01 * i, 0.0, 0.0}, heading_rad), {});
    }
    return estimate.T_map_robot.theta_rad;
  };
  EXPECT_LE(heading_after(true), radians(-4.5)) << "5 degrees of the 10 can be bias";
  EXPECT_LT(heading_after(true), heading_after(false) - radians(1.0));
}

TEST(OdometryCompass, ForgetsRefusalsAfterAGoodReading) {
  Config config;
  config.compass_refused_at_most_s = 2.0;
  OdometryCompass at = localizer({}, config);
  for (int i = 0; i < 200; ++i) (void)at.update_by(observed_at(0.1 * i, {}, i % 10 == 0 ? 0.0 : 2.0), {});
  EXPECT_NEAR(at.update_by(observed({}), {}).T_map_robot.theta_rad, 0.0, 0.01);
}

TEST(OdometryCompass, IsPulledBackByAKnownLandmark) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}), {});
  const Pose2 truth{20.08, 0.15, 0.0};
  const PoseEstimate drifted = at.update_by(observed({20.0, 0.0, 0.0}), {});
  const LandmarkSighting seen = sighting({21.0, 1.0, 0.7}, truth);
  const PoseEstimate corrected = at.update_by(observed({20.0, 0.0, 0.0}), {&seen, 1});
  const auto off = [&](const PoseEstimate& e) { return (e.T_map_robot.position() - truth.position()).norm(); };
  EXPECT_LT(off(corrected), off(drifted));
  EXPECT_LT(corrected.covariance(0, 0), drifted.covariance(0, 0));
  EXPECT_LT(corrected.covariance(1, 1), drifted.covariance(1, 1));
}

TEST(OdometryCompass, LearnsTheOdometrysScaleFromALandmark) {
  RobotModel robot = calibrated_robot();
  robot.odometry_error = {0.002, 0.05, radians(0.1)};
  OdometryCompass at(Config{}, robot, {});
  (void)at.update_by(observed({}), {});
  (void)at.update_by(observed({10.4, 0.0, 0.0}), {});  // counts 4 % too much: the robot stands at 10 m
  const LandmarkSighting seen = sighting({11.0, 0.5, 0.0}, {10.0, 0.0, 0.0});
  (void)at.update_by(observed({10.4, 0.0, 0.0}), {&seen, 1});
  EXPECT_NEAR(at.update_by(observed({20.8, 0.0, 0.0}), {}).T_map_robot.x_m, 20.0, 0.1);
}

TEST(OdometryCompass, RefusesTheWrongLandmark) {
  OdometryCompass at = localizer();
  const PoseEstimate before = at.update_by(observed({}), {});
  const LandmarkSighting wrong = sighting({4.0, 1.0, 0.0}, {1.5, 0.0, 0.0});
  const PoseEstimate after = at.update_by(observed({}), {&wrong, 1});
  EXPECT_EQ(after.T_map_robot, before.T_map_robot);
}

TEST(OdometryCompass, RefusesSightingsThatAreNoMeasurement) {
  OdometryCompass at = localizer();
  const PoseEstimate before = at.update_by(observed({}), {});
  std::vector<LandmarkSighting> bad(4, sighting({4.0, 1.0, 0.0}, {0.01, 0.0, 0.0}));
  bad[0].T_robot_landmark.x_m = kNaN;
  bad[1].covariance(0, 0) = kNaN;
  bad[2].covariance.setZero();
  bad[3].covariance(0, 0) = -1.0;
  const PoseEstimate after = at.update_by(observed({}), bad);
  EXPECT_EQ(after.T_map_robot, before.T_map_robot);
  EXPECT_EQ(after.covariance, before.covariance);
}

TEST(OdometryCompass, HeedsALandmarksOrientationOnlyWhenAskedTo) {
  Config with_heading;
  with_heading.use_landmark_heading = true;
  with_heading.start_heading_rad = radians(10.0);
  Config without = with_heading;
  without.use_landmark_heading = false;
  // The landmark is seen where it should be, yet turned by 5 degrees: so the robot is.
  LandmarkSighting turned = sighting({1.0, 0.0, 0.0}, {});
  turned.T_robot_landmark.theta_rad = radians(-5.0);
  turned.covariance.topLeftCorner<2, 2>() = Eigen::Matrix2d::Identity();
  turned.covariance(2, 2) = 1e-6;
  EXPECT_NEAR(localizer({}, with_heading).update_by(observed({}), {&turned, 1}).T_map_robot.theta_rad, radians(5.0),
              0.001);
  EXPECT_NEAR(localizer({}, without).update_by(observed({}), {&turned, 1}).T_map_robot.theta_rad, 0.0, 0.001);
}

TEST(OdometryCompass, BelievesSightingsThatAgreeInTheEnd) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}), {});
  const Pose2 carried_to{1.5, 0.4, 0.0};
  const LandmarkSighting seen = sighting({4.0, 1.0, 0.0}, carried_to);
  for (int i = 1; i < Config{}.landmark_refusals; ++i) {
    const PoseEstimate estimate = at.update_by(observed({}), {&seen, 1});
    ASSERT_EQ(estimate.sightings_refused, 1);
    ASSERT_EQ(estimate.T_map_robot.x_m, 0.0) << i;
  }
  const PoseEstimate estimate = at.update_by(observed({}), {&seen, 1});
  EXPECT_EQ(estimate.sightings_used, 1);
  EXPECT_NEAR((estimate.T_map_robot.position() - carried_to.position()).norm(), 0.0, 0.05);
}

TEST(OdometryCompass, NeverBelievesSightingsThatDisagree) {
  OdometryCompass at = localizer();
  (void)at.update_by(observed({}), {});
  for (int i = 0; i < 100; ++i) {
    const LandmarkSighting seen = sighting({4.0, 1.0, 0.0}, {1.5 + 0.5 * (i % 3), 0.4, 0.0});
    EXPECT_EQ(at.update_by(observed({}), {&seen, 1}).T_map_robot.x_m, 0.0);
  }
}

TEST(OdometryCompass, DescribesAllItsSettings) {
  const Schema schema = schema_of<Config>();
  EXPECT_EQ(schema.fields.size(), 22U);
  for (const FieldSpec& field : schema.fields) EXPECT_FALSE(field.meaning.empty()) << field.key;
}

// A square of 0.5 m ahead and transducers that hear it; the odometry counts twice the distance that the robot drives.
class KnownLandmark : public testing::Test {
 protected:
  KnownLandmark() {
    Landmark landmark;
    landmark.category = "square";
    landmark.T_map_landmark = kLandmark;
    (void)graph_.add(landmark);
  }
  [[nodiscard]] Observation seen_from(const Pose2& T_map_robot, const Pose2& T_odom_robot, double stamp_s) const {
    Observation seen = observed(T_odom_robot, T_map_robot.theta_rad);
    seen.stamp_s = stamp_s;
    for (int i = -7; i <= 7; ++i) {
      RangeReading reading{.T_robot_sensor = {0.1, 0.01 * i, radians(2.0 * i)}, .half_beam_rad = radians(15.0)};
      reading.min_m = 0.1;
      reading.max_m = 5.0;
      const auto echo = expected_echo(shapes_[0].contour, inverse(kLandmark) * (T_map_robot * reading.T_robot_sensor),
                                      reading.half_beam_rad);
      reading.range_m = echo ? echo->range_m : 4.5;
      seen.ranges.push_back(reading);
    }
    return seen;
  }
  // Where the localizer says that the robot is at last; it stands at x = 0.1 m.
  double x_m_with(Config config) {
    config.use_walls = false;
    config.min_distance_ratio = 0.5;
    OdometryCompass at(config, calibrated_robot(), {}, shapes_);
    PoseEstimate estimate = at.update(seen_from({}, {}, 0.0), {grid_, graph_});
    for (int i = 1; i < 20; ++i) {
      const double x_m = 0.1 * i / 19.0;
      estimate = at.update(seen_from({x_m, 0.0, 0.0}, {2.0 * x_m, 0.0, 0.0}, 0.5 * i), {grid_, graph_});
      used_ += estimate.sightings_used;
    }
    return estimate.T_map_robot.x_m;
  }
  static constexpr Pose2 kLandmark{1.5, 0.0, 0.0};
  const std::vector<LandmarkShape> shapes_{
      {"square", Contour::polygon({{0.0, 0.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}})}};
  const OccupancyGrid grid_{0.05};
  LandmarkGraph graph_;
  int used_ = 0;
};

TEST_F(KnownLandmark, SeenAgainCorrectsThePose) {
  EXPECT_NEAR(x_m_with({}), 0.1, 0.02);
  EXPECT_GT(used_, 5);
}

TEST_F(KnownLandmark, CorrectsNothingWhenLandmarksAreNotToBeUsed) {
  Config config;
  config.use_landmarks = false;
  EXPECT_NEAR(x_m_with(config), 0.2, 0.001);
  EXPECT_EQ(used_, 0);
}

}  // namespace
}  // namespace cairn::odometry_compass
