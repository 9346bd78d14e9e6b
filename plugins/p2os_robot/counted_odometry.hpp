// A pose out of counts that wrap round.
#pragma once

#include <optional>

#include "maps/geometry/pose.hpp"
#include "plugins/p2os_robot/information.hpp"
#include "plugins/p2os_robot/units.hpp"

namespace cairn::p2os_robot {

class CountedOdometry {
 public:
  // max_step_m: farther than that the robot does not get between two packets.
  CountedOdometry(const Units& units, double max_step_m) : units_(units), max_step_m_(max_step_m) {}

  // After a gap the counts either go on, and what was driven meanwhile is in them, or they begin anew: then the robot
  // stands where it was last seen. They have begun anew when they are all zero, or far from where they were.
  void begin_session(const Units& units);
  // In the frame of the very first one: metres, radians.
  [[nodiscard]] Pose2 pose_at(const Information& seen);

 private:
  struct Counts {
    int x = 0;
    int y = 0;
  };
  [[nodiscard]] double step_m(int from_counts, int to_counts) const;
  [[nodiscard]] bool counts_anew(const Information& seen) const;

  Units units_;
  double max_step_m_;
  std::optional<Counts> last_;
  bool is_after_gap_ = false;
  Point position_m_ = Point::Zero();  // since the session began, in the robot's own frame
  Pose2 T_odom_session_;              // the session's frame in that of all
  Pose2 pose_;
};

}  // namespace cairn::p2os_robot
