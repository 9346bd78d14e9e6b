#include "maps/base/deflate.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cairn {
namespace {

TEST(Deflate, GivesBackWhatWasPacked) {
  for (const std::string& bytes : {std::string(), std::string("a"), std::string(100'000, '\0') + "end"}) {
    const std::string packed = deflated(bytes);
    EXPECT_EQ(inflated(packed, bytes.size()), bytes);
    EXPECT_LT(packed.size(), bytes.size() / 100 + 20);
  }
}

TEST(Deflate, AnotherSizeOrOtherBytesAreRefused) {
  const std::string packed = deflated("forty two");
  EXPECT_THROW((void)inflated(packed, 8), std::invalid_argument);
  EXPECT_THROW((void)inflated(packed, 10), std::invalid_argument);
  EXPECT_THROW((void)inflated("forty two", 9), std::invalid_argument);
  EXPECT_THROW((void)inflated(packed, std::size_t{1} << 50), std::invalid_argument);  // before any memory is taken
}

}  // namespace
}  // namespace cairn
