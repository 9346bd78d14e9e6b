// Work on many jobs at once, with results in the order of the jobs.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace cairn {

namespace ordered_parallel_map_detail {

// Results that wait for earlier ones.
template <class Result>
class Line {
 public:
  struct Done {
    std::optional<Result> result;
    std::exception_ptr fault;  // in its place
  };

  explicit Line(std::size_t max_waiting) : max_waiting_(max_waiting) {}

  // Waits until a job of this index would not be too far ahead. False: it is not wanted any more.
  bool wait_for_room(std::size_t index) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return ended_ || index < next_ + max_waiting_; });
    return !ended_;
  }

  // Takes a result, and hands on all that now have no gap before them. Calls give outside of the lock, one at a time.
  // False: no more are wanted.
  template <class Give>
  bool put(std::size_t index, Done done, const Give& give) {
    std::unique_lock lock(mutex_);
    done_.emplace(index, std::move(done));
    if (giving_) return !ended_;  // whoever gives finds it
    giving_ = true;
    while (!ended_ && is_next_here()) {
      auto next = done_.extract(done_.begin());
      if (next.mapped().fault) {
        end(next.mapped().fault);
        break;
      }
      ++next_;
      const bool more_follow = is_next_here();
      lock.unlock();
      std::exception_ptr fault;
      try {
        give(std::move(*next.mapped().result), more_follow);
      } catch (...) {
        fault = std::current_exception();
      }
      lock.lock();
      if (fault) end(fault);
      room_.notify_all();
    }
    giving_ = false;
    return !ended_;
  }

  [[nodiscard]] std::exception_ptr fault() const { return fault_; }

 private:
  [[nodiscard]] bool is_next_here() const { return !done_.empty() && done_.begin()->first == next_; }
  void end(const std::exception_ptr& fault) {
    fault_ = fault;
    ended_ = true;
    room_.notify_all();
  }

  std::size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::map<std::size_t, Done> done_;
  std::size_t next_ = 0;
  bool giving_ = false;
  bool ended_ = false;
  std::exception_ptr fault_;
};

}  // namespace ordered_parallel_map_detail

// Takes jobs until take() gives none, works on them on so many threads, and gives the results on in the order of the
// jobs, each as soon as those before it are through: nothing waits for jobs to come. take() -> std::optional<Job> and
// give(Result, bool more_follow_at_once) are called by one thread at a time, work(Job) -> Result by many.
// What one of them throws ends the work: results of all earlier jobs are given first, then it is thrown here. stop()
// is called, from any thread and perhaps several times, when no further job is wanted: a take() that waits must then
// return. At most 32 jobs a thread are between take() and give().
template <class Take, class Work, class Give, class Stop>
void ordered_parallel_map(std::size_t threads, const Take& take, const Work& work, const Give& give, const Stop& stop) {
  using Job = typename decltype(take())::value_type;
  using Line = ordered_parallel_map_detail::Line<decltype(work(std::declval<Job>()))>;
  Line line(32 * threads);
  std::mutex taking;
  std::size_t next = 0;
  bool at_end = false;
  // Of the next job, or none.
  const auto take_next = [&](std::size_t& index, typename Line::Done& done) -> std::optional<Job> {
    const std::lock_guard lock(taking);
    index = next;
    if (at_end || !line.wait_for_room(index)) return std::nullopt;
    std::optional<Job> job;
    try {
      job = take();
    } catch (...) {
      done.fault = std::current_exception();
    }
    at_end = !job;
    if (job || done.fault) ++next;
    return job;
  };
  const auto work_through = [&] {
    for (;;) {
      std::size_t index = 0;
      typename Line::Done done;
      std::optional<Job> job = take_next(index, done);
      if (!job && !done.fault) return;
      try {
        if (job) done.result.emplace(work(std::move(*job)));
      } catch (...) {
        done.fault = std::current_exception();
      }
      const bool has_failed = done.fault != nullptr;
      if (!line.put(index, std::move(done), give) || has_failed) stop();
    }
  };
  {
    std::vector<std::jthread> helpers;
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work_through);
    work_through();
  }
  if (line.fault()) std::rethrow_exception(line.fault());
}

}  // namespace cairn
