#include "framework/contracts/view/speed_law.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace cairn {
namespace {

constexpr double kMax_mps = 0.4;

// By its definition, over many clearances.
double mean_pace(const SpeedLaw& law, double clearance_m, double top_mps) {
  constexpr int kParts = 20000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double at_m = clearance_m + law.spread_m * (2.0 * (i + 0.5) / kParts - 1.0);
    sum += 1.0 / std::min(top_mps, allowed_speed_mps(at_m, kMax_mps, law));
  }
  return sum / kParts;
}

TEST(SpeedLaw, TheZonesOfTheMonitorAndTheControllerLieInsideEachOther) {
  const SpeedLaw law;
  EXPECT_EQ(allowed_speed_mps(0.151, kMax_mps, law), kMax_mps);
  EXPECT_EQ(allowed_speed_mps(0.149, kMax_mps, law), 0.4 * kMax_mps);
  EXPECT_EQ(allowed_speed_mps(0.07, kMax_mps, law), 0.4 * kMax_mps);
  EXPECT_EQ(allowed_speed_mps(0.069, kMax_mps, law), 0.12);
  EXPECT_EQ(allowed_speed_mps(0.05, kMax_mps, law), 0.12);
  EXPECT_EQ(allowed_speed_mps(0.049, kMax_mps, law), 0.04);
  EXPECT_EQ(allowed_speed_mps(-1.0, kMax_mps, law), 0.04);
}

TEST(SpeedLaw, ARobotThatIsSlowerThanAZoneIsNotMadeFaster) {
  for (const double clearance_m : {-0.1, 0.0, 0.06, 0.1, 1.0})
    EXPECT_LE(allowed_speed_mps(clearance_m, 0.03, SpeedLaw{}), 0.03);
}

TEST(DrivingPace, IsTheMeanOverWhatAPlannedClearanceMayBeOffBy) {
  SpeedLaw other;
  other.tight_m = 0.3;  // wider than the slow zone
  other.spread_m = 0.04;
  SpeedLaw without;
  without.tight_m = 0.0;  // inside the margin
  for (const SpeedLaw& law : {SpeedLaw{}, other, without})
    for (const double top_mps : {0.4, 0.25, 0.1}) {
      const DrivingPace pace(law, kMax_mps, top_mps);
      for (double clearance_m = -0.2; clearance_m < 0.5; clearance_m += 0.013) {
        const double mean = mean_pace(law, clearance_m, top_mps);
        EXPECT_NEAR(pace.s_per_m(clearance_m), mean, 2e-3 * mean) << clearance_m << " m, " << top_mps << " m/s";
      }
    }
}

TEST(DrivingPace, NeverRisesWithTheClearanceAndEndsAtThatOfTheOpen) {
  const DrivingPace pace(SpeedLaw{}, kMax_mps);
  double before = std::numeric_limits<double>::infinity();
  for (double clearance_m = -0.3; clearance_m < 0.4; clearance_m += 0.001) {
    EXPECT_LE(pace.s_per_m(clearance_m), before);
    before = pace.s_per_m(clearance_m);
  }
  EXPECT_EQ(pace.min_s_per_m(), 1.0 / kMax_mps);
  EXPECT_NEAR(pace.s_per_m(pace.open_from_m()), pace.min_s_per_m(), 1e-12);
  EXPECT_GT(pace.s_per_m(pace.open_from_m() - 0.01), pace.min_s_per_m());
}

TEST(DrivingPace, ADriveThatIsAskedToBeSlowGainsLessFromRoom) {
  const DrivingPace fast(SpeedLaw{}, kMax_mps);
  const DrivingPace slow(SpeedLaw{}, kMax_mps, 0.2);
  EXPECT_EQ(slow.min_s_per_m(), 5.0);
  EXPECT_LT(slow.s_per_m(0.1) / slow.min_s_per_m(), fast.s_per_m(0.1) / fast.min_s_per_m());
}

}  // namespace
}  // namespace cairn
