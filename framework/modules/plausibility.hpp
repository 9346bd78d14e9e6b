// Values that no working module returns: numbers that are none, leaps of clocks, odometry and places far beyond what a
// robot can do. Each is a fault of the module, before anything is made of it.
//
// The limits of logs are generous: recordings with gaps and restarts pass. A robot that is driven keeps to narrower
// ones.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/contracts/detector.hpp"
#include "framework/contracts/ground_truth.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/contracts/loop_closer.hpp"
#include "framework/contracts/marker.hpp"
#include "framework/contracts/planner.hpp"
#include "framework/contracts/robot_model.hpp"
#include "framework/modules/wall_clock.hpp"

namespace cairn {

inline constexpr double kMaxStampBack_s = 1.0;  // of logs; stamps of a robot that is driven never go back
inline constexpr double kMaxStampAhead_s = 86'400.0;
inline constexpr double kMaxLiveStampAhead_s = 10.0;    // besides the time that has passed here
inline constexpr double kMaxOdometryLeap_m = 10.0;      // besides ten times what the top speed allows
inline constexpr double kMaxLiveLeap_m = 0.5;           // in a second, besides three times what the top speed allows
inline constexpr double kMaxLiveTurn_rad = 1.0;         // the same, of turning; without a limit from half a turn on
inline constexpr double kMaxPlace_m = 1e5;              // of a pose from the map's origin
inline constexpr double kMaxDetectionOutside_m = 10.0;  // of the map that it was found in
inline constexpr double kMaxMarkerAway_m = 100.0;       // from the robot whose camera sees it

// All return what is wrong ("returned ..."), or an empty text.
class ObservationCheck {
 public:
  explicit ObservationCheck(const RobotModel& robot,
                            std::shared_ptr<const WallClock> wall_clock = std::make_shared<SteadyClock>())
      : max_v_mps_(robot.max_v_mps), max_w_radps_(robot.max_w_radps), wall_clock_(std::move(wall_clock)) {}
  // Before the first observation: they come from a robot that is driven.
  void expect_live() { is_live_ = true; }
  // After those before.
  [[nodiscard]] std::string fault_of(const Observation& observation);

 private:
  [[nodiscard]] bool is_clock_possible(double passed_s, double here_s) const;
  [[nodiscard]] std::string fault_of_motion(const Pose2& T_odom_robot, double passed_s);

  double max_v_mps_;
  double max_w_radps_;
  std::shared_ptr<const WallClock> wall_clock_;
  bool is_live_ = false;
  std::optional<double> last_stamp_s_;
  WallClock::Time last_here_;
  Pose2 T_odom_last_;
  // What is left of a second's allowance.
  double spare_m_ = kMaxLiveLeap_m;
  double spare_rad_ = kMaxLiveTurn_rad;
};
[[nodiscard]] std::string fault_of(const GroundTruth& truth);
// max_m: from the map's origin.
[[nodiscard]] std::string fault_of(const PoseEstimate& pose, double max_m = kMaxPlace_m);
[[nodiscard]] std::string fault_of(const MarkerSighting& sighting);
// submaps: so many were asked for.
[[nodiscard]] std::string fault_of(const LoopProposal& proposal, std::size_t submaps);
[[nodiscard]] std::string fault_of(const Matching& matching, const OccupancyGrid& grid);
[[nodiscard]] std::string fault_of(const PlanResult& plan);

}  // namespace cairn
