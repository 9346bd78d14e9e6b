#include "framework/modules/stage_clock.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace cairn {
namespace {

constexpr std::uint64_t kGivenUp = ~std::uint64_t{0};
constexpr unsigned kStageBits = 16;

StageClock::Id stage_in(std::uint64_t visit) {
  return visit & ((1U << kStageBits) - 1);
}

}  // namespace

StageClock::StageClock(std::shared_ptr<const WallClock> wall_clock) : wall_clock_(std::move(wall_clock)) {
  stages_.push_back({"host", "", 0, 0, 0, 0, {}});
}

std::int64_t StageClock::now_ns() const {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(wall_clock_->now().time_since_epoch()).count();
}

StageClock::Id StageClock::add(const std::string& stage, const std::string& module) {
  const auto known = std::find_if(stages_.begin(), stages_.end(),
                                  [&](const Stage& s) { return s.name == stage && s.module == module; });
  if (known != stages_.end()) return static_cast<Id>(known - stages_.begin());
  stages_.push_back({stage, module, 0, 0, 0, 0, {}});
  return stages_.size() - 1;
}

StageClock::Visit::Visit(StageClock& clock, Id id)
    : clock_(clock), id_(id), begin_ns_(clock.now_ns()), outer_inner_ns_(std::exchange(clock.inner_ns_, 0)) {
  outer_ = clock_.current_.load();
  clock_.since_ns_.store(begin_ns_);
  const std::uint64_t mine = (++clock_.entered_ << kStageBits) | id;
  if (outer_ == kGivenUp || !clock_.current_.compare_exchange_strong(outer_, mine)) throw GivenUp{};
}

StageClock::Visit::~Visit() {
  const std::int64_t end_ns = clock_.now_ns();
  std::uint64_t mine = clock_.current_.load();
  if (mine == kGivenUp) return;
  // The outer call is given its time again: what the inner one took is not its fault.
  clock_.since_ns_.store(end_ns);
  if (clock_.current_.compare_exchange_strong(mine, outer_)) clock_.note(id_, end_ns - begin_ns_, outer_inner_ns_);
}

// When the mission is given up, another thread goes on with it; the times are over.
StageClock::Work::Work(StageClock& clock, Id id)
    : clock_(clock),
      id_(id),
      begin_ns_(clock.now_ns()),
      outer_inner_ns_(clock.current_.load() == kGivenUp ? 0 : std::exchange(clock.inner_ns_, 0)) {}

StageClock::Work::~Work() {
  if (clock_.current_.load() == kGivenUp) return;
  if (counts_)
    clock_.note(id_, clock_.now_ns() - begin_ns_, outer_inner_ns_);
  else
    clock_.inner_ns_ = outer_inner_ns_;
}

void StageClock::check() const {
  if (current_.load() == kGivenUp) throw GivenUp{};
}

StageClock::Id StageClock::current() const noexcept {
  const std::uint64_t visit = current_.load();
  return visit == kGivenUp ? kHost : stage_in(visit);
}

StageClock::Id StageClock::give_up_after(std::chrono::nanoseconds longest) {
  std::uint64_t visit = current_.load();
  if (visit == kGivenUp || stage_in(visit) == kHost) return kHost;
  if (now_ns() - since_ns_.load() <= longest.count()) return kHost;
  return current_.compare_exchange_strong(visit, kGivenUp) ? stage_in(visit) : kHost;
}

int StageClock::bucket_of(std::int64_t ns) {
  const auto value = static_cast<std::uint64_t>(std::max<std::int64_t>(ns, 8));
  const int log = static_cast<int>(std::bit_width(value)) - 1;
  return log * 8 + static_cast<int>((value >> (log - 3)) & 7U);
}

void StageClock::note(Id id, std::int64_t ns, std::int64_t outer_inner_ns) {
  Stage& stage = stages_[id];
  ++stage.count;
  stage.total_ns += ns;
  stage.own_ns += ns - inner_ns_;
  inner_ns_ = outer_inner_ns + ns;
  stage.worst_ns = std::max(stage.worst_ns, ns);
  ++stage.histogram[static_cast<std::size_t>(bucket_of(ns))];
}

double StageClock::quantile_us(const Stage& stage, double share) {
  const auto wanted = static_cast<std::int64_t>(std::ceil(share * static_cast<double>(stage.count)));
  std::int64_t seen = 0;
  for (int bucket = 0; bucket < kBuckets; ++bucket) {
    seen += stage.histogram[static_cast<std::size_t>(bucket)];
    const double middle_ns = std::ldexp(1.0 + (bucket % 8 + 0.5) / 8.0, bucket / 8);
    if (seen >= wanted) return 1e-3 * std::min(middle_ns, static_cast<double>(stage.worst_ns));
  }
  return 1e-3 * static_cast<double>(stage.worst_ns);
}

std::vector<StageTime> StageClock::times() const {
  std::vector<StageTime> times;
  for (const Stage& stage : stages_)
    if (stage.count > 0)
      times.push_back({stage.name, stage.module, stage.count, quantile_us(stage, 0.5), quantile_us(stage, 0.99),
                       1e-3 * static_cast<double>(stage.worst_ns), 1e-9 * static_cast<double>(stage.total_ns),
                       1e-9 * static_cast<double>(stage.own_ns)});
  return times;
}

}  // namespace cairn
