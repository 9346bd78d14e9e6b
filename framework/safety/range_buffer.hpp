// What the ranges of the last moments say about the robot's surroundings: for the collision monitor, in the odometry's
// frame.
//
// An echo is kept as points on its arc, because it may have come from anywhere on it. A later echo from farther away
// that passed through such a point takes it away again; silence does not, for a mirror or a dead transducer is silent
// too. Thin beams are kept as scans (RayBuffer).
#pragma once

#include <optional>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/safety/ray_buffer.hpp"
#include "framework/safety/seen_point.hpp"

namespace cairn {

// Whether an observation's clock and odometry are numbers: otherwise nothing in it has a time and a place.
[[nodiscard]] bool is_placed(const Observation& observation);
// Whether a reading is one, be it "no echo": of a transducer, from a place of the robot, and not a bad one.
[[nodiscard]] bool says_something(const RangeReading& reading);

class RangeBuffer {
 public:
  // kept_s: how long an echo counts. rays_within_m: echoes of thin beams from farther away are left out.
  RangeBuffer(const RobotModel& robot, double kept_s, double rays_within_m = 8.0);

  // It must be placed; readings that say nothing are left out.
  void see(const Observation& observation);
  // A place of the robot's frame that was felt: counts for a while like an echo, whatever is heard from behind it.
  void feel(const Point& at_robot);
  void forget();

  [[nodiscard]] const std::vector<SeenPoint>& points() const { return points_; }
  // How long an echo counts: as asked for, or as a round and a half of the transducers takes.
  [[nodiscard]] double kept_s() const { return kept_s_; }
  // Whether a transducer that has answered lately (be it with "no echo") looks into that direction of the robot.
  [[nodiscard]] bool covers(double direction_rad) const;

 private:
  struct Echo {
    double stamp_s = 0.0;
    double closing_mps = 0.0;
    std::vector<Point> points_odom;
  };
  struct Transducer {
    double stamp_s = -1e9;
    double axis_rad = 0.0;
    double half_beam_rad = 0.0;
    std::vector<Echo> echoes;  // the latest last
  };
  struct Touch {
    double stamp_s = 0.0;
    Point at_odom{0.0, 0.0};
  };

  void take(const RangeReading& reading);
  [[nodiscard]] double closing_mps(const Transducer& transducer, const RangeReading& reading) const;
  void clear_before(const RangeReading& reading);
  void show();

  double kept_s_;
  double round_s_;
  Pose2 T_odom_robot_;
  double stamp_s_ = 0.0;
  std::vector<Transducer> transducers_;
  RayBuffer rays_;
  std::vector<Touch> touches_;
  std::vector<SeenPoint> points_;
};

}  // namespace cairn
