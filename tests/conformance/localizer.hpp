// Conformance of modules of kind `localizer`. Include in one file of a test program and instantiate:
//
//   namespace cairn::conformance {
//   INSTANTIATE_TEST_SUITE_P(MyLocalizer, LocalizerConformance,
//                            testing::Values(module<cairn::Localizer>(FOLDER, "my_localizer")));
//   }
#pragma once

#include <Eigen/Eigenvalues>

#include "maps/geometry/segments.hpp"
#include "tests/conformance/allocations.hpp"
#include "tests/conformance/fixtures.hpp"
#include "tests/conformance/subject.hpp"
#include "tests/conformance/texts.hpp"

namespace cairn::conformance {

class LocalizerConformance : public Conformance<Localizer> {
 protected:
  [[nodiscard]] std::vector<DriveStep> drive() const { return drive_through_room(setup().robot); }

  static std::vector<PoseEstimate> follow(Localizer& localizer, const std::vector<DriveStep>& steps) {
    std::vector<PoseEstimate> estimates;
    for (const DriveStep& step : steps) estimates.push_back(localizer.update(step.observation, {}));
    return estimates;
  }
  // What is wrong with an estimate, or empty.
  static std::string fault_of(const PoseEstimate& estimate) {
    if (!is_finite(estimate.T_map_robot)) return "the pose is not finite: " + text_of(estimate);
    if (std::abs(estimate.T_map_robot.theta_rad) > std::numbers::pi)
      return "theta_rad is not in (-pi, pi]: " + text_of(estimate);
    const Eigen::Matrix3d& c = estimate.covariance;
    if (!c.allFinite()) return "the covariance is not finite: " + text_of(estimate);
    const double scale = std::max(c.cwiseAbs().maxCoeff(), 1e-300);
    if ((c - c.transpose()).cwiseAbs().maxCoeff() > 1e-9 * scale)
      return "the covariance is not symmetric (use Joseph's form, or symmetrise): " + text_of(estimate);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(c / scale, Eigen::EigenvaluesOnly);
    if (eigen.eigenvalues().minCoeff() < -1e-9)
      return "the covariance has a negative eigenvalue, so some error would have a negative variance: " +
             text_of(estimate);
    return {};
  }
  // The robot at the start sees a landmark one metre ahead.
  static LandmarkSighting sighting() {
    LandmarkSighting seen;
    seen.landmark = 1;
    seen.T_map_landmark = kRoomStart * Pose2{1.0, 0.0, 0.0};
    seen.T_robot_landmark = {1.0, 0.0, 0.0};
    seen.covariance = 0.01 * Eigen::Matrix3d::Identity();
    return seen;
  }
  static std::vector<LandmarkSighting> odd_sightings() {
    std::vector<LandmarkSighting> odd;
    for (const Pose2& pose : odd_poses()) {
      odd.push_back(sighting());
      odd.back().T_map_landmark = pose;
      odd.push_back(sighting());
      odd.back().T_robot_landmark = pose;
    }
    for (const double variance : {0.0, -1.0, kNan, kInfinity, kHuge}) {
      odd.push_back(sighting());
      odd.back().covariance = variance * Eigen::Matrix3d::Identity();
    }
    odd.push_back(sighting());
    odd.back().covariance = Eigen::Matrix3d::Ones();  // singular
    odd.push_back(sighting());
    odd.back().covariance(0, 1) = 5.0;  // neither symmetric nor positive
    return odd;
  }
  static std::vector<Observation> odd_observations() {
    std::vector<Observation> odd;
    for (const Pose2& pose : odd_poses()) {
      Observation seen;
      seen.T_odom_robot = pose;
      odd.push_back(seen);
    }
    for (const double compass_rad : {kNan, kInfinity, -kInfinity, kHuge}) {
      Observation seen;
      seen.compass_rad = compass_rad;
      odd.push_back(seen);
    }
    for (const double stamp_s : {kNan, kInfinity, -kInfinity, kHuge, 0.0, 0.0}) {
      Observation seen;
      seen.stamp_s = stamp_s;
      odd.push_back(seen);
    }
    return odd;
  }
};

TEST_P(LocalizerConformance, IsMadeTwiceAndDestroyedUnused) {
  const auto first = make();
  const auto second = make();
  EXPECT_NE(first, second) << "a factory makes a new object each time";
}

TEST_P(LocalizerConformance, OutlivesTheLibraryThatMadeIt) {
  const auto localizer = GetParam().make_outliving_library();
  EXPECT_EQ(fault_of(follow(*localizer, drive()).back()), "");
}

TEST_P(LocalizerConformance, FollowsAnErrorlessDrive) {
  const auto localizer = make();
  const std::vector<DriveStep> steps = drive();
  const std::vector<PoseEstimate> estimates = follow(*localizer, steps);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const Pose2 off = inverse(steps[i].T_map_robot) * estimates[i].T_map_robot;
    ASSERT_LT(off.position().norm(), 0.5) << "at " << steps[i].observation.stamp_s << " s; the drive begins at "
                                          << text_of(kRoomStart) << ", which is LocalizerContext::T_map_start";
    ASSERT_LT(std::abs(off.theta_rad), radians(20.0)) << "at " << steps[i].observation.stamp_s << " s";
  }
}

TEST_P(LocalizerConformance, CovarianceIsSymmetricPositiveAndFinite) {
  const auto localizer = make();
  for (const PoseEstimate& estimate : follow(*localizer, drive())) ASSERT_EQ(fault_of(estimate), "");
}

TEST_P(LocalizerConformance, UncertaintyGrowsWithDriving) {
  const auto localizer = make();
  const std::vector<PoseEstimate> estimates = follow(*localizer, drive());
  const auto spread = [](const PoseEstimate& e) { return e.covariance(0, 0) + e.covariance(1, 1); };
  EXPECT_GT(spread(estimates.back()), spread(estimates.front()))
      << "after 14 m without a landmark the position cannot be as certain as at the start";
}

TEST_P(LocalizerConformance, ALandmarkSeenAgainDoesNotSpoilTheEstimate) {
  const auto localizer = make();
  Observation seen;
  seen.compass_rad = kRoomStart.theta_rad;
  PoseEstimate estimate;
  for (int i = 0; i < 20; ++i) {
    seen.stamp_s = 0.1 * i;
    estimate = localizer->update(seen, std::vector{sighting(), sighting()});
    ASSERT_EQ(fault_of(estimate), "");
  }
  EXPECT_LT((inverse(kRoomStart) * estimate.T_map_robot).position().norm(), 0.1)
      << "the robot stands at its start and a known landmark confirms it";
}

TEST_P(LocalizerConformance, TheSameDriveGivesTheSameEstimates) {
  const auto first = make(7);
  const auto second = make(7);
  EXPECT_EQ(text_of(follow(*first, drive())), text_of(follow(*second, drive())))
      << "the answer must depend on config, seed and input only";
}

TEST_P(LocalizerConformance, TwoObjectsShareNothing) {
  const std::vector<DriveStep> steps = drive();
  const auto alone = make(7);
  const std::vector<PoseEstimate> expected = follow(*alone, steps);
  const auto localizer = make(7);
  const auto other = make(7);
  std::vector<PoseEstimate> estimates;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    (void)other->update(steps[steps.size() - 1 - i].observation, std::vector{sighting()});
    estimates.push_back(localizer->update(steps[i].observation, {}));
  }
  EXPECT_EQ(text_of(estimates), text_of(expected)) << "another object of the module changed this one's estimate";
}

TEST_P(LocalizerConformance, OddObservationsLeaveAFiniteEstimate) {
  for (const Observation& odd : odd_observations()) {
    const auto localizer = make();
    (void)localizer->update(Observation{}, {});
    SensorStep step;
    step.state = SensorState::observation;
    step.observation = odd;
    ASSERT_EQ(fault_of(localizer->update(odd, {})), "") << "after " << text_of(step);
    ASSERT_EQ(fault_of(localizer->update(Observation{}, {})), "") << "one step after " << text_of(step);
  }
}

TEST_P(LocalizerConformance, AnOddFirstObservationLeavesAFiniteEstimate) {
  for (const Observation& odd : odd_observations()) {
    const auto localizer = make();
    ASSERT_EQ(fault_of(localizer->update(odd, {})), "");
    ASSERT_EQ(fault_of(follow(*localizer, drive()).back()), "");
  }
}

TEST_P(LocalizerConformance, OddSightingsLeaveAFiniteEstimate) {
  for (const LandmarkSighting& odd : odd_sightings()) {
    const auto localizer = make();
    (void)localizer->update(Observation{}, {});
    ASSERT_EQ(fault_of(localizer->update(Observation{}, std::vector{odd})), "")
        << "landmark at " << text_of(odd.T_map_landmark) << ", seen at " << text_of(odd.T_robot_landmark)
        << ", covariance " << odd.covariance;
  }
}

TEST_P(LocalizerConformance, FollowsOnAfterReadingsThatAreNotFinite) {
  const auto localizer = make();
  std::vector<DriveStep> steps = drive();
  for (std::size_t i = 10; i < 20; ++i) {
    steps[i].observation.T_odom_robot.x_m = kNan;
    steps[i].observation.compass_rad = kNan;
  }
  const std::vector<PoseEstimate> estimates = follow(*localizer, steps);
  const Pose2 off = inverse(steps.back().T_map_robot) * estimates.back().T_map_robot;
  EXPECT_LT(off.position().norm(), 0.5) << "ten bad observations on the way: the next good odometry says where it is";
}

TEST_P(LocalizerConformance, AllocatesNothing) {
  const auto localizer = make();
  const std::vector<DriveStep> steps = drive();
  const std::vector<LandmarkSighting> sightings{sighting()};
  for (const DriveStep& step : steps) (void)localizer->update(step.observation, sightings);
  const AllocationCount allocations;
  for (const DriveStep& step : steps) (void)localizer->update(step.observation, sightings);
  EXPECT_EQ(allocations.count(), 0) << "update() is hot: keep its buffers as members";
}

}  // namespace cairn::conformance
