// Drives through an opening that was looked into: straight through its middle as it was heard, with less and less room
// beside the robot, and more slowly with less. What the map holds in the way is not believed; live echoes are, and the
// collision monitor watches as always.
#pragma once

#include <cstddef>
#include <optional>

#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/explore_tasks.hpp"
#include "plugins/behaviours/following/back_up.hpp"
#include "plugins/behaviours/following/route_follower.hpp"

namespace cairn::behaviours {

class PassageDrive {
 public:
  explicit PassageDrive(const ExploreConfig& config);

  // The task: a passage.
  void begin(const ExploreTask& task, const WorldView& world);
  // Success as soon as the robot is beyond the passage. Failure: the reason says why.
  Status tick(const ExploreTask& task, const WorldView& world, MotionRequests& context);

 private:
  // A try with so much room: none when there is none left.
  void begin_try(const ExploreTask& task, const WorldView& world);
  [[nodiscard]] bool is_beyond(const ExploreTask& task, const WorldView& world) const;
  Status fail_try(const ExploreTask& task, const WorldView& world, MotionRequests& context, const std::string& why);
  Status back_up(const ExploreTask& task, const WorldView& world, MotionRequests& context);
  [[nodiscard]] RouteFollower follower(double speed_mps) const;

  PassageDriveSettings settings_;
  DrivingSettings driving_;
  double speed_mps_;
  double patience_s_;
  LocalMap map_;
  RouteFollower follower_;
  BackUp back_up_;
  std::size_t try_ = 0;  // of the clearances
  bool is_backing_up_ = false;
  std::string why_;  // the last try failed
  double begun_s_ = 0.0;
};

}  // namespace cairn::behaviours
