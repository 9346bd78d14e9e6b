#include "planners/ompl/disc/weighted_route.hpp"

#include <limits>

#include "maps/grid/travel_field.hpp"

namespace cairn {

std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const Point& from, const Point& to,
                                  const Budget& budget) {
  constexpr int kAskEvery = 256;
  const DiscSpace& space = routes.space();
  const DistanceField& field = space.field();
  // Between two such cells' centres, straight walls leave the disc through.
  const double centres_m = routes.radius_m() + 0.5 * space.cell_m() + 1e-6;
  const auto weight = [&](Cell cell) { return cost.per_m_at(field.centre_of(cell)) / cost.min_per_m(); };
  int settled = 0;
  bool interrupted = false;
  const auto enough = [&](Cell cell) {
    interrupted = ++settled % kAskEvery == 0 && budget.exhausted();
    return interrupted || cell == field.cell_at(to);
  };
  const TravelField travel(field, from, centres_m, weight, enough);
  if (interrupted) return {};
  std::vector<Point> route{from};
  for (const Cell cell : travel.path_to(field.cell_at(to))) route.push_back(field.centre_of(cell));
  if (route.size() == 1) return {};
  route.push_back(to);
  for (std::size_t i = 1; i < route.size(); ++i)
    if (!space.fits_along(route[i - 1], route[i], routes.radius_m())) return {};
  return shortened_by_cost(space, cost, route, routes.radius_m(), budget);
}

std::vector<Point> shortened_by_cost(const DiscSpace& space, const TravelCost& cost, const std::vector<Point>& route,
                                     double radius_m, const Budget& budget) {
  if (route.size() < 3) return route;
  constexpr double kSlack = 1.0 + 1e-9;
  std::vector<Point> corners{route.front()};
  double since_corner = cost.between(route[0], route[1]);
  for (std::size_t i = 2; i < route.size(); ++i) {
    const double step = cost.between(route[i - 1], route[i]);
    const double straight =
        budget.exhausted() ? std::numeric_limits<double>::infinity() : cost.between(corners.back(), route[i]);
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

}  // namespace cairn
