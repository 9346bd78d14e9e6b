#include "planners/common/pose_space/pose_recheck.hpp"

#include <fmt/format.h>

#include <array>
#include <stdexcept>

#include "maps/geometry/segments.hpp"

namespace cairn {
namespace {

using Corners = std::vector<Point>;

double between_segments_m(const Point& a, const Point& b, const Point& c, const Point& d) {
  const bool cross_each_other = cross(b - a, c - a) * cross(b - a, d - a) < 0.0 &&  //
                                cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
  if (cross_each_other) return 0.0;
  return std::min({distance_to_segment_m(a, c, d), distance_to_segment_m(b, c, d), distance_to_segment_m(c, a, b),
                   distance_to_segment_m(d, a, b)});
}

double from_rim_m(const Corners& corners, const Point& p) {
  double min_m = distance_to_segment_m(p, corners.back(), corners.front());
  for (std::size_t i = 1; i < corners.size(); ++i)
    min_m = std::min(min_m, distance_to_segment_m(p, corners[i - 1], corners[i]));
  return min_m;
}

// By the number of times that the rim goes round the point.
bool is_inside(const Corners& corners, const Point& p) {
  int winding = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i] - p;
    const Point b = corners[(i + 1) % corners.size()] - p;
    if (a.y() <= 0.0 && b.y() > 0.0 && cross(a, b) > 0.0) ++winding;
    if (a.y() > 0.0 && b.y() <= 0.0 && cross(a, b) < 0.0) --winding;
  }
  return winding != 0;
}

class Looker {
 public:
  Looker(const OccupancyGrid& grid, const GroundRules& rules, const Footprint& footprint)
      : grid_(&grid), rules_(&rules), footprint_(&footprint) {}

  // A cell that comes nearer than reach_m to the outline there.
  [[nodiscard]] std::optional<Cell> blocked_near(const Pose2& pose, double reach_m) const {
    Corners corners;
    for (const Point& corner : footprint_->corners_m()) corners.push_back(pose * corner);
    Point low = pose.position();
    Point high = low;
    if (footprint_->is_disc())
      reach_m += footprint_->circumscribed_m();
    else
      low = high = corners.front();
    for (const Point& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    const Cell first = grid_->cell_at(low - Point(reach_m, reach_m));
    const Cell last = grid_->cell_at(high + Point(reach_m, reach_m));
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x)
        if (rules_->blocks(grid_->state({x, y}, rules_->thresholds)) &&
            (corners.empty() ? is_near(pose.position(), {x, y}, reach_m) : is_near(corners, {x, y}, reach_m)))
          return Cell{x, y};
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::array<Point, 4> square(Cell cell) const {
    const Point centre = grid_->centre_of(cell);
    const double half_m = 0.5 * grid_->cell_m();
    return {centre + Point(-half_m, -half_m), centre + Point(half_m, -half_m), centre + Point(half_m, half_m),
            centre + Point(-half_m, half_m)};
  }
  [[nodiscard]] bool is_near(const Point& p, Cell cell, double reach_m) const {
    const Point away = (p - grid_->centre_of(cell)).cwiseAbs() - Point::Constant(0.5 * grid_->cell_m());
    return away.cwiseMax(0.0).norm() < reach_m;
  }
  [[nodiscard]] bool is_near(const Corners& corners, Cell cell, double reach_m) const {
    const Point centre = grid_->centre_of(cell);
    if (is_inside(corners, centre)) return true;
    // The square lies within its half diagonal of its centre.
    if (from_rim_m(corners, centre) > reach_m + grid_->cell_m()) return false;
    const std::array<Point, 4> at = square(cell);
    for (const Point& corner : corners)
      if (is_near(corner, cell, reach_m)) return true;
    for (std::size_t k = 0; k < 4; ++k) {
      if (is_inside(corners, at[k])) return true;
      for (std::size_t i = 0; i < corners.size(); ++i)
        if (between_segments_m(at[k], at[(k + 1) % 4], corners[i], corners[(i + 1) % corners.size()]) < reach_m)
          return true;
    }
    return false;
  }

  const OccupancyGrid* grid_;
  const GroundRules* rules_;
  const Footprint* footprint_;
};

// How far the fastest point of the outline moves on the element at most.
double max_moved_m(const Footprint& footprint, const MotionElement& element) {
  if (element.turn_rad == 0.0) return std::abs(element.length_m);
  const Point hub(0.0, element.length_m / element.turn_rad);
  double arm_m = hub.norm();
  for (const Point& corner : footprint.corners_m()) arm_m = std::max(arm_m, (corner - hub).norm());
  return arm_m * std::abs(element.turn_rad);
}

struct Segment {
  double from_m;
  double to_m;
  double moved_m;
};

std::optional<Touch> first_touch_on(const Looker& looker, const Motion& motion, const Segment& segment,
                                    double slack_m) {
  const double middle_m = 0.5 * (segment.from_m + segment.to_m);
  const Pose2 pose = motion.pose_at(middle_m);
  const double grown_m = 0.5 * segment.moved_m + kMinRadius_m;
  const auto cell = looker.blocked_near(pose, grown_m);
  if (!cell) return std::nullopt;
  if (grown_m <= slack_m + kMinRadius_m) return Touch{middle_m, pose, *cell};
  const double half_m = 0.5 * segment.moved_m;
  if (auto touch = first_touch_on(looker, motion, {segment.from_m, middle_m, half_m}, slack_m)) return touch;
  return first_touch_on(looker, motion, {middle_m, segment.to_m, half_m}, slack_m);
}

}  // namespace

std::optional<Touch> first_touch(const OccupancyGrid& grid, const GroundRules& rules, const Footprint& footprint,
                                 const Motion& motion, double slack_m) {
  if (!(slack_m > 0.0))
    throw std::invalid_argument(fmt::format("first_touch: slack_m must be positive, got {:f}", slack_m));
  if (!motion.is_finite()) return Touch{0.0, motion.start(), {}};
  const Looker looker(grid, rules, footprint);
  if (const auto cell = looker.blocked_near(motion.start(), kMinRadius_m)) return Touch{0.0, motion.start(), *cell};
  double s_m = 0.0;
  for (const MotionElement& element : motion.elements()) {
    const double extent_m = motion.extent_of(element);
    const double moved_m = max_moved_m(footprint, element);
    // Longer segments than the outline would only have more cells to look at.
    const double segments = std::ceil(moved_m / (footprint.circumscribed_m() + grid.cell_m()));
    for (double k = 0.0; k < segments; k += 1.0) {
      const Segment segment{s_m + extent_m * (k / segments), s_m + extent_m * ((k + 1.0) / segments),
                            moved_m / segments};
      if (auto touch = first_touch_on(looker, motion, segment, slack_m)) return touch;
    }
    s_m += extent_m;
  }
  return std::nullopt;
}

}  // namespace cairn
