// What the conformance suites give to modules: a robot, a room, a drive through it, grids, odd numbers.
#pragma once

#include <atomic>
#include <string>
#include <utility>
#include <vector>

#include "framework/contracts/module.hpp"

namespace cairn::conformance {

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr double kHuge = 1e300;
// Long for any call that has nothing to do, even on a busy machine under a sanitizer.
inline constexpr double kPromptly_s = 5.0;

// Round, differential, eight sonars, errors as small robots have them.
[[nodiscard]] RobotModel eight_sonar_robot();

// 6 x 5 m with a round post of 0.5 m in the middle.
[[nodiscard]] World room();
inline constexpr Pose2 kRoomStart{1.0, 1.0, 0.0};
inline constexpr Pose2 kPostOfRoom{3.0, 2.5, 0.0};
inline constexpr double kPostDiameter_m = 0.5;
// The room as a finished grid: the floor free, post and walls occupied, unknown beyond them.
[[nodiscard]] OccupancyGrid grid_of_room(double cell_m);

// One step of a drive: what is sensed, and where the robot really is.
struct DriveStep {
  Observation observation;
  Pose2 T_map_robot;
};
// One observation from a place in the room, without any error; every sonar has fired. Odometry counts from
// kRoomStart.
[[nodiscard]] Observation seen_in_room(const Pose2& T_map_robot, double stamp_s, const RobotModel& robot);
// An orbit round the post, 14 m, an observation every 0.1 m of path or 30 degrees of turn.
[[nodiscard]] std::vector<DriveStep> drive_through_room(const RobotModel& robot);

// Circle and square of 0.5 m, triangle of 0.6 m, for cells of 0.05 m.
[[nodiscard]] TemplateSet three_templates();
// A grid of the templates' cells: free ground of 3 x 3 m, the shape's outline occupied, inside unknown:
// as ideal templates have it when the landmark stands on the centre of a cell.
[[nodiscard]] OccupancyGrid grid_with_landmark(const LandmarkShape& shape, const Pose2& T_map_landmark, double cell_m);
[[nodiscard]] CellChanges everything_changed(const OccupancyGrid& grid);

// Readings as broken or foreign hardware gives them, with what is odd about each. All stand at the robot's
// centre and look ahead.
struct OddReading {
  std::string what;
  RangeReading reading;
};
[[nodiscard]] std::vector<OddReading> odd_readings();
// Poses with numbers that are not finite or beyond all maps.
[[nodiscard]] std::vector<Pose2> odd_poses();

// A budget that is used up from the start, by its cancel flag or by its deadline.
class UsedUpBudget {
 public:
  [[nodiscard]] Budget cancelled() const {
    Budget budget;
    budget.cancel = &cancel_;
    return budget;
  }
  [[nodiscard]] static Budget past_deadline() {
    Budget budget;
    budget.deadline = Budget::Clock::now() - std::chrono::seconds(1);
    return budget;
  }

 private:
  std::atomic<bool> cancel_{true};
};

// How long a call takes.
template <class Call>
[[nodiscard]] double seconds_of(Call&& call) {
  const auto begin = Budget::Clock::now();
  std::forward<Call>(call)();
  return std::chrono::duration<double>(Budget::Clock::now() - begin).count();
}

}  // namespace cairn::conformance
