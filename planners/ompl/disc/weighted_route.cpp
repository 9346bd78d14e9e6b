#include "planners/ompl/disc/weighted_route.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planners/ompl/disc/lattice_search.hpp"

namespace cairn {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kStep_m = 0.1;     // between nodes, where cells are smaller
constexpr double kSlowRatio = 2.0;  // a metre there takes so much more than in the open
constexpr double kAround_m = 0.5;   // of a narrow place, where the lattice is searched again with every cell

// A stretch of a route, by indices of points.
struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;
};

// Where a route goes along what was known, since no node lies there, or near to things, where a part of the nodes'
// distance matters; with some of the route to both sides.
std::vector<Stretch> narrow_places(const LatticeRoute& route, const TravelCost& cost) {
  const std::vector<Point>& points = route.points;
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!route.is_known[i] && cost.per_m_at(points[i]) < kSlowRatio * cost.min_per_m()) continue;
    Stretch around{i, i};
    for (double off_m = 0.0; around.first > 0 && off_m < kAround_m; --around.first)
      off_m += (points[around.first] - points[around.first - 1]).norm();
    for (double off_m = 0.0; around.last + 1 < points.size() && off_m < kAround_m; ++around.last)
      off_m += (points[around.last + 1] - points[around.last]).norm();
    if (!stretches.empty() && around.first <= stretches.back().last)
      stretches.back().last = around.last;
    else
      stretches.push_back(around);
  }
  return stretches;
}

// With every cell as a node near narrow places.
std::vector<Point> refined(const DiscRoutes& routes, const TravelCost& cost, const LatticeRoute& coarse,
                           const Budget& budget) {
  const auto at = [&](std::size_t i) { return coarse.points.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<Point> route;
  std::size_t next = 0;
  for (const Stretch& stretch : narrow_places(coarse, cost)) {
    route.insert(route.end(), at(next), at(stretch.first));
    KnownRoute part{{at(stretch.first), at(stretch.last + 1)}, 0.0};
    part.cost = cost_of(cost, part.points);
    const std::vector<Point> finer = lattice_route(routes, cost, part, 1, budget).points;
    const std::vector<Point>& best = !finer.empty() && cost_of(cost, finer) < part.cost ? finer : part.points;
    route.insert(route.end(), best.begin(), best.end());
    next = stretch.last + 1;
  }
  route.insert(route.end(), at(next), coarse.points.end());
  return route;
}

}  // namespace

std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const std::vector<Point>& known,
                                  const Point& from, const Point& to, const Budget& budget) {
  const int stride = std::max(1, static_cast<int>(kStep_m / routes.space().cell_m() + 1e-9));
  const KnownRoute ends = known.empty() ? KnownRoute{{from, to}, kInf} : KnownRoute{known, cost_of(cost, known)};
  const LatticeRoute coarse = lattice_route(routes, cost, ends, stride, budget);
  std::vector<Point> route = coarse.points;
  if (stride > 1 && !route.empty()) route = refined(routes, cost, coarse, budget);
  if (stride > 1 && route.empty() && known.empty()) route = lattice_route(routes, cost, ends, 1, budget).points;
  if (route.empty()) return {};
  return shortened_by_cost(routes.space(), cost, route, routes.radius_m(), budget);
}

std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost, const std::vector<Point>& route,
                                     double radius_m, const Budget& budget) {
  if (route.size() < 3) return route;
  constexpr double kSlack = 1.0 + 1e-9;
  std::vector<Point> corners{route.front()};
  double since_corner = cost.between(route[0], route[1]);
  for (std::size_t i = 2; i < route.size(); ++i) {
    const double step = cost.between(route[i - 1], route[i]);
    const double straight = budget.exhausted() ? kInf : cost.between(corners.back(), route[i]);
    if (straight <= (since_corner + step) * kSlack && space.fits_along(corners.back(), route[i], radius_m)) {
      since_corner = straight;
    } else {
      corners.push_back(route[i - 1]);
      since_corner = step;
    }
  }
  corners.push_back(route.back());
  return corners;
}

double cost_of(const TravelCost& cost, const std::vector<Point>& route) {
  double sum = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) sum += cost.between(route[i - 1], route[i]);
  return sum;
}

}  // namespace cairn
