// At which poses a robot with an outline fits on OG1, and along which motions it may move.
//
// fits() is exact. fits_along() holds for every instant of the motion, not for samples of it: exact on
// straight segments; on arcs and turns what it accepts is exact, and it may refuse what passes an obstacle by
// less than bend_slack_m() beyond the margin. Immutable and thread-safe; refers to the DiscSpace.
#pragma once

#include "planners/common/disc_space/disc_space.hpp"
#include "planners/common/pose_space/footprint.hpp"
#include "planners/common/pose_space/motion.hpp"

namespace cairn {

class PoseSpace {
 public:
  // Nothing blocked may come nearer to the outline than margin_m; kMinRadius_m at least.
  PoseSpace(const DiscSpace& space, Footprint footprint, double margin_m = kMinRadius_m);

  [[nodiscard]] const DiscSpace& ground() const { return *space_; }
  [[nodiscard]] const Footprint& footprint() const { return footprint_; }
  [[nodiscard]] double margin_m() const { return margin_m_; }
  [[nodiscard]] double bend_slack_m() const { return bend_slack_m_; }  // a millimetre, or 1/50 cell if that is less

  // The robot's origin never leaves the box of the distance field. False for what is not finite.
  [[nodiscard]] bool fits(const Pose2& pose) const;
  [[nodiscard]] bool fits_along(const Motion& motion) const;
  // The end of the longest first part that fits, as a share of motion.extent_m().
  [[nodiscard]] double share_that_fits(const Motion& motion) const;

 private:
  struct ElementSweep;  // one element of a motion

  [[nodiscard]] double clear_m(const Pose2& pose) const;
  [[nodiscard]] bool touches(const Pose2& pose) const;
  [[nodiscard]] bool segment_fits(const ElementSweep& sweep, double from, double to) const;
  [[nodiscard]] double share_reached(const ElementSweep& sweep) const;
  [[nodiscard]] double share_refined(const ElementSweep& sweep, double good) const;

  const DiscSpace* space_;
  Footprint footprint_;
  double margin_m_;
  double bend_slack_m_;
};

}  // namespace cairn
