// Drives to a place as `goto` does, for exploring: through openings that no path with the usual room leads through.
#pragma once

#include <optional>

#include "plugins/behaviours/driving/route_driver.hpp"
#include "plugins/behaviours/exploring/explore.hpp"
#include "plugins/behaviours/exploring/explore_tasks.hpp"

namespace cairn::behaviours {

class PassageDrive {
 public:
  explicit PassageDrive(const ExploreConfig& config);

  void begin(const ExploreTask& task, double time_s);
  // Success as soon as the robot is beyond the passage, or at the lookout of another task. Failure: the reason says
  // why.
  Status tick(const ExploreTask& task, const WorldView& world, BehaviourContext& context);

 private:
  [[nodiscard]] bool is_beyond(const ExploreTask& task, const WorldView& world) const;

  PassageSettings settings_;
  RouteDriver driver_;
  double begun_s_ = 0.0;
};

}  // namespace cairn::behaviours
