// Who holds the wheels, from one observation to the next.
#pragma once

#include <string>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/mission/events.hpp"

namespace cairn {

class HoldRecord {
 public:
  // What has changed with this observation.
  [[nodiscard]] std::vector<Event> update(const Observation& observation, double time_s);

 private:
  std::string by_;
  double since_s_ = 0.0;
};

[[nodiscard]] std::string text_of(const RobotStopped& event);
[[nodiscard]] std::string text_of(const RobotReleased& event);

}  // namespace cairn
