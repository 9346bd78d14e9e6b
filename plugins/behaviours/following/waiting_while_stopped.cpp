#include "plugins/behaviours/following/waiting_while_stopped.hpp"

namespace cairn::behaviours {

Status WaitingWhileStopped::tick(const WorldView& world, BehaviourContext& context) {
  if (world.observation != nullptr && !world.observation->stopped_by.empty()) {
    if (!stopped_since_s_) stopped_since_s_ = world.time_s;
    return {StepState::running, "waits: the robot is stopped by " + world.observation->stopped_by};
  }
  if (stopped_since_s_) stopped_s_ += world.time_s - *stopped_since_s_;
  stopped_since_s_.reset();
  WorldView seen = world;
  seen.time_s -= stopped_s_;
  return step_->tick(seen, context);
}

void WaitingWhileStopped::halt() {
  stopped_since_s_.reset();
  step_->halt();
}

}  // namespace cairn::behaviours
