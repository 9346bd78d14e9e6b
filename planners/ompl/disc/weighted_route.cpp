#include "planners/ompl/disc/weighted_route.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

namespace cairn {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kOctile = 1.083;  // a route over eight neighbours may be so much longer than one at any angle
constexpr std::int64_t kMaxNodes = 500'000;
constexpr double kMaxStep_m = 0.5;  // doors would be missed
constexpr double kStep_m = 0.1;     // between nodes, where cells are smaller

// The cells that a point can be in that is at most sum_m from two others together.
CellBox cells_of_ellipse(const DistanceField& field, const Point& a, const Point& b, double sum_m) {
  if (!std::isfinite(sum_m)) return field.box();
  const Point axis = 0.5 * (b - a);
  const double half_m = 0.5 * sum_m;
  const double minor2 = std::max(0.0, half_m * half_m - axis.squaredNorm());
  const Point middle = 0.5 * (a + b);
  const Point reach = (axis.array().square() + minor2).sqrt().matrix();  // of the ellipse's box
  const CellBox box{field.cell_at(middle - reach), field.cell_at(middle + reach) + Cell{1, 1}};
  const CellBox whole = field.box();
  return {{std::max(box.min.x, whole.min.x), std::max(box.min.y, whole.min.y)},
          {std::min(box.max.x, whole.max.x), std::min(box.max.y, whole.max.y)}};
}

class GridSearch {
 public:
  GridSearch(const DiscRoutes& routes, const TravelCost& cost, const Point& from, const Point& to, double known_cost,
             const Budget& budget, int stride)
      : space_(routes.space()),
        field_(space_.field()),
        radius_m_(routes.radius_m()),
        cost_(cost),
        from_(from),
        to_(to),
        max_cost_(known_cost * kOctile),
        budget_(budget),
        window_(cells_of_ellipse(field_, from, to, max_cost_ / cost.min_per_m())),
        stride_(stride) {
    for (;; ++stride_) {  // a large window has its nodes further apart
      columns_ = (window_.width() + stride_ - 1) / stride_;
      rows_ = (window_.height() + stride_ - 1) / stride_;
      if (std::int64_t{columns_} * rows_ <= kMaxNodes) break;
    }
  }

  std::vector<Point> route() {
    if (window_.empty() || stride_ * field_.cell_m() > std::max(kMaxStep_m, field_.cell_m())) return {};
    nodes_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    begin();
    int settled = 0;
    while (!queue_.empty()) {
      const Open open = queue_.top();
      queue_.pop();
      if (open.at == goal()) return route_to_goal();
      Node& node = nodes_[open.at];
      if (node.is_settled) continue;
      node.is_settled = true;
      if (++settled % 256 == 0 && budget_.exhausted()) return {};
      expand(open.at);
    }
    return {};
  }

 private:
  struct Node {
    double cost = kInf;
    double per_m = -1.0;  // not known yet
    std::int32_t before = -1;
    bool is_settled = false;
  };
  struct Open {
    double least = 0.0;  // of routes through it
    std::size_t at = 0;
    bool operator<(const Open& other) const { return least != other.least ? least > other.least : at > other.at; }
  };

  [[nodiscard]] std::size_t goal() const { return nodes_.size(); }
  // Nodes by column and row, every so many cells.
  [[nodiscard]] bool is_node(Cell node) const {
    return node.x >= 0 && node.y >= 0 && node.x < columns_ && node.y < rows_;
  }
  [[nodiscard]] std::size_t index_of(Cell node) const {
    return static_cast<std::size_t>(node.y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(node.x);
  }
  [[nodiscard]] Cell node_of(std::size_t at) const {
    const auto columns = static_cast<std::size_t>(columns_);
    return {static_cast<int>(at % columns), static_cast<int>(at / columns)};
  }
  [[nodiscard]] Cell cell_of(std::size_t at) const {
    const Cell node = node_of(at);
    return window_.min + Cell{node.x * stride_, node.y * stride_};
  }
  [[nodiscard]] Cell node_near(const Point& p_map) const {
    const Cell cell = field_.cell_at(p_map);
    return {(cell.x - window_.min.x) / stride_, (cell.y - window_.min.y) / stride_};
  }
  [[nodiscard]] Point centre_of(std::size_t at) const { return field_.centre_of(cell_of(at)); }
  [[nodiscard]] double per_m(std::size_t at) {
    double& known = nodes_[at].per_m;
    if (known < 0.0) known = cost_.per_m_at(centre_of(at));
    return known;
  }

  void reach(std::size_t at, double cost, std::int32_t before) {
    double& known = at == goal() ? goal_cost_ : nodes_[at].cost;
    const double left_m = at == goal() ? 0.0 : (to_ - centre_of(at)).norm();
    const double least = cost + cost_.min_per_m() * left_m;
    if (cost >= known || least > max_cost_) return;
    known = cost;
    (at == goal() ? goal_before_ : nodes_[at].before) = before;
    queue_.push({least, at});
  }

  template <class Visit>
  void around(Cell node, const Visit& visit) const {
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (is_node(node + Cell{dx, dy})) visit(node + Cell{dx, dy});
  }

  // Most steps are far from everything.
  [[nodiscard]] bool fits_between(std::size_t a, std::size_t b, double step_m) const {
    const double nearest_m = std::min(field_.distance_m(cell_of(a)), field_.distance_m(cell_of(b)));
    if (nearest_m - 0.5 * step_m - 0.71 * field_.cell_m() >= radius_m_) return true;
    return space_.fits_along(centre_of(a), centre_of(b), radius_m_);
  }

  void begin() {
    around(node_near(from_), [&](Cell node) {
      const Point centre = centre_of(index_of(node));
      if (space_.fits_along(from_, centre, radius_m_)) reach(index_of(node), cost_.between(from_, centre), -1);
    });
  }

  void expand(std::size_t at) {
    const Cell node = node_of(at);
    const double cost = nodes_[at].cost;
    const Cell last = node_near(to_);
    if (std::abs(node.x - last.x) <= 1 && std::abs(node.y - last.y) <= 1 &&
        space_.fits_along(centre_of(at), to_, radius_m_))
      reach(goal(), cost + cost_.between(centre_of(at), to_), static_cast<std::int32_t>(at));
    const double own_per_m = per_m(at);
    around(node, [&](Cell next) {
      const std::size_t to = index_of(next);
      if (to == at || nodes_[to].is_settled || field_.is_blocked(cell_of(to))) return;
      const double step_m =
          (next.x != node.x && next.y != node.y ? std::numbers::sqrt2 : 1.0) * stride_ * field_.cell_m();
      if (cost + step_m * cost_.min_per_m() >= nodes_[to].cost) return;
      const double reached = cost + 0.5 * step_m * (own_per_m + per_m(to));
      if (reached < nodes_[to].cost && fits_between(at, to, step_m)) reach(to, reached, static_cast<std::int32_t>(at));
    });
  }

  [[nodiscard]] std::vector<Point> route_to_goal() const {
    std::vector<Point> route{to_};
    for (std::int32_t at = goal_before_; at >= 0; at = nodes_[static_cast<std::size_t>(at)].before)
      route.push_back(centre_of(static_cast<std::size_t>(at)));
    route.push_back(from_);
    std::ranges::reverse(route);
    return route;
  }

  const DiscSpace& space_;
  const DistanceField& field_;
  double radius_m_;
  const TravelCost& cost_;
  Point from_;
  Point to_;
  double max_cost_;
  const Budget& budget_;
  CellBox window_;
  int stride_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Node> nodes_;
  std::priority_queue<Open> queue_;
  double goal_cost_ = kInf;
  std::int32_t goal_before_ = -1;
};

}  // namespace

std::vector<Point> weighted_route(const DiscRoutes& routes, const TravelCost& cost, const Point& from, const Point& to,
                                  double known_cost, const Budget& budget) {
  const int stride = std::max(1, static_cast<int>(kStep_m / routes.space().cell_m() + 1e-9));
  std::vector<Point> route = GridSearch(routes, cost, from, to, known_cost, budget, stride).route();
  // Gaps that no node happens to lie in are left to the route that is known.
  if (route.empty() && stride > 1 && !std::isfinite(known_cost))
    route = GridSearch(routes, cost, from, to, known_cost, budget, 1).route();
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
