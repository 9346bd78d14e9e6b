#include "framework/mission/run_control.hpp"

#include <utility>

namespace cairn {

std::string_view name_of(RunState state) {
  switch (state) {
    case RunState::starting:
      return "starting";
    case RunState::running:
      return "running";
    case RunState::paused:
      return "paused";
    case RunState::ended:
      return "ended";
  }
  return "?";
}

RunControl::RunControl(ControlFlags& flags, std::string mission) : flags_(flags) {
  last_.mission = std::move(mission);
}

RunStatus RunControl::status(std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  const std::uint64_t before = reported_;
  ++waiting_;
  changed_.wait_for(lock, at_most, [&] {
    return reported_ > before || last_.state == RunState::starting || last_.state == RunState::ended;
  });
  --waiting_;
  return last_;
}

RunStatus RunControl::status_in(RunState wanted, std::chrono::milliseconds at_most) {
  std::unique_lock lock(mutex_);
  ++waiting_;
  changed_.wait_for(lock, at_most, [&] { return last_.state == wanted || last_.state == RunState::ended; });
  --waiting_;
  return last_;
}

void RunControl::tick(const std::function<RunStatus()>& look) {
  if (waiting_.load(std::memory_order_relaxed) > 0) publish(look());
}

void RunControl::publish(RunStatus status) {
  if (status.state == RunState::ended) orders_.close();
  const std::scoped_lock lock(mutex_);
  last_ = std::move(status);
  ++reported_;
  changed_.notify_all();
}

}  // namespace cairn
