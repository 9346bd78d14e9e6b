#include "plugins/simulated_robot/battery.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Battery, WithoutSettingsNeverRunsEmptyAndReadsNothing) {
  Battery battery(std::nullopt);
  battery.drain(1.0, 1e9);
  EXPECT_FALSE(battery.is_empty());
  EXPECT_FALSE(battery.reading());
}

TEST(Battery, DrainsByStandingAndByTheMoreTheFasterTheRobotGoes) {
  Battery battery(BatteryConfig{100.0, 50.0, 1.0});
  battery.drain(0.0, 10.0);
  EXPECT_NEAR(*battery.reading(), 0.9, 1e-12);
  battery.drain(0.5, 10.0);
  EXPECT_NEAR(*battery.reading(), 0.75, 1e-12);
  battery.drain(3.0, 10.0);
  EXPECT_NEAR(*battery.reading(), 0.55, 1e-12) << "no faster than at full speed";
}

TEST(Battery, IsEmptyAtZeroAndStaysThere) {
  Battery battery(BatteryConfig{100.0, 50.0, 0.5});
  battery.drain(0.0, 200.0);
  EXPECT_TRUE(battery.is_empty());
  EXPECT_EQ(*battery.reading(), 0.0);
}

}  // namespace
}  // namespace cairn
