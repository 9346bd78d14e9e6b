// MissionDisplay: what a source of observations may show of the mission where it comes from, as a robot's network does
// to its people, and the orders that people give there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/contracts/world_view.hpp"

namespace cairn {

// After a tick. Valid during the call only.
struct MissionSnapshot {
  const WorldView& world;          // its pose may be one of a robot that is lost
  const std::vector<Pose2>& path;  // planned last, in the map frame; empty: none, or its step has ended
  Twist commanded{};               // of the wheels
  const std::string& doing;        // for people; some tenths of a second old at most
};

struct DisplayOrder {
  std::string text;     // as `cairn mission order` takes it: {"goto": "pillar"}
  std::string problem;  // a sentence: it was no order at all; empty: it was
};

class MissionDisplay {
 public:
  virtual ~MissionDisplay() = default;
  // By the thread of the mission, after each tick: returns soon, whoever looks on. When it throws it gets no more.
  virtual void show(const MissionSnapshot& snapshot) = 0;
  // Given since; by the same thread. Called until there is none.
  [[nodiscard]] virtual std::optional<DisplayOrder> next_order() = 0;
};

}  // namespace cairn
