// The re-check of finished motions of a robot with an outline: straight from the occupancy grid.
//
// Shares no geometry with PoseSpace. The motion is cut in halves until each segment is so short that the
// outline, grown by half of what any of its points moves on the segment, is clear at the segment's middle; a
// segment on which nothing moves more than 2 slack_m and that is not clear is a touch.
#pragma once

#include <optional>

#include "maps/grid/swept_disc.hpp"
#include "planners/common/pose_space/footprint.hpp"
#include "planners/common/pose_space/motion.hpp"

namespace cairn {

struct Touch {
  double s_m = 0.0;  // on the motion, within slack_m of where the outline touches
  Pose2 pose;
  Cell cell;  // that is touched there
};

// Nothing that touches passes (nearer than kMinRadius_m, as in swept_disc.hpp). Everything passes that
// keeps planning_margin_m(slack_m) away. slack_m > 0, or std::invalid_argument.
// Work: about one look at the cells under the outline for every 2 slack_m moved beside an obstacle, far
// fewer elsewhere.
[[nodiscard]] std::optional<Touch> first_touch(const OccupancyGrid& grid, const GroundRules& rules,
                                               const Footprint& footprint, const Motion& motion, double slack_m);

// The usual slack: nothing moves more than an eighth of a cell between two looks.
[[nodiscard]] inline double recheck_slack_m(double cell_m) {
  return cell_m / 16.0;
}
// The margin to plan with, so that what was planned passes: a hair more than the re-check's doubt.
[[nodiscard]] inline double planning_margin_m(double slack_m) {
  return slack_m + 2.0 * kMinRadius_m;
}

}  // namespace cairn
