// Which module the mission is in, since when, and how long its calls take.
//
// The thread that runs the mission enters and leaves stages; another thread may watch and, when a call
// does not return, give the mission up. Exactly one of the two wins: a stage that was given up cannot
// be left any more, so the mission's thread never touches anything of the mission again.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "framework/modules/wall_clock.hpp"

namespace cairn {

// How long the calls of one module in one stage took. Median and p99 are good to 6 %.
struct StageTime {
  std::string stage;
  std::string module;
  std::int64_t count = 0;
  double median_us = 0.0;
  double p99_us = 0.0;
  double worst_us = 0.0;
  double total_s = 0.0;
  double own_s = 0.0;  // of total_s: without the stages that it entered
};

// Thrown in the mission's thread when the mission was given up. No std::exception: no module shall
// take it for one of its own.
struct GivenUp {};

class StageClock {
 public:
  using Id = std::size_t;
  static constexpr Id kHost = 0;  // the host itself; never given up

  explicit StageClock(std::shared_ptr<const WallClock> wall_clock = std::make_shared<SteadyClock>());

  // Before the run. The same stage and module give the same id.
  Id add(const std::string& stage, const std::string& module);
  [[nodiscard]] const std::string& stage_of(Id id) const { return stages_[id].name; }
  [[nodiscard]] const std::string& module_of(Id id) const { return stages_[id].module; }

  // Being in a stage, from construction to destruction; nested ones come back to the outer one. The
  // constructor throws GivenUp.
  class Visit {
   public:
    Visit(StageClock& clock, Id id);
    ~Visit();
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;

   private:
    StageClock& clock_;
    const Id id_;
    const std::int64_t begin_ns_;
    const std::int64_t outer_inner_ns_;
    std::uint64_t outer_ = 0;
  };
  // Work of the host itself: timed like a visit, but neither watched nor ever given up.
  class Work {
   public:
    Work(StageClock& clock, Id id);
    ~Work();
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    // It does not count, nor against what it is in.
    void leave_out() { counts_ = false; }

   private:
    StageClock& clock_;
    const Id id_;
    const std::int64_t begin_ns_;
    const std::int64_t outer_inner_ns_;
    bool counts_ = true;
  };
  // Throws GivenUp.
  void check() const;
  // From any thread, and from a signal handler: where it is; kHost when it was given up.
  [[nodiscard]] Id current() const noexcept;
  // From any thread: gives the mission up when one call has lasted longer than that. Returns the
  // stage it was in, or kHost when all is well.
  Id give_up_after(std::chrono::nanoseconds longest);

  [[nodiscard]] std::vector<StageTime> times() const;  // stages that were entered, in order of add()

 private:
  static constexpr int kBuckets = 64 * 8;  // eight to each doubling
  struct Stage {
    std::string name;
    std::string module;
    std::int64_t count = 0;
    std::int64_t total_ns = 0;
    std::int64_t own_ns = 0;
    std::int64_t worst_ns = 0;
    std::array<std::uint32_t, kBuckets> histogram{};
  };
  [[nodiscard]] std::int64_t now_ns() const;
  [[nodiscard]] static double quantile_us(const Stage& stage, double share);
  static int bucket_of(std::int64_t ns);
  // What took ns, with the stages inside; the one around it began with outer_inner_ns.
  void note(Id id, std::int64_t ns, std::int64_t outer_inner_ns);

  std::shared_ptr<const WallClock> wall_clock_;
  std::vector<Stage> stages_;
  std::int64_t inner_ns_ = 0;  // what stages took that were entered in the one that is open
  std::uint64_t entered_ = 0;  // stages entered so far: distinguishes two visits of one stage
  // Entry number and stage of the current visit, or kGivenUp; and when it was entered.
  std::atomic<std::uint64_t> current_{0};
  std::atomic<std::int64_t> since_ns_{0};
};

}  // namespace cairn
