// What the scans of lasers say about the robot's surroundings: the part of the range buffer for thin beams.
//
// Of each laser the last scan counts point by point; of those before it one point a small cell is left, as long as
// echoes count. A later scan of the same laser that passed through a point takes it away. A laser's echoes say nothing
// against those of sonars, nor theirs against its: light goes through glass, and sound glances off walls.
// A scan costs O((beams + points kept) log beams).
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/safety/ray_directions.hpp"
#include "framework/safety/seen_point.hpp"
#include "maps/geometry/bearing_maxima.hpp"

namespace cairn {

class RayBuffer {
 public:
  // kept_s: how long an echo counts. kept_m: echoes farther from the sensor are left out. other_period_s: of scanners
  // that the robot's file does not have.
  RayBuffer(const RobotModel& robot, double kept_s, double kept_m, double other_period_s);

  // The rays of a placed observation.
  void see(const Observation& observation);
  void forget();

  void append_points(const Pose2& T_robot_odom, std::vector<SeenPoint>& points) const;
  // Whether a ray that still counts looks about into that direction of the robot.
  [[nodiscard]] bool covers(double direction_rad) const;

 private:
  struct Kept {
    Point at_odom{0.0, 0.0};
    double closing_mps = 0.0;
    double stamp_s = 0.0;
  };
  struct Compared {
    double stamp_s = -1e9;
    std::vector<Point> points_odom;
  };
  struct Scanner {
    int first_sensor = 0;
    double period_s = 0.0;
    double stamp_s = -1e9;
    std::vector<Kept> last;  // scan
    // Scans that the next ones are compared with: what comes nearer must have done so by more than noise.
    Compared compared;
    Compared to_compare;
    std::unordered_map<std::uint64_t, Kept> before;  // by cell
  };

  [[nodiscard]] Scanner& scanner_of(int sensor);
  void take(std::span<const RangeReading> rays, const Observation& observation);
  // What stood still since then would be at least so far away: by bearing from there, negative.
  [[nodiscard]] static BearingMaxima expected_from(const Compared& compared, const Point& from_odom);
  void clear_before(Scanner& scanner, const Point& from_odom, const BearingMaxima& ranges_m) const;
  void keep_last(Scanner& scanner) const;

  double kept_s_;
  double kept_m_;
  double stamp_s_ = 0.0;
  RayDirections directions_;
  std::vector<Scanner> scanners_;  // the robot's lasers, then one for all others
};

}  // namespace cairn
