#include "framework/reporting/timeline.hpp"

#include <utility>

namespace cairn {
namespace {

constexpr double kStopped = 0.999;  // of the wanted speed is left out

template <class Thing>
bool add(std::vector<Thing>& things, Thing thing) {
  if (things.size() >= kMaxRunSpans) return false;
  things.push_back(thing);
  return true;
}

}  // namespace

void RunTimeline::on(const Event& event, const MissionView& view) {
  const double time_s = view.world.time_s;
  if (std::holds_alternative<TickDone>(event)) note_stop(view.world.speed_reduction_ratio, time_s);
  if (std::holds_alternative<TickDone>(event))
    note_hold(view.world.observation != nullptr && !view.world.observation->stopped_by.empty(), time_s);
  if (std::holds_alternative<Bumped>(event)) add(bumps_s_, time_s);
  if (std::holds_alternative<MapSaved>(event)) add(saves_s_, time_s);
  if (const auto* on = std::get_if<Resumed>(&event)) add(pauses_, PauseSpan{time_s, on->paused_s.value_or(0.0)});
}

void RunTimeline::note_hold(bool is_held, double time_s) {
  const bool was_held = std::exchange(is_held_, is_held);
  if (is_held && !was_held) is_held_ = add(holds_, RunSpan{time_s, time_s});
  if (was_held) holds_.back().end_s = time_s;
}

void RunTimeline::note_stop(double speed_reduction_ratio, double time_s) {
  const bool was_stopped = is_stopped_;
  is_stopped_ = speed_reduction_ratio >= kStopped;
  if (!is_stopped_) return;
  if (was_stopped)
    stops_.back().end_s = time_s;
  else
    is_stopped_ = add(stops_, RunSpan{time_s, time_s});
}

}  // namespace cairn
