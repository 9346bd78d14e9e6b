// Which part of a wanted velocity does not drive the robot into what its sensors see. It knows nothing of maps, poses
// or missions: only live ranges, the odometry and the footprint.
//
// Stop zone: the footprint, grown by the margin, swept along the arc that the velocity describes for as long as the
// robot needs to stand: its reaction (a tick, and until the transducer fires again) and its braking distance. The speed
// is cut, on the same arc, until nothing seen lies in the zone; what approaches by itself makes the zone longer. The
// arc that the robot is on, before it has come to the wanted one, counts as well. Slow zone: the same with a wider
// margin, in which the robot only goes slowly. Where no transducer looks, or a deaf one alone, it creeps.
#pragma once

#include <span>
#include <vector>

#include "framework/contracts/observation.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/safety/config.hpp"
#include "framework/safety/deaf_transducers.hpp"
#include "framework/safety/range_buffer.hpp"

namespace cairn {

class VelocityLimiter {
 public:
  VelocityLimiter(const CollisionMonitorConfig& config, const RobotModel& robot);

  // Every observation, in order. One whose stamp is not later than the last one's, or whose stamp or odometry is no
  // number, is stale as a whole. expected: of its readings, what they should have heard; it only ever slows the robot.
  void see(const Observation& observation, std::span<const ExpectedEcho> expected = {});
  // The wanted velocity, within the robot's limits and what the sensors allow. Once after each see().
  [[nodiscard]] Twist limit(const Twist& wanted);
  // Nothing has been read for longer than a command counts, or the clock stands: to stop as commanded takes too long.
  [[nodiscard]] bool is_blind_for_long() const;
  // Share of a wanted speed, or of a wanted turn in place, that an allowed one leaves out: 0 none, 1 all.
  [[nodiscard]] double speed_reduction_ratio(const Twist& wanted, const Twist& allowed) const;
  [[nodiscard]] const CollisionMonitorFigures& figures() const { return figures_; }
  [[nodiscard]] const DeafTransducers& hearing() const { return hearing_; }

 private:
  [[nodiscard]] bool is_stale() const;
  void note_reading();
  void feel_bump(bool bumped);
  [[nodiscard]] Twist within_limits(const Twist& wanted) const;
  [[nodiscard]] Twist next_towards(const Twist& twist) const;
  [[nodiscard]] Twist allowed_of(const Twist& wanted);
  [[nodiscard]] Twist cut(const Twist& clamped) const;
  [[nodiscard]] double max_unheard_mps(const Twist& twist) const;
  [[nodiscard]] double allowed_share(const Twist& twist, double margin_m) const;

  CollisionMonitorConfig config_;
  SpeedLaw law_;
  RobotModel robot_;
  RangeBuffer memory_;
  DeafTransducers hearing_;
  double tick_s_ = 0.0;  // between the last two observations
  double stamp_s_ = 0.0;
  double period_s_ = 0.0;       // of readings
  std::vector<double> gaps_s_;  // the last few between readings, where the robot's file does not give the period
  double last_reading_s_ = 0.0;
  bool begun_ = false;
  bool useless_ = false;  // the last observation: its clock stands still, or it is not placed
  bool heard_ = false;    // a reading
  bool bumped_ = false;
  Twist allowed_;  // of the last tick
  Twist driven_;   // what it makes of the orders within its accelerations
  CollisionMonitorFigures figures_;
};

}  // namespace cairn
