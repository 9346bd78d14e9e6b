// Values that no working module returns: numbers that are none, leaps of clocks, odometry and places far beyond what a
// robot can do. Each is a fault of the module, before anything is made of it.
//
// The limits are generous: recorded logs with gaps and restarts pass.
#pragma once

#include <optional>
#include <string>

#include "framework/contracts/detector.hpp"
#include "framework/contracts/localizer.hpp"
#include "framework/contracts/robot_model.hpp"

namespace cairn {

inline constexpr double kMaxStampBack_s = 1.0;
inline constexpr double kMaxStampAhead_s = 86'400.0;
inline constexpr double kMaxOdometryLeap_m = 10.0;      // besides ten times what the top speed allows
inline constexpr double kMaxPlace_m = 1e5;              // of a pose from the map's origin
inline constexpr double kMaxDetectionOutside_m = 10.0;  // of the map that it was found in

// All return what is wrong ("returned ..."), or an empty text.
class ObservationCheck {
 public:
  explicit ObservationCheck(const RobotModel& robot) : max_v_mps_(robot.max_v_mps) {}
  // After those before.
  [[nodiscard]] std::string fault_of(const Observation& observation);

 private:
  double max_v_mps_;
  std::optional<double> last_stamp_s_;
  Pose2 T_odom_last_;
};
[[nodiscard]] std::string fault_of(const PoseEstimate& pose);
[[nodiscard]] std::string fault_of(const Matching& matching, const OccupancyGrid& grid);

}  // namespace cairn
