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

TEST(Ranks, AreThoseOfTheLauncher) {
  ::unsetenv("OMPI_COMM_WORLD_RANK");
  ::unsetenv("OMPI_COMM_WORLD_SIZE");
  EXPECT_FALSE(rank_of_launcher());
  ::setenv("OMPI_COMM_WORLD_RANK", "2", 1);
  ::setenv("OMPI_COMM_WORLD_SIZE", "4", 1);
  ::setenv("PMIX_NAMESPACE", "17/../x", 1);
  const auto rank = rank_of_launcher();
  ASSERT_TRUE(rank);
  EXPECT_EQ(rank->number, 2U);
  EXPECT_EQ(rank->of, 4U);
  EXPECT_EQ(rank->job, "17____x");
  ::setenv("OMPI_COMM_WORLD_SIZE", "2", 1);
  EXPECT_FALSE(rank_of_launcher()) << "no rank of so few";
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", "PMIX_NAMESPACE"}) ::unsetenv(name);
}

TEST(Ranks, TakeEachRunOnceAndTheLastToEndKnowsIt) {
  std::string pattern = (std::filesystem::temp_directory_path() / "ranks_test_XXXXXX").string();
  const std::filesystem::path out = ::mkdtemp(pattern.data());
  RankedRuns first(out, {0, 3, "job"});
  RankedRuns second(out, {1, 3, "job"});
  EXPECT_TRUE(first.take(0));
  EXPECT_FALSE(second.take(0));
  EXPECT_TRUE(second.take(1));
  EXPECT_THROW(RankedRuns(out, {1, 3, "job"}), std::runtime_error) << "a rank of that number lives";
  EXPECT_FALSE(first.end()) << "one lives, one has not begun";
  std::optional<RankedRuns> third(std::in_place, out, Rank{2, 3, "job"});
  EXPECT_FALSE(second.end()) << "one lives";
  third.reset();  // killed
  RankedRuns again(out, {0, 3, "job"});
  EXPECT_TRUE(again.end());
  again.clear();
  EXPECT_TRUE(std::filesystem::is_empty(out));
  std::filesystem::remove_all(out);
}

}  // namespace
}  // namespace cairn
