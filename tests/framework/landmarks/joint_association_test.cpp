#include "framework/landmarks/association/joint_association.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace cairn {
namespace {

constexpr double kPlaces_m2 = 0.01;
constexpr double kUnknown_per_m2 = 0.1;
constexpr int kNone = JointAssociation::kNone;

PlaceHypothesis hypothesis(LandmarkId id, const Point& off_m) {
  PlaceHypothesis one;
  one.landmark = {id, false};
  one.shift = {off_m, kPlaces_m2};
  one.since_placed = {off_m, 1.0};
  return one;
}

// A place that is so far from each landmark.
SeenPlace seen_at(double x_m, const std::vector<double>& landmarks_m, int matching) {
  SeenPlace place{matching, {}};
  for (std::size_t i = 0; i < landmarks_m.size(); ++i)
    place.hypotheses.push_back(hypothesis(static_cast<LandmarkId>(i + 1), {x_m - landmarks_m[i], 0.0}));
  return place;
}

TEST(JointAssociation, OnePlaceIsOfTheNearerLandmark) {
  const std::vector<SeenPlace> places = {seen_at(0.4, {0.0, 0.7}, 1)};
  EXPECT_EQ(associate_jointly(places, {{0, 0}, 0.09}, kUnknown_per_m2).chosen, std::vector{1});
}

TEST(JointAssociation, TwoPlacesShiftedAlikeAreTwinsAndNotOneOfThemAndANewOne) {
  const std::vector<SeenPlace> places = {seen_at(0.4, {0.0, 0.7}, 1), seen_at(1.1, {0.0, 0.7}, 2)};
  const JointAssociation joint = associate_jointly(places, {{0, 0}, 0.09}, kUnknown_per_m2);
  EXPECT_EQ(joint.chosen, (std::vector{0, 1}));
  EXPECT_NEAR(joint.shift.mean_m.x(), 0.4, 0.03);
  EXPECT_LT(joint.shift.variance_m2, kPlaces_m2);
}

TEST(JointAssociation, NoLandmarkIsAtTwoPlacesOfOneMatching) {
  const std::vector<SeenPlace> places = {seen_at(0.02, {0.0}, 1), seen_at(0.1, {0.0}, 1)};
  EXPECT_EQ(associate_jointly(places, {}, kUnknown_per_m2).chosen, (std::vector{0, kNone}));
  const std::vector<SeenPlace> later = {seen_at(0.02, {0.0}, 1), seen_at(0.1, {0.0}, 2)};
  EXPECT_EQ(associate_jointly(later, {}, kUnknown_per_m2).chosen, (std::vector{0, 0}));
}

TEST(JointAssociation, WhereTwoHaveNoRoomThereIsOne) {
  SeenPlace place = seen_at(0.45, {0.0}, 1);
  EXPECT_EQ(associate_jointly(std::vector{place}, {}, kUnknown_per_m2).chosen, std::vector{kNone});
  place.hypotheses[0].apart_m = 0.8;
  EXPECT_EQ(associate_jointly(std::vector{place}, {}, kUnknown_per_m2).chosen, std::vector{0});
}

TEST(JointAssociation, ALandmarkThatWasPlacedSinceThePoseShiftedSaysNothingOfTheShift) {
  SeenPlace place = seen_at(0.0, {0.0}, 1);
  place.hypotheses[0].tells_shift = false;
  place.hypotheses[0].since_placed.variance_m2 = kPlaces_m2;
  const JointAssociation joint = associate_jointly(std::vector{place}, {{0, 0}, 0.09}, kUnknown_per_m2);
  EXPECT_EQ(joint.chosen, std::vector{0});
  EXPECT_DOUBLE_EQ(joint.shift.variance_m2, 0.09);
}

// The density of all residuals together, each shifted by the same.
double log_joint_density(const std::vector<double>& residuals_m, double shift_m2) {
  const auto n = static_cast<Eigen::Index>(residuals_m.size());
  const Eigen::MatrixXd covariance =
      shift_m2 * Eigen::MatrixXd::Ones(n, n) + kPlaces_m2 * Eigen::MatrixXd::Identity(n, n);
  const Eigen::Map<const Eigen::VectorXd> r(residuals_m.data(), n);
  const double x = -0.5 * r.dot(covariance.inverse() * r) -
                   0.5 * std::log(std::pow(2.0 * std::acos(-1.0), static_cast<double>(n)) * covariance.determinant());
  const double y = -0.5 * std::log(std::pow(2.0 * std::acos(-1.0), static_cast<double>(n)) * covariance.determinant());
  return x + y;
}

TEST(JointAssociation, FindsTheBestOfAllAssignmentsByTheJointDensityOfTheirResiduals) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> at_m(-0.5, 1.5);
  for (int round = 0; round < 50; ++round) {
    const std::vector<double> landmarks_m = {0.0, 0.6, 1.0};
    std::vector<SeenPlace> places;
    for (int i = 0; i < 3; ++i) places.push_back(seen_at(at_m(random), landmarks_m, i));
    double best = -1e9;
    for (int assignment = 0; assignment < 64; ++assignment) {
      std::vector<double> residuals_m;
      double value = 0.0;
      for (int i = 0, rest = assignment; i < 3; ++i, rest /= 4) {
        if (rest % 4 == 3)
          value += std::log(kUnknown_per_m2);
        else
          residuals_m.push_back(
              places[static_cast<std::size_t>(i)].hypotheses[static_cast<std::size_t>(rest % 4)].shift.mean_m.x());
      }
      if (!residuals_m.empty()) value += log_joint_density(residuals_m, 0.09);
      best = std::max(best, value);
    }
    EXPECT_NEAR(associate_jointly(places, {{0, 0}, 0.09}, kUnknown_per_m2).log_likelihood, best, 1e-9);
  }
}

TEST(JointAssociation, SaysHowLikelyTheNextBestIs) {
  const std::vector<SeenPlace> places = {seen_at(0.34, {0.0, 0.7}, 1)};
  const JointAssociation joint = associate_jointly(places, {{0, 0}, 0.09}, kUnknown_per_m2);
  ASSERT_EQ(joint.best_with[0].size(), 3U);
  EXPECT_DOUBLE_EQ(joint.best_with[0][0], joint.log_likelihood);
  EXPECT_NEAR(joint.best_with[0][1], joint.log_likelihood, 0.1) << "nearly as near";
  EXPECT_DOUBLE_EQ(joint.best_with[0][2], std::log(kUnknown_per_m2));
}

}  // namespace
}  // namespace cairn
