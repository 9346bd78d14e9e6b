#include "maps/store/tables/trajectory.hpp"

#include <cstring>

#include "maps/landmarks/landmark_graph.hpp"
#include "tests/maps/store/store_fixture.hpp"

namespace cairn::store {
namespace {

std::vector<Pose2> wandering(std::size_t poses) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> step(0.0, 0.05);
  std::vector<Pose2> trajectory{{150.0, -80.0, 3.1}};
  while (trajectory.size() < poses) {
    const Pose2& last = trajectory.back();
    trajectory.push_back({last.x_m + step(random), last.y_m + step(random), wrap_angle(last.theta_rad + step(random))});
  }
  return trajectory;
}

std::string refusal_of(const std::string& packed, std::size_t poses) {
  try {
    static_cast<void>(unpacked_trajectory(packed, poses));
  } catch (const StoreError& error) {
    return error.what();
  }
  return "unpacked";
}

TEST(MapStoreTrajectory, ComesBackToTheBit) {
  const double denormal = std::numeric_limits<double>::denorm_min();
  const std::vector<std::vector<Pose2>> trajectories{{},
                                                     {{0.0, 0.0, 0.0}},
                                                     {{0.0, -0.0, 0.0}},
                                                     {{1.1, -2.37, 3.14159}, {1e300, denormal, -1e-300}},
                                                     {{9e10, -9e10, 0.00001}, {-9e10, 9e10, -0.00001}},
                                                     {{9.1e10, 0.0, 0.0}},
                                                     wandering(1000),
                                                     in_whole_steps(wandering(1000))};
  for (const std::vector<Pose2>& trajectory : trajectories) {
    const std::vector<Pose2> back = unpacked_trajectory(packed_trajectory(trajectory), trajectory.size());
    ASSERT_EQ(back.size(), trajectory.size());
    if (!back.empty()) {
      EXPECT_EQ(std::memcmp(back.data(), trajectory.data(), back.size() * sizeof(Pose2)), 0);
    }
  }
}

TEST(MapStoreTrajectory, OfWholeStepsTakesAThirdOfTheBytes) {
  const std::vector<Pose2> exact = wandering(1000);
  EXPECT_GT(packed_trajectory(exact).size(), 20'000U);
  EXPECT_LT(packed_trajectory(in_whole_steps(exact)).size(), 8'000U);
}

TEST(MapStoreTrajectory, InWholeStepsIsNearAndStaysAsItIs) {
  const std::vector<Pose2> exact = wandering(1000);
  const std::vector<Pose2> rounded = in_whole_steps(exact);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(rounded[i].x_m, exact[i].x_m, 5.1e-6);
    EXPECT_NEAR(rounded[i].y_m, exact[i].y_m, 5.1e-6);
    EXPECT_NEAR(rounded[i].theta_rad, exact[i].theta_rad, 5.1e-6);
  }
  EXPECT_EQ(in_whole_steps(rounded), rounded);
  EXPECT_FALSE(std::signbit(in_whole_steps({{-1e-9, 0.0, 0.0}})[0].x_m));
}

TEST(MapStoreTrajectory, RefusesWhatHoldsAnotherNumberOfPoses) {
  const std::string steps = packed_trajectory({{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}});
  EXPECT_EQ(refusal_of(steps, 3), "its bytes end before its poses do");
  EXPECT_EQ(refusal_of(steps, 10'000'000), "its bytes end before its poses do");
  EXPECT_EQ(refusal_of(steps, 1), "more bytes follow its poses");
  EXPECT_EQ(refusal_of(steps, 0), "more bytes follow its poses");
  EXPECT_EQ(refusal_of("", 1), "its first byte is neither 0 nor 1");
  EXPECT_EQ(refusal_of("\x02zzz", 1), "its first byte is neither 0 nor 1");
  EXPECT_EQ(refusal_of(std::string(1, '\0') + "zzz", 1), "its bytes do not unpack to 24 bytes");
}

TEST(MapStoreTrajectory, RefusesNumbersThatNoTrajectoryHas) {
  const std::string endless = "\x01" + std::string(40, '\xff');
  EXPECT_EQ(refusal_of(endless, 1), "one of its numbers is too long");
  const std::string huge = "\x01" + std::string(8, '\xff') + "\x7f" + "\x01\x01";
  EXPECT_EQ(refusal_of(huge, 1), "one of its numbers is too large");
  EXPECT_EQ(refusal_of("\x01\x01\x01\x80", 1), "its bytes end before its poses do");
}

}  // namespace
}  // namespace cairn::store
