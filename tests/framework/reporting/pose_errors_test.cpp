#include "framework/reporting/pose_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cairn {
namespace {

const OccupancyGrid kGrid(0.05);
const LandmarkGraph kGraph;
const RobotModel kRobot;

// A tick in which the estimate is off by so much in x and in heading, with standard deviations of 0.1 m and 0.1 rad.
void note(PoseErrors& errors, double time_s, double off_m, double off_rad = 0.0, bool truth_is_known = true) {
  Observation seen;
  const Pose2 estimate{1.0, 2.0, std::numbers::pi - 0.01};
  std::optional<Pose2> truth;
  if (truth_is_known) truth = Pose2{1.0 + off_m, 2.0, wrap_angle(estimate.theta_rad + off_rad)};
  PoseEstimate pose{estimate, 0.01 * Eigen::Matrix3d::Identity()};
  pose.sightings_used = 2;
  pose.sightings_refused = 1;
  errors.note({kGrid, kGraph, kRobot, pose, time_s, &seen}, truth);
}

TEST(PoseErrors, ThereAreNoneWhereTheTruthIsNotKnown) {
  PoseErrors errors;
  note(errors, 0.0, 0.1, 0.0, false);
  EXPECT_FALSE(errors.figures());
  errors.note({kGrid, kGraph, kRobot, {}, 1.0, nullptr}, std::nullopt);
  EXPECT_FALSE(errors.figures());
}

TEST(PoseErrors, SamplesOnceASecondAndCountsEverySighting) {
  PoseErrors errors;
  for (int tick = 0; tick <= 100; ++tick) note(errors, 0.04 * tick, 0.1);
  EXPECT_EQ(errors.samples().size(), 5U);
  EXPECT_EQ(errors.figures()->corrections, 202);
  EXPECT_EQ(errors.figures()->refused, 101);
}

TEST(PoseErrors, ReportsTheMedianTheTailTheWorstAndTheLast) {
  PoseErrors errors;
  for (int i = 0; i <= 100; ++i) note(errors, i, 0.01 * ((37 * i) % 101), 0.001 * i);  // 0 to 1 m, in disorder
  const PoseErrorFigures figures = *errors.figures();
  EXPECT_NEAR(figures.median_m, 0.5, 1e-9);
  EXPECT_NEAR(figures.p95_m, 0.95, 1e-9);
  EXPECT_NEAR(figures.worst_m, 1.0, 1e-9);
  EXPECT_NEAR(figures.last_m, 0.01 * ((37 * 100) % 101), 1e-9);
  EXPECT_NEAR(figures.median_deg, degrees(0.05), 1e-9) << "across the turn of the angle too";
  EXPECT_NEAR(figures.worst_deg, degrees(0.1), 1e-9);
}

TEST(PoseErrors, OfALongRunFewerSamplesStayButTheWorstAndTheLastAreExact) {
  PoseErrors errors(100);
  for (int second = 0; second < 10000; ++second) note(errors, second, second == 777 ? 2.0 : 0.1 + 1e-6 * second);
  EXPECT_LE(errors.samples().size(), 100U);
  EXPECT_NEAR(errors.samples()[1].time_s - errors.samples()[0].time_s, 128.0, 1e-9);
  EXPECT_NEAR(errors.figures()->worst_m, 2.0, 1e-9);
  EXPECT_NEAR(errors.figures()->last_m, 0.109999, 1e-9);
  EXPECT_NEAR(errors.figures()->median_m, 0.105, 1e-4);
}

TEST(PoseErrors, MeasuresTheErrorByTheEstimatesOwnDeviations) {
  PoseErrors errors;
  note(errors, 0.0, 0.3, -0.4);
  EXPECT_NEAR(errors.samples().front().sigmas, 5.0, 1e-6);
  EXPECT_NEAR(errors.samples().front().error_rad, 0.4, 1e-9);
}

}  // namespace
}  // namespace cairn
