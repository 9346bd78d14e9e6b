#include "framework/experiments/shards/shards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cairn {
namespace {

TEST(Shards, EachRunBelongsToOneOfThem) {
  for (const std::size_t of : {1U, 2U, 5U})
    for (std::size_t job = 0; job < 12; ++job) {
      int owners = 0;
      for (std::size_t number = 1; number <= of; ++number) owners += Shard{number, of}.has(job) ? 1 : 0;
      EXPECT_EQ(owners, 1) << job << " of " << of << " shards";
    }
}

TEST(Shards, AreNamedByNumberAndCount) {
  EXPECT_EQ(shard_of("3/16").number, 3U);
  EXPECT_EQ(shard_of("3/16").of, 16U);
  for (const char* wrong : {"", "3", "0/4", "5/4", "1/0", "a/b", "1/2/3", "-1/2", "1/100001", " 1/2"})
    EXPECT_THROW(static_cast<void>(shard_of(wrong)), std::invalid_argument) << wrong;
}

}  // namespace
}  // namespace cairn
