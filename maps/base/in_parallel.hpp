// The same work for many indices, on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace cairn {

// Calls work(i) for every i below count, each once, in no particular order and from several threads. Throws
// what the first call that failed, by its index, threw; after a failure no further call begins. Uses all cores,
// but at most so many.
template <class Work>
void in_parallel(std::size_t count, const Work& work, std::size_t max_threads = 64) {
  std::vector<std::exception_ptr> faults(count);
  std::atomic<std::size_t> next = 0;
  const auto work_through = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        faults[i] = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> helpers;
    const std::size_t threads = std::min<std::size_t>({std::thread::hardware_concurrency(), count, max_threads});
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work_through);
    work_through();
  }
  for (const std::exception_ptr& fault : faults) {
    if (fault) std::rethrow_exception(fault);
  }
}

}  // namespace cairn
