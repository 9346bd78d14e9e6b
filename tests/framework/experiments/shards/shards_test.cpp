#include "framework/experiments/shards/shards.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

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

TEST(Shards, OfProcessesOfMpirunAreThoseOfTheirRanks) {
  ::unsetenv("OMPI_COMM_WORLD_RANK");
  ::unsetenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_FALSE(shard_of_launcher());
  ::setenv("OMPI_COMM_WORLD_RANK", "2", 1);
  ::setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  const auto shard = shard_of_launcher();
  ASSERT_TRUE(shard);
  EXPECT_EQ(shard->number, 3U);
  EXPECT_EQ(shard->of, 4U);
  ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  EXPECT_FALSE(shard_of_launcher()) << "no rank of so few";
  ::unsetenv("OMPI_COMM_WORLD_RANK");
  ::unsetenv("OMPI_COMM_WORLD_SIZE");
}

}  // namespace
}  // namespace cairn
