// What really is, where a sensor's source knows it: for reports and experiments, never for modules.
//
// A simulation knows it, and some logs do. It goes from the sensor to the host and from there to listeners; no
// observation, view or context of a module holds it.
#pragma once

#include <optional>

#include "maps/geometry/pose.hpp"

namespace cairn {

// The first tick of a touch, as the simulation knows it.
struct Contact {
  double speed_mps = 0.0;  // of the robot, towards what it touches; 0 when it stood, whatever came upon it
  // A transducer had it in range and in its beam, with nothing in front, early enough for the robot to stop
  // (docs/method.md 14.3).
  bool could_be_seen = false;
};

struct GroundTruth {
  Pose2 T_map_robot;
  std::optional<Contact> contact{};  // that began with this observation
};

class GroundTruthSource {
 public:
  virtual ~GroundTruthSource() = default;
  // Of the last observation that its sensor has given; nothing before the first, and where it is not known.
  [[nodiscard]] virtual std::optional<GroundTruth> last_truth() const = 0;
};

}  // namespace cairn
