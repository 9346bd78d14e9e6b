// Hands the mission's events to those who subscribe to them.
#pragma once

#include <string>
#include <vector>

#include "framework/mission/loop/world_state.hpp"
#include "framework/modules/stage_clock.hpp"

namespace cairn {

class Publisher {
 public:
  // Events come with a view of this world as it is then; none comes before there is a grid to show.
  // clock: where the time of listeners counts.
  explicit Publisher(const WorldState& world, StageClock* clock = nullptr, StageClock::Id stage = StageClock::kHost)
      : world_(world), clock_(clock), stage_(stage) {}

  void subscribe(Listener& listener) { listeners_.push_back(&listener); }
  // A listener that throws changes nothing: it gets no more events, and what it threw is kept.
  void publish(const Event& event);
  [[nodiscard]] const std::vector<std::string>& listener_faults() const { return listener_faults_; }

 private:
  const WorldState& world_;
  StageClock* clock_;
  StageClock::Id stage_;
  std::vector<Listener*> listeners_;
  std::vector<std::string> listener_faults_;
};

}  // namespace cairn
