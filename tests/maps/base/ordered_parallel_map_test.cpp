#include "maps/base/ordered_parallel_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>
#include <numeric>
#include <stdexcept>
#include <string>

namespace cairn {
namespace {

using testing::ElementsAreArray;

// The numbers below `count`, one after another.
auto counting_to(int count, std::atomic<int>& taken) {
  return [count, &taken]() -> std::optional<int> { return taken < count ? std::optional(taken++) : std::nullopt; };
}
const auto kNothing = [] {};

std::vector<int> first(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

// What was given before it threw, and what that was.
struct Ended {
  std::vector<int> given;
  std::string fault;
};
template <class Take, class Work>
Ended run(std::size_t threads, const Take& take, const Work& work) {
  Ended ended;
  try {
    ordered_parallel_map(
        threads, take, work, [&](int result, bool) { ended.given.push_back(result); }, kNothing);
  } catch (const std::runtime_error& error) {
    ended.fault = error.what();
  }
  return ended;
}

TEST(InOrder, ResultsComeInTheOrderOfTheJobsHoweverLongEachTakes) {
  for (const std::size_t threads : {1U, 2U, 7U}) {
    std::atomic<int> taken = 0;
    const Ended ended = run(threads, counting_to(300, taken), [](int job) {
      for (int i = job * 7919 % 5; i > 0; --i) std::this_thread::yield();
      return job;
    });
    EXPECT_THAT(ended.given, ElementsAreArray(first(300)));
  }
}

TEST(InOrder, AFaultOfTheWorkComesAfterAllEarlierResultsAndEndsIt) {
  for (const std::size_t threads : {1U, 5U}) {
    std::atomic<int> taken = 0;
    const Ended ended = run(threads, counting_to(1'000'000, taken), [](int job) {
      if (job >= 300) throw std::runtime_error("job " + std::to_string(job));
      return job;
    });
    EXPECT_THAT(ended.given, ElementsAreArray(first(300)));
    EXPECT_EQ(ended.fault, "job 300");
    EXPECT_LT(taken, 1000);
  }
}

TEST(InOrder, AFaultOfTakingComesAfterAllEarlierResults) {
  std::atomic<int> taken = 0;
  const auto take = [&]() -> std::optional<int> {
    if (taken == 40) throw std::runtime_error("line 41");
    return taken++;
  };
  const Ended ended = run(3, take, [](int job) { return job; });
  EXPECT_THAT(ended.given, ElementsAreArray(first(40)));
  EXPECT_EQ(ended.fault, "line 41");
}

TEST(InOrder, AFaultOfGivingEndsIt) {
  std::atomic<int> taken = 0;
  std::atomic<int> given = 0;
  const auto give = [&](int, bool) {
    if (++given == 10) throw std::runtime_error("disc full");
  };
  EXPECT_THROW(ordered_parallel_map(
                   3, counting_to(1'000'000, taken), [](int job) { return job; }, give, kNothing),
               std::runtime_error);
  EXPECT_EQ(given, 10);
  EXPECT_LT(taken, 1000);
}

TEST(InOrder, AnAnswerDoesNotWaitForTheNextQuestion) {
  std::mutex mutex;
  std::condition_variable changed;
  int asked = 0;
  int answered = 0;
  // Each question comes when the answer to the one before has.
  const auto take = [&]() -> std::optional<int> {
    std::unique_lock lock(mutex);
    changed.wait(lock, [&] { return answered == asked; });
    return asked < 100 ? std::optional(asked++) : std::nullopt;
  };
  const auto give = [&](int, bool more_follow) {
    EXPECT_FALSE(more_follow);
    const std::lock_guard lock(mutex);
    ++answered;
    changed.notify_all();
  };
  ordered_parallel_map(
      2, take, [](int job) { return job; }, give, kNothing);
  EXPECT_EQ(answered, 100);
}

TEST(InOrder, AFaultWakesWhoWaitsForAJob) {
  std::mutex mutex;
  std::condition_variable changed;
  bool stopped = false;
  bool asked = false;
  const auto take = [&]() -> std::optional<int> {
    std::unique_lock lock(mutex);
    if (!std::exchange(asked, true)) return 1;
    changed.wait(lock, [&] { return stopped; });  // for a question that never comes
    return std::nullopt;
  };
  const auto stop = [&] {
    const std::lock_guard lock(mutex);
    stopped = true;
    changed.notify_all();
  };
  const auto work = [](int) -> int { throw std::runtime_error("module"); };
  EXPECT_THROW(ordered_parallel_map(
                   3, take, work, [](int, bool) {}, stop),
               std::runtime_error);
}

TEST(InOrder, FewJobsAreUnderWayAtOnce) {
  std::atomic<int> taken = 0;
  int given = 0;
  int max_ahead = 0;
  ordered_parallel_map(
      4, counting_to(600, taken), [](int job) { return job; },
      [&](int, bool) {
        ++given;
        max_ahead = std::max(max_ahead, taken - given);
        for (int i = 0; i < 3; ++i) std::this_thread::yield();
      },
      kNothing);
  EXPECT_LE(max_ahead, 4 * 32 + 1);
}

}  // namespace
}  // namespace cairn
