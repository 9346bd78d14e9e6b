// A running mission held from outside: paused, asked, paced.

#include <algorithm>
#include <thread>

#include "framework/mission/loop.hpp"

namespace cairn {
namespace {}  // namespace

bool MissionLoop::is_pause_wanted() const {
  return options_.control != nullptr && options_.control->flags().pause.load(std::memory_order_relaxed);
}

// As fast as the wall clock when the user wants it so, and while nothing but time passes.
void MissionLoop::pace(double stamp_s) {
  if (!options_.realtime && !paused_) {
    pace_.reset();
    return;
  }
  if (!pace_) pace_ = Pace{std::chrono::steady_clock::now(), stamp_s};
  const auto until = pace_->wall + std::chrono::duration<double>(stamp_s - pace_->stamp_s);
  // In short naps: a log may hold a gap of hours, and the user may want to end it in there.
  while (!budget_.cancelled()) {
    const auto rest = until - std::chrono::steady_clock::now();
    if (rest <= rest.zero()) return;
    std::this_thread::sleep_for(std::min<std::chrono::duration<double>>(rest, kControlPollInterval));
  }
}

void MissionLoop::apply_control() {
  if (drive_ == nullptr || is_pause_wanted() == paused_) return;
  paused_ = !paused_;
  if (paused_) {
    paused_before_s_ = result_.paused_s;
    publish(Paused{});
  } else {
    publish(Resumed{result_.paused_s - paused_before_s_});
  }
}

// A log has no robot to stop: it is read on later.
void MissionLoop::wait_while_paused() {
  if (drive_ != nullptr || !is_pause_wanted()) return;
  paused_ = true;
  publish(Paused{});
  while (is_pause_wanted() && !budget_.cancelled()) {
    options_.control->tick([this] { return status(); });
    std::this_thread::sleep_for(kControlPollInterval);
  }
  paused_ = false;
  publish(Resumed{});
}

std::optional<TimeLeft> MissionLoop::time_left() const {
  if (trees_.empty()) return std::nullopt;
  TimeLeft left{0.0, 0.0, {}};
  for (std::size_t i = step_; i < trees_.size(); ++i)
    left = in_order(std::move(left), trees_[i].time_left(result_.time_s, node_times_));
  return cut(std::move(left), mission_.config.at_most_s - result_.time_s);
}

RunStatus MissionLoop::status() const {
  RunStatus status;
  status.state = paused_ ? RunState::paused : RunState::running;
  status.mission = mission_.config.mission;
  status.steps = mission_.steps.size();
  status.step = std::min(step_ + 1, status.steps);
  if (step_ < status.steps) {
    status.step_name = mission_.steps[step_].name;
    if (const auto doing = trees_[step_].doing()) {
      status.node = doing->path;
      status.doing = doing->reason;
    }
  }
  status.time_s = result_.time_s;
  status.paused_s = result_.paused_s;
  status.explored_ratio = grid_ == nullptr ? 0.0 : known_ratio(*grid_);
  status.T_map_robot = pose_.T_map_robot;
  status.distance_m = result_.distance_m;
  status.landmarks = tracker_.graph().landmarks().size();
  status.left = time_left();
  return status;
}

RunStatus MissionLoop::last_status() const {
  RunStatus status;
  status.state = RunState::ended;
  status.mission = mission_.config.mission;
  status.steps = mission_.steps.size();
  status.step = std::min(step_ + 1, status.steps);
  if (step_ < status.steps) status.step_name = mission_.steps[step_].name;
  status.time_s = result_.time_s;
  status.paused_s = result_.paused_s;
  if (!grid_is_lost_ && grid_ != nullptr) status.explored_ratio = known_ratio(*grid_);
  status.T_map_robot = pose_.T_map_robot;
  status.distance_m = result_.distance_m;
  status.landmarks = tracker_.graph().landmarks().size();
  status.outcome = name_of(result_.outcome);
  status.reason = result_.reason;
  status.map_file = result_.map_file;
  return status;
}

}  // namespace cairn
