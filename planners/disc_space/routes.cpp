#include "planners/disc_space/routes.hpp"

#include <numbers>

namespace cairn {
namespace {

constexpr int kMostRounds = 6;             // each about halves the turns that are left
constexpr double kLeastGain_ratio = 1e-3;  // of a round, else it is the last one
constexpr double kFinest_cells = 1.0 / 16.0;
constexpr double kMostWork_cells = 1e5;  // of checked segments, end to end

// Cuts corners round by round. The corner B between A and C first moves to where the straight ways from A and from C
// round the obstacle meet, then is cut off there.
class CornerCutter {
 public:
  CornerCutter(const DiscSpace& space, double radius_m)
      : space_(space), radius_m_(radius_m), finest_m_(kFinest_cells * space.cell_m()) {}

  [[nodiscard]] bool has_work_left() const { return work_cells_ < kMostWork_cells; }
  [[nodiscard]] std::vector<Point> cut_all(const std::vector<Point>& route, std::size_t keep) {
    std::vector<Point> cut(route.begin(), route.begin() + static_cast<std::ptrdiff_t>(keep));
    for (std::size_t i = keep; i + 1 < route.size(); ++i)
      for (const Point& point : cut_corner(cut.back(), route[i], route[i + 1])) cut.push_back(point);
    cut.push_back(route.back());
    return cut;
  }

 private:
  // What comes between A and C in place of B.
  [[nodiscard]] std::vector<Point> cut_corner(Point a, const Point& b, const Point& c) {
    if (!has_work_left()) return {b};
    const Point seen = furthest(b, c, [&](const Point& p) { return fits(a, p); });
    if (seen == c) return {};
    const Point corner = furthest(seen, a, [&](const Point& p) { return fits(p, c); });
    const auto along = [&](const Point& to, double s_m) {
      const double leg_m = (to - corner).norm();
      return s_m < leg_m ? Point(corner + (to - corner) * (s_m / leg_m)) : to;
    };
    const double most_m = std::min((a - corner).norm(), (c - corner).norm());
    const Point end =
        furthest(corner, along(c, most_m), [&](const Point& p) { return fits(along(a, (p - corner).norm()), p); });
    const std::vector<Point> points =
        end == corner ? std::vector{corner} : std::vector{along(a, (end - corner).norm()), end};
    // Parts of free segments are free but for the last digit.
    if (points.size() == 1 && corner == b) return points;
    return fits(a, points.front()) && fits(points.back(), c) ? points : std::vector{b};
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
    work_cells_ += 1.0 + (to - from).norm() / space_.cell_m();
    return space_.fits_along(from, to, radius_m_);
  }

  const DiscSpace& space_;
  double radius_m_;
  double finest_m_;
  double work_cells_ = 0.0;
};

}  // namespace

double length_of(const std::vector<Point>& route) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) length_m += (route[i] - route[i - 1]).norm();
  return length_m;
}

std::vector<Point> straightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m,
                                std::size_t keep) {
  if (route.size() <= keep + 1) return route;
  // One sweep that stretches each straight piece as far as it goes, for routes of many points ...
  std::vector<Point> swept(route.begin(), route.begin() + static_cast<std::ptrdiff_t>(keep));
  for (std::size_t i = keep + 1; i < route.size(); ++i)
    if (!space.fits_along(swept.back(), route[i], radius_m)) swept.push_back(route[i - 1]);
  swept.push_back(route.back());
  // ... then from each corner to the furthest one it sees.
  std::vector<Point> corners(swept.begin(), swept.begin() + static_cast<std::ptrdiff_t>(keep));
  for (std::size_t at = keep - 1; at + 1 < swept.size();) {
    std::size_t next = swept.size() - 1;
    while (next > at + 1 && !space.fits_along(swept[at], swept[next], radius_m)) --next;
    corners.push_back(swept[next]);
    at = next;
  }
  return corners;
}

std::vector<Point> tightened(const DiscSpace& space, const std::vector<Point>& route, double radius_m,
                             std::size_t keep) {
  if (route.size() <= keep + 1) return route;
  CornerCutter cutter(space, radius_m);
  std::vector<Point> best = route;
  for (int i = 0; i < kMostRounds && cutter.has_work_left(); ++i) {
    std::vector<Point> cut = cutter.cut_all(best, keep);
    const double before_m = length_of(best);
    const double gain_m = before_m - length_of(cut);
    if (gain_m > 0.0) best = std::move(cut);
    if (gain_m < kLeastGain_ratio * before_m) break;
  }
  return best;
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
