#include "planners/common/disc_space/routes.hpp"

#include <numbers>

namespace cairn {
namespace {

constexpr int kMaxRounds = 6;            // each about halves the turns that are left
constexpr double kMinGain_ratio = 1e-3;  // of a round, else it is the last one
constexpr double kFinest_cells = 1.0 / 16.0;

int across_parts(int a, int b) {
  return a == b ? a : kSeveralParts;
}

std::vector<PartedPoint> parted(const std::vector<Point>& route) {
  std::vector<PartedPoint> points;
  points.reserve(route.size());
  for (const Point& point : route) points.push_back({point, 0});
  return points;
}

double length_of(const std::vector<PartedPoint>& route) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) length_m += (route[i].at - route[i - 1].at).norm();
  return length_m;
}

// Cuts corners round by round. The corner B between A and C first moves to where the straight segments from A and from
// C round the obstacle meet, then is cut off there.
class CornerCutter {
 public:
  CornerCutter(const ShortcutRules& rules, const Budget& budget)
      : rules_(rules), budget_(budget), finest_m_(kFinest_cells * rules.cell_m) {}

  [[nodiscard]] bool may_go_on() const { return work_cells_ < rules_.max_work_cells && !budget_.exhausted(); }
  [[nodiscard]] std::vector<PartedPoint> cut_all(std::vector<PartedPoint> route, std::size_t keep) {
    std::vector<PartedPoint> cut(route.begin(), route.begin() + static_cast<std::ptrdiff_t>(keep));
    for (std::size_t i = keep; i + 1 < route.size(); ++i) {
      const Point a = cut.back().at;
      for (const PartedPoint& point : cut_corner(a, route[i], route[i + 1])) cut.push_back(point);
    }
    cut.push_back(route.back());
    return cut;
  }

 private:
  // What comes between A and C in place of B.
  [[nodiscard]] std::vector<PartedPoint> cut_corner(const Point& a, const PartedPoint& b, PartedPoint& c) {
    if (!may_go_on()) return {b};
    const int across = across_parts(b.part, c.part);
    const Point seen = furthest(b.at, c.at, [&](const Point& p) { return fits(a, p); });
    if (seen == c.at) {
      c.part = across;
      return {};
    }
    const Point corner = furthest(seen, a, [&](const Point& p) { return fits(p, c.at); });
    const PartedPoint turn{corner, seen == b.at ? b.part : across};
    const int from_turn = corner == seen ? c.part : across;
    std::vector<PartedPoint> points = cut_off(a, turn, {c.at, from_turn});
    // Parts of free segments are free but for the last digit.
    const bool same = points.size() == 1 && corner == b.at;
    if (!same && !(fits(a, points.front().at) && fits(points.back().at, c.at))) return {b};
    c.part = from_turn;
    return points;
  }

  // The corner B, or the two ends of the deepest free cut that takes as much of both legs.
  [[nodiscard]] std::vector<PartedPoint> cut_off(const Point& a, const PartedPoint& b, const PartedPoint& c) {
    const auto along = [&](const Point& to, double s_m) {
      const double leg_m = (to - b.at).norm();
      return s_m < leg_m ? Point(b.at + (to - b.at) * (s_m / leg_m)) : to;
    };
    const auto opposite = [&](const Point& p) { return along(a, (p - b.at).norm()); };
    const Point deepest = along(c.at, std::min((a - b.at).norm(), (c.at - b.at).norm()));
    const Point end = furthest(b.at, deepest, [&](const Point& p) { return fits(opposite(p), p); });
    if (end == b.at) return {b};
    return {{opposite(end), b.part}, {end, across_parts(b.part, c.part)}};
  }

  // The point furthest on from `from` towards `to` that is_free(Point) agrees to, asked for twice as far each time and
  // then by halves. `from` itself is taken to be free.
  template <class IsFree>
  [[nodiscard]] Point furthest(const Point& from, const Point& to, IsFree is_free) const {
    const double length_m = (to - from).norm();
    const auto at = [&](double s_m) { return s_m < length_m ? Point(from + (to - from) * (s_m / length_m)) : to; };
    double good_m = 0.0;
    double bad_m = finest_m_;
    while (good_m < length_m && is_free(at(bad_m))) {
      good_m = bad_m;
      bad_m *= 2.0;
    }
    while (good_m < length_m && bad_m - good_m > finest_m_) {
      const double middle_m = 0.5 * (good_m + bad_m);
      (is_free(at(middle_m)) ? good_m : bad_m) = middle_m;
    }
    return good_m > 0.0 ? at(good_m) : from;
  }

  [[nodiscard]] bool fits(const Point& from, const Point& to) {
    work_cells_ += 1.0 + (to - from).norm() / rules_.cell_m;
    return rules_.fits_along(from, to);
  }

  const ShortcutRules& rules_;
  const Budget& budget_;
  double finest_m_;
  double work_cells_ = 0.0;
};

}  // namespace

std::vector<Point> points_of(const std::vector<PartedPoint>& route) {
  std::vector<Point> points;
  points.reserve(route.size());
  for (const PartedPoint& point : route) points.push_back(point.at);
  return points;
}

ShortcutRules shortcuts_on(const DiscSpace& space, double radius_m) {
  ShortcutRules rules;
  rules.fits_along = [&space, radius_m](const Point& from, const Point& to) {
    return space.fits_along(from, to, radius_m);
  };
  rules.cell_m = space.cell_m();
  return rules;
}

std::vector<PartedPoint> straightened(const ShortcutRules& rules, const std::vector<PartedPoint>& route,
                                      std::size_t keep, const Budget& budget) {
  if (route.size() <= keep + 1) return route;
  const auto fits = [&](const Point& from, const Point& to) {
    return (to - from).norm() <= rules.max_shortcut_m && !budget.exhausted() && rules.fits_along(from, to);
  };
  // One sweep that extends each straight segment as far as possible, for routes of many points ...
  std::vector<PartedPoint> swept(route.begin(), route.begin() + static_cast<std::ptrdiff_t>(keep));
  int part = route[keep].part;
  for (std::size_t i = keep + 1; i < route.size(); ++i) {
    if (!fits(swept.back().at, route[i].at)) {
      swept.push_back({route[i - 1].at, part});
      part = route[i].part;
    }
    part = across_parts(part, route[i].part);
  }
  swept.push_back({route.back().at, part});
  // ... then from each corner to the furthest one it sees.
  std::vector<PartedPoint> corners(swept.begin(), swept.begin() + static_cast<std::ptrdiff_t>(keep));
  for (std::size_t at = keep - 1; at + 1 < swept.size();) {
    std::size_t next = swept.size() - 1;
    if (budget.exhausted()) next = at + 1;
    while (next > at + 1 && !fits(swept[at].at, swept[next].at)) --next;
    part = swept[at + 1].part;
    for (std::size_t i = at + 2; i <= next; ++i) part = across_parts(part, swept[i].part);
    corners.push_back({swept[next].at, part});
    at = next;
  }
  return corners;
}

std::vector<PartedPoint> tightened(const ShortcutRules& rules, const std::vector<PartedPoint>& route, std::size_t keep,
                                   const Budget& budget) {
  if (route.size() <= keep + 1) return route;
  CornerCutter cutter(rules, budget);
  std::vector<PartedPoint> best = route;
  for (int i = 0; i < kMaxRounds && cutter.may_go_on(); ++i) {
    std::vector<PartedPoint> cut = cutter.cut_all(best, keep);
    const double before_m = length_of(best);
    const double gain_m = before_m - length_of(cut);
    if (gain_m > 0.0) best = std::move(cut);
    if (gain_m < kMinGain_ratio * before_m) break;
  }
  return best;
}

std::vector<PartedPoint> straightened(const DiscSpace& space, const std::vector<PartedPoint>& route, double radius_m,
                                      std::size_t keep, const Budget& budget) {
  return straightened(shortcuts_on(space, radius_m), route, keep, budget);
}

std::vector<PartedPoint> tightened(const DiscSpace& space, const std::vector<PartedPoint>& route, double radius_m,
                                   std::size_t keep, const Budget& budget) {
  return tightened(shortcuts_on(space, radius_m), route, keep, budget);
}

std::vector<Point> straightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m,
                                std::size_t keep, const Budget& budget) {
  return points_of(straightened(shortcuts_on(space, radius_m), parted(route), keep, budget));
}

std::vector<Point> tightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m, std::size_t keep,
                             const Budget& budget) {
  return points_of(tightened(shortcuts_on(space, radius_m), parted(route), keep, budget));
}

bool route_is_free(const OccupancyGrid& grid, const GroundRules& rules, const std::vector<Point>& route,
                   double radius_m, const std::optional<Escape>& escape) {
  if (route.empty()) return false;
  if (escape && (route.size() < 2 || route[1] != escape->to || !escape_is_free(grid, rules, route[0], *escape)))
    return false;
  const std::size_t first = escape ? 1 : 0;
  if (!sweep_is_free(grid, rules, route[first], route[first], radius_m)) return false;
  for (std::size_t i = first + 1; i < route.size(); ++i)
    if (!sweep_is_free(grid, rules, route[i - 1], route[i], radius_m)) return false;
  return true;
}

double clearance_along(const DiscSpace& space, const std::vector<Point>& route, double radius_m) {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < route.size(); ++i)
    nearest_m = std::min(nearest_m, space.distance_m(route[i == 0 ? 0 : i - 1], route[i]));
  return std::max(nearest_m - radius_m, 0.0);
}

std::vector<Pose2> poses_along(const std::vector<Point>& route, double first_heading_rad,
                               std::optional<double> goal_heading_rad) {
  std::vector<Pose2> poses;
  double heading_rad = first_heading_rad;
  for (std::size_t i = 0; i < route.size(); ++i) {
    const Point step = i + 1 < route.size() ? Point(route[i + 1] - route[i]) : Point(0.0, 0.0);
    if (step.squaredNorm() > 0.0) heading_rad = std::atan2(step.y(), step.x());
    poses.push_back({route[i].x(), route[i].y(), wrap_angle(heading_rad)});
  }
  if (!poses.empty() && goal_heading_rad) poses.back().theta_rad = wrap_angle(*goal_heading_rad);
  return poses;
}

}  // namespace cairn
