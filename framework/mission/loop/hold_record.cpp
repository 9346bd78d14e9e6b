#include "framework/mission/loop/hold_record.hpp"

#include <fmt/format.h>

namespace cairn {

std::vector<Event> HoldRecord::update(const Observation& observation, double time_s) {
  std::vector<Event> events;
  if (observation.stopped_by == by_) return events;
  if (!by_.empty()) events.emplace_back(RobotReleased{by_, time_s - since_s_});
  by_ = observation.stopped_by;
  since_s_ = time_s;
  if (!by_.empty()) events.emplace_back(RobotStopped{by_});
  return events;
}

std::string text_of(const RobotStopped& event) {
  return "the robot is stopped by " + event.by + ": it stands until that is released";
}

std::string text_of(const RobotReleased& event) {
  return fmt::format("released by {} after {:.1f} s", event.by, event.stopped_s);
}

}  // namespace cairn
