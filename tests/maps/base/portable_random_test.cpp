#include "maps/base/portable_random.hpp"

#include <gtest/gtest.h>

namespace cairn {
namespace {

// The first numbers of splitmix64 from 0, as its author gives them.
TEST(PortableRandom, SeedsAreMixedBySplitmix64) {
  EXPECT_EQ(mixed_seed(0), 0xe220a8397b1dcdafU);
  EXPECT_EQ(mixed_seed(kSplitmixStep), 0x6e789e6aa1b965f4U);
  EXPECT_EQ(mixed_seed(2 * kSplitmixStep), 0x06c45d188009454fU);
}

TEST(PortableRandom, StreamsOfOneSeedDiffer) {
  EXPECT_NE(PortableRandom(7, 1).share(), PortableRandom(7, 2).share());
  EXPECT_EQ(PortableRandom(7, 1).share(), PortableRandom(7, 1).share());
}

}  // namespace
}  // namespace cairn
