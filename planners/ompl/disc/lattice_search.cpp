#include "planners/ompl/disc/lattice_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace cairn {
namespace {

constexpr double kOctile = 1.083;  // a route over eight neighbours may be so much longer than one at any angle
constexpr std::int64_t kMaxNodes = 500'000;
constexpr double kMaxStep_m = 0.5;  // doors would be missed

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

// A route's points with others between them, at most step_m apart.
std::vector<Point> with_points_between(const std::vector<Point>& route, double step_m) {
  std::vector<Point> points{route.front()};
  for (std::size_t i = 1; i < route.size(); ++i) {
    const int parts = std::max(1, static_cast<int>(std::ceil((route[i] - route[i - 1]).norm() / step_m)));
    for (int part = 1; part < parts; ++part)
      points.push_back(route[i - 1] + static_cast<double>(part) / parts * (route[i] - route[i - 1]));
    points.push_back(route[i]);
  }
  return points;
}

class LatticeSearch {
 public:
  LatticeSearch(const DiscRoutes& routes, const TravelCost& cost, const KnownRoute& known, int stride,
                const Budget& budget)
      : space_(routes.space()),
        field_(space_.field()),
        radius_m_(routes.radius_m()),
        cost_(cost),
        is_joined_(std::isfinite(known.cost)),
        to_(known.points.back()),
        max_cost_(known.cost * kOctile),
        budget_(budget),
        window_(cells_of_ellipse(field_, known.points.front(), to_, max_cost_ / cost.min_per_m())),
        stride_(stride) {
    for (;; ++stride_) {  // a large window has its nodes further apart
      columns_ = (window_.width() + stride_ - 1) / stride_;
      rows_ = (window_.height() + stride_ - 1) / stride_;
      if (std::int64_t{columns_} * rows_ <= kMaxNodes) break;
    }
    known_ = is_joined_ ? with_points_between(known.points, stride_ * field_.cell_m())
                        : std::vector<Point>{known.points.front(), to_};
  }

  LatticeRoute route() {
    if (window_.empty() || stride_ * field_.cell_m() > std::max(kMaxStep_m, field_.cell_m())) return {};
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
      is_of_lattice(open.at) ? expand(open.at) : expand_known(open.at);
    }
    return {};
  }

 private:
  struct Node {
    double cost = std::numeric_limits<double>::infinity();
    double per_m = -1.0;  // not known yet
    std::int32_t before = -1;
    bool is_settled = false;
    bool is_beside_known = false;
  };
  struct Open {
    double lower_bound = 0.0;  // of the cost of routes through it
    std::size_t at = 0;
    bool operator<(const Open& other) const {
      return lower_bound != other.lower_bound ? lower_bound > other.lower_bound : at > other.at;
    }
  };

  // First the lattice's nodes, then the known points.
  [[nodiscard]] std::size_t lattice_size() const {
    return static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  }
  [[nodiscard]] bool is_of_lattice(std::size_t at) const { return at < lattice_size(); }
  [[nodiscard]] std::size_t goal() const { return nodes_.size() - 1; }
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
  [[nodiscard]] Point point_of(std::size_t at) const {
    return is_of_lattice(at) ? field_.centre_of(cell_of(at)) : known_[at - lattice_size()];
  }
  [[nodiscard]] double per_m(std::size_t at) {
    double& known = nodes_[at].per_m;
    if (known < 0.0) known = cost_.per_m_at(point_of(at));
    return known;
  }

  void reach(std::size_t at, double cost, std::size_t before) {
    const double lower_bound = cost + cost_.min_per_m() * (to_ - point_of(at)).norm();
    if (cost >= nodes_[at].cost || lower_bound > max_cost_) return;
    nodes_[at].cost = cost;
    nodes_[at].before = static_cast<std::int32_t>(before);
    queue_.push({lower_bound, at});
  }
  // Between a known point and another, or a node beside it.
  void reach_straight(std::size_t from, std::size_t to) {
    if (nodes_[to].is_settled) return;
    const double reached = nodes_[from].cost + cost_.between(point_of(from), point_of(to));
    if (reached < nodes_[to].cost && space_.fits_along(point_of(from), point_of(to), radius_m_))
      reach(to, reached, from);
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
    return space_.fits_along(point_of(a), point_of(b), radius_m_);
  }

  void begin() {
    nodes_.resize(lattice_size() + known_.size());
    for (std::size_t i = 0; i < known_.size(); ++i)
      around(node_near(known_[i]), [&](Cell node) {
        nodes_[index_of(node)].is_beside_known = true;
        beside_known_.push_back({index_of(node), lattice_size() + i});
      });
    std::ranges::sort(beside_known_);
    nodes_[lattice_size()].cost = 0.0;
    queue_.push({0.0, lattice_size()});
  }

  void expand_known(std::size_t at) {
    around(node_near(point_of(at)), [&](Cell node) { reach_straight(at, index_of(node)); });
    if (is_joined_ && at > lattice_size()) reach_straight(at, at - 1);
    if (is_joined_) reach_straight(at, at + 1);  // never of the last, which is the goal
  }

  void expand(std::size_t at) {
    const Cell node = node_of(at);
    const double cost = nodes_[at].cost;
    if (nodes_[at].is_beside_known)
      for (auto beside = std::ranges::lower_bound(beside_known_, std::pair(at, std::size_t{0}));
           beside != beside_known_.end() && beside->first == at; ++beside)
        reach_straight(at, beside->second);
    const double own_per_m = per_m(at);
    around(node, [&](Cell next) {
      const std::size_t to = index_of(next);
      if (to == at || nodes_[to].is_settled || field_.is_blocked(cell_of(to))) return;
      const double step_m =
          (next.x != node.x && next.y != node.y ? std::numbers::sqrt2 : 1.0) * stride_ * field_.cell_m();
      if (cost + step_m * cost_.min_per_m() >= nodes_[to].cost) return;
      const double reached = cost + 0.5 * step_m * (own_per_m + per_m(to));
      if (reached < nodes_[to].cost && fits_between(at, to, step_m)) reach(to, reached, at);
    });
  }

  [[nodiscard]] LatticeRoute route_to_goal() const {
    LatticeRoute route;
    for (auto at = static_cast<std::int32_t>(goal()); at >= 0; at = nodes_[static_cast<std::size_t>(at)].before) {
      const auto node = static_cast<std::size_t>(at);
      route.points.push_back(point_of(node));
      route.is_known.push_back(!is_of_lattice(node) && node != goal() && node != lattice_size());
    }
    std::reverse(route.points.begin(), route.points.end());
    std::reverse(route.is_known.begin(), route.is_known.end());
    return route;
  }

  const DiscSpace& space_;
  const DistanceField& field_;
  double radius_m_;
  const TravelCost& cost_;
  bool is_joined_;  // along the known points
  Point to_;
  double max_cost_;
  const Budget& budget_;
  CellBox window_;
  int stride_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<Node> nodes_;
  std::priority_queue<Open> queue_;
  std::vector<Point> known_;
  std::vector<std::pair<std::size_t, std::size_t>> beside_known_;  // nodes of the lattice, and the known points there
};

}  // namespace

LatticeRoute lattice_route(const DiscRoutes& routes, const TravelCost& cost, const KnownRoute& known, int stride,
                           const Budget& budget) {
  return LatticeSearch(routes, cost, known, stride, budget).route();
}

}  // namespace cairn
