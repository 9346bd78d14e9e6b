#include "plugins/p2os_robot/information.hpp"

#include <gtest/gtest.h>

namespace cairn::p2os_robot {
namespace {

std::vector<std::uint8_t> packet() {
  return {0x33, 0x34, 0x92, 0xFF, 0x7F, 0x00, 0xFF, 0,    0,  0,    0,    127, 0x01, 0x04, 0,
          0,    0x01, 0,    45,   2,    3,    0xE8, 0x03, 12, 0x10, 0x27, 0,   0,    0,    0};
}

TEST(Information, IsReadFromItsBytes) {
  const std::optional<Information> seen = information_of(packet());
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->x_counts, 0x1234) << "15 bits";
  EXPECT_EQ(seen->y_counts, 0x7FFF);
  EXPECT_EQ(seen->heading_counts, -256);
  EXPECT_DOUBLE_EQ(seen->battery_v, 12.7);
  EXPECT_TRUE(seen->is_stalled);
  EXPECT_TRUE(seen->is_bumped);
  EXPECT_TRUE(seen->are_motors_on);
  EXPECT_FALSE(seen->is_emergency);
  EXPECT_EQ(seen->compass, 45);
  ASSERT_EQ(seen->sonars.size(), 2U);
  EXPECT_EQ(seen->sonars[0].number, 3);
  EXPECT_EQ(seen->sonars[0].range_counts, 1000);
  EXPECT_EQ(seen->sonars[1].number, 12);
  EXPECT_EQ(seen->sonars[1].range_counts, 10000);
}

TEST(Information, OfAnEmergencyIsReadFromTheFlags) {
  std::vector<std::uint8_t> stopped = packet();
  stopped[16] = 0x20;
  EXPECT_FALSE(information_of(stopped)->are_motors_on);
  EXPECT_TRUE(information_of(stopped)->is_emergency);
}

TEST(Information, IsNotReadFromOtherPacketsOrTooFewBytes) {
  std::vector<std::uint8_t> other = packet();
  other[0] = 0x90;
  EXPECT_FALSE(information_of(other));
  const std::vector<std::uint8_t> whole = packet();
  for (std::size_t size = 0; size < 26; ++size) EXPECT_FALSE(information_of(std::span(whole).first(size))) << size;
}

}  // namespace
}  // namespace cairn::p2os_robot
