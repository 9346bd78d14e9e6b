#include "framework/mission/loop/publisher.hpp"

namespace cairn {

void Publisher::publish(const Event& event) {
  if (world_.grid == nullptr) return;
  std::optional<StageClock::Work> work;
  if (clock_ != nullptr) work.emplace(*clock_, stage_);
  const WorldView world = world_.view();
  const MissionView seen{world, world_.coarse, world_.driven.commanded, world_.truth};
  std::erase_if(listeners_, [&](Listener* listener) {
    try {
      listener->on(event, seen);
      return false;
    } catch (const std::exception& error) {
      listener_faults_.emplace_back(error.what());
    } catch (...) {
      listener_faults_.emplace_back("something that is no std::exception");
    }
    return true;
  });
}

}  // namespace cairn
