#include "planners/common/any_angle/cleared_paths.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cairn {
namespace {

constexpr double kGap_m = 2.0 * kPointRadius_m;  // what a point keeps from the corners that it turns at

// Beside the corner that the segment comes nearest to, short of the gap, a point that keeps it.
std::optional<Point> beside_nearest_corner(const DiscSpace& space, const Point& from, const Point& to) {
  const Point along = to - from;
  const double length_m = along.norm();
  const Point normal{-along.y() / length_m, along.x() / length_m};
  const double half_m = 0.5 * space.cell_m();
  std::optional<Point> beside;
  double nearest_m = kGap_m;
  (void)any_cell_near(Lattice{space.field().origin_m(), space.cell_m()}, from, to, kGap_m, [&](Cell cell) {
    if (!space.is_blocked(cell)) return false;
    const Point centre = space.field().centre_of(cell);
    const double side = (centre - from).dot(normal) > 0.0 ? 1.0 : -1.0;  // on which the square lies
    for (const double x : {-half_m, half_m})
      for (const double y : {-half_m, half_m}) {
        const Point corner = centre + Point(x, y);
        const double at_m = (corner - from).dot(along) / length_m;
        const double off_m = (corner - from).dot(normal) * side;
        if (at_m <= kGap_m || at_m >= length_m - kGap_m || off_m >= nearest_m) continue;
        nearest_m = off_m;
        beside = corner - side * kGap_m * normal;
      }
    return false;
  });
  return beside;
}

// Continues to a point, past corners that the straight segment grazes.
void go_past_corners(const DiscSpace& space, const Point& to, int depth, std::vector<Point>& route) {
  constexpr int kMaxDepth = 40;
  const Point from = route.back();
  if (depth < kMaxDepth && !space.fits_along(from, to, kPointRadius_m)) {
    if (const std::optional<Point> beside = beside_nearest_corner(space, from, to)) {
      go_past_corners(space, *beside, depth + 1, route);
      go_past_corners(space, to, depth + 1, route);
      return;
    }
  }
  route.push_back(to);
}

// Without the points at which a path does not turn.
std::vector<Point> only_turns(const std::vector<Point>& path) {
  std::vector<Point> turns{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point in = path[i] - turns.back();
    const Point out = path[i + 1] - path[i];
    if (std::abs(in.x() * out.y() - in.y() * out.x()) > 1e-12 * in.norm() * out.norm()) turns.push_back(path[i]);
  }
  turns.push_back(path.back());
  return turns;
}

constexpr int kParts = 16;  // of a cell's side

// Places of the lattice of a small part of a cell, in rings round a point, each ring's one after another, until
// visit(place) is true or end_of_ring() is. The middles of passages between whole cells lie on that lattice.
template <class Visit, class EndOfRing>
void go_round(const DiscSpace& space, const Point& p, int rings, const Visit& visit, const EndOfRing& end_of_ring) {
  const double step_m = space.cell_m() / kParts;
  const Point origin = space.field().origin_m();
  const Point at = origin + step_m * ((p - origin) / step_m).array().round().matrix();
  for (int ring = 0; ring <= rings; ++ring) {
    for (int i = -ring; i <= ring; ++i)
      for (const Point& off : {Point(i, -ring), Point(i, ring), Point(-ring, i), Point(ring, i)})
        if (visit(Point(at + step_m * off))) return;
    if (end_of_ring()) return;
  }
}

// A place within two cells of a point where the disc fits.
std::optional<Point> place_near(const DiscSpace& space, const Point& p, double radius_m) {
  if (space.fits(p, radius_m)) return p;
  std::optional<Point> best;
  const auto choose = [&](const Point& place) {
    if ((!best || (place - p).norm() < (*best - p).norm()) && space.fits(place, radius_m)) best = place;
    return false;
  };
  go_round(space, p, 2 * kParts, choose, [&] { return best.has_value(); });
  return best;
}

// A place within a cell of one that joins two others in straight free lines.
std::optional<Point> joint_near(const DiscSpace& space, const Point& p, const Point& before, const Point& after,
                                double radius_m) {
  std::optional<Point> joint;
  const auto take = [&](const Point& place) {
    if (space.fits_along(place, after, radius_m) && space.fits_along(before, place, radius_m)) joint = place;
    return joint.has_value();
  };
  go_round(space, p, kParts, take, [] { return false; });
  return joint;
}

}  // namespace

std::vector<Point> off_corners(const DiscSpace& space, const std::vector<Point>& with_grazed) {
  const std::vector<Point> path = only_turns(with_grazed);
  std::vector<Point> moved = path;
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const Point in = (path[i] - path[i - 1]).normalized();
    const Point out = (path[i + 1] - path[i]).normalized();
    const Point bend = (in - out);  // away from what the path turns round
    if (bend.norm() < 1e-12) continue;
    const double half_turn_cos = std::sqrt(std::max(0.5 * (1.0 + in.dot(out)), 0.25));
    moved[i] = path[i] + bend.normalized() * (kGap_m / half_turn_cos);
  }
  std::vector<Point> route{moved.front()};
  for (std::size_t i = 1; i < moved.size(); ++i) go_past_corners(space, moved[i], 0, route);
  return route;
}

std::vector<Point> pushed_clear(const DiscSpace& space, const std::vector<Point>& path, double radius_m,
                                const Budget& budget) {
  constexpr int kMaxJoints = 32;
  int joints = 0;
  std::vector<Point> route{path.front()};
  for (std::size_t i = 1; i < path.size(); ++i) {
    const int steps = std::max(1, static_cast<int>(std::ceil((path[i] - path[i - 1]).norm() / (0.5 * space.cell_m()))));
    for (int k = 1; k <= steps; ++k) {
      if (budget.exhausted()) return {};
      const Point wanted = path[i - 1] + (path[i] - path[i - 1]) * (static_cast<double>(k) / steps);
      const std::optional<Point> place = place_near(space, wanted, radius_m);
      if (!place) return {};
      if (!space.fits_along(route.back(), *place, radius_m)) {
        if (++joints > kMaxJoints) return {};
        const Point middle = 0.5 * (route.back() + *place);
        const std::optional<Point> joint = joint_near(space, middle, route.back(), *place, radius_m);
        if (!joint) return {};
        route.push_back(*joint);
      }
      route.push_back(*place);
    }
  }
  return route;
}

}  // namespace cairn
