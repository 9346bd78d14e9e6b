// Random clutter, outlines and motions, and distances by brute force, for tests of robots with an outline.
#pragma once

#include <limits>
#include <random>

#include "planners/common/pose_space/footprint.hpp"
#include "planners/common/pose_space/motion.hpp"

namespace cairn::test {

using Random = std::mt19937_64;

inline double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

// Occupied and unknown cells in free ground, away from the origin.
inline OccupancyGrid cluttered_grid(Random& random, int side, double blocked_ratio) {
  OccupancyGrid grid(0.05, 4.0, {-3.17, 2.71});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double draw = uniform(random, 0.0, 1.0);
      const LogOdds value = draw < 0.7 * blocked_ratio ? LogOdds{900}
                            : draw < blocked_ratio     ? LogOdds{0}
                                                       : LogOdds{-900};
      grid.set_log_odds({x - 5, y + 9}, value);
    }
  return grid;
}

// Star-shaped round a point beside the origin; with even radii, convex.
inline Footprint random_outline(Random& random, bool convex) {
  const int n = std::uniform_int_distribution<int>(3, 8)(random);
  const Point middle(uniform(random, -0.15, 0.15), uniform(random, -0.05, 0.05));
  const double radius_m = uniform(random, 0.04, 0.25);
  std::vector<Point> corners;
  for (int i = 0; i < n; ++i) {
    const double angle_rad = radians(360.0) * (i + uniform(random, 0.0, 0.9)) / n;
    const double away_m = convex ? radius_m : radius_m * uniform(random, 0.3, 1.0);
    corners.push_back(middle + away_m * Point(1.6 * std::cos(angle_rad), std::sin(angle_rad)));
  }
  if (n % 2 == 0) std::reverse(corners.begin(), corners.end());
  return Footprint::polygon(corners);
}

inline Pose2 random_pose(Random& random, const OccupancyGrid& grid) {
  const CellBox box = grid.bounds();
  const Point at(uniform(random, box.min.x, box.max.x), uniform(random, box.min.y, box.max.y));
  const Point p = grid.origin_m() + grid.cell_m() * at;
  return {p.x(), p.y(), uniform(random, -3.0, 3.0)};
}

// Up to three elements of each kind, forwards and backwards.
inline Motion random_motion(Random& random, const Pose2& start) {
  Motion motion(start);
  const int count = std::uniform_int_distribution<int>(1, 3)(random);
  for (int i = 0; i < count; ++i) {
    const double way_m = uniform(random, -0.3, 0.3);
    const double turn_rad = uniform(random, -1.5, 1.5);
    const int kind = std::uniform_int_distribution<int>(0, 2)(random);
    if (kind == 0) motion.append(MotionElement::straight(way_m));
    if (kind == 1) motion.append(MotionElement::turn(turn_rad));
    if (kind == 2) motion.append({way_m, turn_rad});
  }
  return motion;
}

// From the outline to the nearest blocked cell, by points closely spaced along its rim: at most half
// rim_step_m too much. 0 when it holds the centre of a blocked cell; cells far off are not looked at.
inline double outline_distance_m(const OccupancyGrid& grid, const GroundRules& rules, const Footprint& footprint,
                                 const Pose2& pose, double rim_step_m) {
  const auto angle_rad = [](const Point& a, const Point& b) {
    return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
  };
  std::vector<Point> corners;
  for (const Point& corner : footprint.corners_m()) corners.push_back(pose * corner);
  const double near_m = footprint.circumscribed_m() + 3.0 * grid.cell_m();
  double min_m = std::numeric_limits<double>::infinity();
  const Cell low = grid.cell_at(pose.position() - Point(near_m, near_m));
  const Cell high = grid.cell_at(pose.position() + Point(near_m, near_m));
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      const Point centre = grid.centre_of({x, y});
      if (!rules.blocks(grid.state({x, y})) || (centre - pose.position()).norm() > near_m) continue;
      double around_rad = 0.0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Point& a = corners[i];
        const Point& b = corners[(i + 1) % corners.size()];
        around_rad += angle_rad(a - centre, b - centre);
        const double steps = std::ceil((b - a).norm() / rim_step_m);
        for (double k = 0.0; k < steps; k += 1.0) {
          const Point away = (a + (b - a) * (k / steps) - centre).cwiseAbs() - Point::Constant(0.5 * grid.cell_m());
          min_m = std::min(min_m, away.cwiseMax(0.0).norm());
        }
      }
      if (std::abs(around_rad) > 1.0) return 0.0;
    }
  return min_m;
}

// The least of it over poses between which nothing moves more than step_m.
inline double motion_distance_m(const OccupancyGrid& grid, const GroundRules& rules, const Footprint& footprint,
                                const Motion& motion, double step_m) {
  double min_m = std::numeric_limits<double>::infinity();
  const double turn_rad = 0.5 * step_m / footprint.circumscribed_m();
  for (const Pose2& pose : motion.sampled(0.5 * step_m, turn_rad)) {
    min_m = std::min(min_m, outline_distance_m(grid, rules, footprint, pose, step_m));
    if (min_m == 0.0) break;
  }
  return min_m;
}

}  // namespace cairn::test
