// Judges a touch: how fast the robot came, and whether its transducers could have seen what it met in time to stand.
// From a speed v that takes the reaction r (a round of its sonars, 0.3 s at least) and braking at a: v r + v^2 / 2a of
// path and r + v / a of time. Whoever had either could have stood. A door that closes just ahead could not be seen.
//
// Seen is geometry, from where everything truly was: no fault of a transducer counts, nor whether it was its turn to
// fire, nor how loud the echo would have been.
#pragma once

#include <deque>

#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/robot_model.hpp"
#include "plugins/simulated_robot/surroundings/body.hpp"
#include "plugins/simulated_robot/surroundings/traffic.hpp"

namespace cairn {

class Witness {
 public:
  explicit Witness(const RobotModel& robot);

  // What it remembers for a second longer than the robot needs to stop from its top speed. Times ascend.
  void note(double time_s, const Pose2& T_map_robot, const Places& places);
  // The robot has been carried elsewhere.
  void forget() { moments_.clear(); }

  // Of a robot that touches something of the scene at this pose, going like this. The scene shows traffic.places().
  [[nodiscard]] Contact judge(const Body& body, const Scene& scene, const Traffic& traffic, const Pose2& T_map_robot,
                              const Twist& going) const;

 private:
  struct Moment {
    double time_s;
    Pose2 T_map_robot;
    Places places;
    double driven_m;  // since it began
    double speed_mps;
  };

  [[nodiscard]] bool could_stand(const Moment& seen) const;
  [[nodiscard]] bool could_see(const Nearest& touched, const Scene& scene, const Traffic& traffic) const;
  [[nodiscard]] bool is_in_a_beam(const Pose2& T_map_robot, const Point& p_m, const Scene& scene) const;

  RobotModel robot_;
  double reaction_s_;
  std::deque<Moment> moments_;
};

}  // namespace cairn
