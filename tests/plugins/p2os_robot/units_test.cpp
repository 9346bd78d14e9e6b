#include "plugins/p2os_robot/units.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace cairn::p2os_robot {
namespace {

TEST(Units, AreThoseOfTheModel) {
  const Units pioneer1 = *units_of("psos1m");
  EXPECT_NEAR(pioneer1.position_m, 5.066e-5, 1e-12);
  EXPECT_NEAR(pioneer1.heading_rad, 0.0061359, 1e-6);
  EXPECT_NEAR(pioneer1.range_m, 1.734e-4, 1e-12);
  EXPECT_FALSE(pioneer1.has_motor_switch);
  EXPECT_NEAR(units_of("P3DX-SH")->heading_rad, 0.001534, 1e-6);
  EXPECT_NEAR(units_of("P3DX-SH")->position_m, 1e-3, 1e-12);
  EXPECT_FALSE(units_of("rover"));
  for (const std::string& name : known_subclasses()) EXPECT_TRUE(units_of(name)) << name;
}

}  // namespace
}  // namespace cairn::p2os_robot
