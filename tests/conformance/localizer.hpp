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

  [[nodiscard]] KnownMap nothing_known() const { return {unknown_grid_, no_landmarks_}; }
  // The room as it is, with its post as a landmark.
  [[nodiscard]] KnownMap room_known() const { return {room_grid_, post_}; }
  [[nodiscard]] std::vector<PoseEstimate> follow(Localizer& localizer, const std::vector<DriveStep>& steps) const {
    return follow(localizer, steps, nothing_known());
  }
  static std::vector<PoseEstimate> follow(Localizer& localizer, const std::vector<DriveStep>& steps,
                                          const KnownMap& known) {
    std::vector<PoseEstimate> estimates;
    for (const DriveStep& step : steps) estimates.push_back(localizer.update(step.observation, known));
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
  static LandmarkGraph landmark_at(const Pose2& T_map_landmark) {
    LandmarkGraph graph;
    Landmark landmark;
    landmark.category = "post";
    landmark.T_map_landmark = T_map_landmark;
    (void)graph.add(landmark);
    return graph;
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

 private:
  const OccupancyGrid unknown_grid_{0.05};
  const LandmarkGraph no_landmarks_{};
  const OccupancyGrid room_grid_ = grid_of_room(0.05);
  const LandmarkGraph post_ = landmark_at(kPostOfRoom);
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
      << "after 14 m with nothing known of the map the position cannot be as certain as at the start";
}

TEST_P(LocalizerConformance, AKnownMapDoesNotSpoilTheEstimate) {
  const auto localizer = make();
  const std::vector<DriveStep> steps = drive();
  const std::vector<PoseEstimate> estimates = follow(*localizer, steps, room_known());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    ASSERT_EQ(fault_of(estimates[i]), "");
    ASSERT_LT((inverse(steps[i].T_map_robot) * estimates[i].T_map_robot).position().norm(), 0.2)
        << "at " << steps[i].observation.stamp_s << " s; the map, with its landmark, and the drive are without error";
  }
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
    (void)other->update(steps[steps.size() - 1 - i].observation, room_known());
    estimates.push_back(localizer->update(steps[i].observation, nothing_known()));
  }
  EXPECT_EQ(text_of(estimates), text_of(expected)) << "another object of the module changed this one's estimate";
}

TEST_P(LocalizerConformance, OddObservationsLeaveAFiniteEstimate) {
  for (const Observation& odd : odd_observations()) {
    const auto localizer = make();
    (void)localizer->update(Observation{}, nothing_known());
    SensorStep step;
    step.state = SensorState::observation;
    step.observation = odd;
    ASSERT_EQ(fault_of(localizer->update(odd, nothing_known())), "") << "after " << text_of(step);
    ASSERT_EQ(fault_of(localizer->update(Observation{}, nothing_known())), "") << "one step after " << text_of(step);
  }
}

TEST_P(LocalizerConformance, AnOddFirstObservationLeavesAFiniteEstimate) {
  for (const Observation& odd : odd_observations()) {
    const auto localizer = make();
    ASSERT_EQ(fault_of(localizer->update(odd, nothing_known())), "");
    ASSERT_EQ(fault_of(follow(*localizer, drive()).back()), "");
  }
}

TEST_P(LocalizerConformance, ALandmarkAtAnOddPlaceLeavesAFiniteEstimate) {
  for (const Pose2& odd : {Pose2{kHuge, 0.0, 0.0}, Pose2{0.0, -kHuge, 1.0}, Pose2{1e18, 1e18, kHuge}, kRoomStart}) {
    const auto localizer = make();
    const LandmarkGraph graph = landmark_at(odd);
    const KnownMap known{room_known().grid, graph};
    for (const PoseEstimate& estimate : follow(*localizer, drive(), known))
      ASSERT_EQ(fault_of(estimate), "") << "with a landmark at " << text_of(odd);
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
  if (localizer->history() != nullptr) GTEST_SKIP() << "it keeps the past, which grows";
  const std::vector<DriveStep> steps = drive();
  for (const DriveStep& step : steps) (void)localizer->update(step.observation, room_known());
  const AllocationCount allocations;
  for (const DriveStep& step : steps) (void)localizer->update(step.observation, room_known());
  EXPECT_EQ(allocations.count(), 0) << "update() is hot: keep its buffers as members";
}

TEST_P(LocalizerConformance, AHistoryHasAPoseForEachObservationAndEndsWhereTheLatestEstimateIs) {
  const auto localizer = make();
  PoseHistory* const history = localizer->history();
  if (history == nullptr) GTEST_SKIP() << "it never corrects its past";
  for (const DriveStep& step : drive()) {
    const PoseEstimate estimate = localizer->update(step.observation, nothing_known());
    EXPECT_NEAR((history->poses().back().position() - estimate.T_map_robot.position()).norm(), 0.0, 1e-9);
  }
  int parts = 0;
  while (history->finish_part()) ASSERT_LT(++parts, 100000) << "finish_part() must come to an end";
  const std::vector<Pose2> poses = history->poses();
  ASSERT_EQ(poses.size(), drive().size());
  for (const Pose2& pose : poses) EXPECT_TRUE(is_finite(pose));
}

}  // namespace cairn::conformance
