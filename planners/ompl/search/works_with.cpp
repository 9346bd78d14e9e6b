#include "planners/ompl/pose/motion_kind.hpp"

namespace cairn {
namespace {

// What runs of OMPL 1.5.2 in a room with a box showed, from several seeds and headings.
bool works_where_motions_have_a_direction(Algorithm algorithm) {
  using enum Algorithm;
  switch (algorithm) {
    case prm:  // edges without direction: paths drive some against it, into walls
    case prm_star:
    case rrt_sharp:
    case rrt_x_static:
    case bfmt:
    case bi_est:  // trees from the goal whose motions were checked in reverse
    case bkpiece:
    case sbl:
    case lbt_rrt:   // aborts the process on an assertion, where distances are not symmetric
    case ait_star:  // the same for Dubins; without a path for most seeds otherwise
    case fmt:       // a minute and more without looking at its termination condition, or no path
      return false;
    default:
      return true;
  }
}

}  // namespace

bool works_with(MotionKind kind, Algorithm algorithm) {
  using enum Algorithm;
  switch (kind) {
    case MotionKind::holonomic:
      return true;
    case MotionKind::differential:
      return works_where_motions_have_a_direction(algorithm);
    case MotionKind::dubins:
      // RRTConnect's trees hardly ever meet when both headings point along the path: no path from any of
      // twelve seeds, where RRT finds one from each.
      return algorithm != rrt_connect && works_where_motions_have_a_direction(algorithm);
    case MotionKind::reeds_shepp:
      // LazyRRT hangs for some seeds; AIT* finds no path for half of them, and takes 0.3 s from one look at its
      // termination condition to the next; of BFMT* some paths touch. With 3000 iterations FMT*, RRT# and RRTX do not
      // look at it for 25 to 40 ms at a time, and PRM and PRM* need as long to draw a path from their roadmaps.
      return algorithm != ait_star && algorithm != lazy_rrt && algorithm != bfmt && algorithm != fmt &&
             algorithm != rrt_sharp && algorithm != rrt_x_static && algorithm != prm && algorithm != prm_star;
  }
  return false;
}

}  // namespace cairn
