// How long a call works on after it should have ended.
//
// By the processor clock of its thread: on a machine that does other things the time on the wall says how long it had
// to wait for its turn.
#pragma once

#include <pthread.h>

#include <algorithm>
#include <ctime>
#include <thread>
#include <utility>

#include "framework/contracts/path_planner.hpp"

namespace cairn::test {

constexpr auto kMaxLate = std::chrono::milliseconds(2);

// Promises of processor time are of the program as it is shipped; under the address sanitizer it is many times slower.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define CAIRN_IS_INSTRUMENTED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(CAIRN_IS_INSTRUMENTED)
constexpr int kSlowdown = 10;
#else
constexpr int kSlowdown = 1;
#endif

// Processor time of one thread.
inline Budget::Clock::duration worked(clockid_t thread) {
  timespec time{};
  clock_gettime(thread, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

struct Overrun {
  PathResult result;
  Budget::Clock::duration over;  // at least
  Budget::Clock::duration late;  // how long after the end the counting began: the thread may have worked so much more
};

// Calls, and says how long this thread works on after `end`, when `at_end` is called by another thread.
template <class Call, class AtEnd>
Overrun overrun_of(Budget::Clock::time_point end, const Call& call, const AtEnd& at_end) {
  clockid_t mine{};
  pthread_getcpuclockid(pthread_self(), &mine);
  Budget::Clock::duration before{};
  Budget::Clock::duration late{};
  std::thread other([&] {
    std::this_thread::sleep_until(end);
    before = worked(mine);
    late = Budget::Clock::now() - end;
    at_end();
  });
  PathResult result = call();
  const Budget::Clock::duration after = worked(mine);
  other.join();
  return {std::move(result), std::max(after - before, Budget::Clock::duration::zero()), late};
}

}  // namespace cairn::test
