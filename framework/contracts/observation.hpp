// What a sensor source says in one step.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "maps/geometry/pose.hpp"

namespace cairn {

// One range reading with the geometry it was taken with, so that no reader needs the robot's file.
// range_m follows REP-117: +inf = no echo, -inf = nearer than min_m, NaN = bad reading.
struct RangeReading {
  Pose2 T_robot_sensor;
  double half_beam_rad = 0.0;  // 0: a ray (lidar)
  double min_m = 0.0;
  double max_m = 0.0;
  double range_m = 0.0;
  int sensor = 0;  // index of the transducer
};

struct Observation {
  double stamp_s = 0.0;
  std::optional<double> recorded_s;   // the stamp as a log has it; stamp_s is made of it, and never goes back
  Pose2 T_odom_robot;                 // dead reckoning since the start, with its drift
  std::optional<double> compass_rad;  // heading in the map frame
  std::vector<RangeReading> ranges;
  bool bumped = false;                  // the robot touches something, which stops it there
  std::optional<double> battery_ratio;  // what is left of a full battery, where that is known
  std::string stopped_by;               // who holds the wheels; empty: nobody
};

enum class SensorState { observation, end_of_data, fault };

struct SensorStep {
  SensorState state = SensorState::end_of_data;
  Observation observation;  // valid when state is observation
  std::string reason;       // for people, when it is not
};

}  // namespace cairn
