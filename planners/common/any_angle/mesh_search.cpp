#include "planners/common/any_angle/mesh_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

namespace cairn {
namespace {

using Index = CellMesh::Index;
using Side = CellMesh::Side;

constexpr double kSnap = 1e-9;     // cells: as near to a lattice line as rounding resolves
constexpr double kMinPart = 1e-9;  // cells: a shorter interval is a point that its neighbours cover
constexpr int kAskEvery = 64;

// > 0: c lies to the left of the ray from a through b.
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

double snapped(double v) {
  const double whole = std::nearbyint(v);
  return std::abs(v - whole) < kSnap ? whole : v;
}

// Where the path has turned: a corner, or the start.
struct Root {
  Point at;
  Index corner = CellMesh::kNone;
  double length = 0.0;  // of the path up to here
  std::int32_t before = -1;
};

// A stretch of a side, seen whole from its root, through which the path goes on into a rectangle; or, when
// `into` is kNone, the goal.
struct Interval {
  double least = 0.0;  // no path through it is shorter
  std::int32_t root = 0;
  Index from = CellMesh::kNone;
  Index into = CellMesh::kNone;
  Side side = Side::below;  // of the rectangle that it leaves
  Point left;               // as the path sees it
  Point right;
};

struct LongerFirst {
  bool operator()(const Interval& a, const Interval& b) const { return a.least > b.least; }
};

bool runs_along_x(Side side) {
  return side == Side::below || side == Side::above;
}

// The shortest path from a through an interval of a side to b, with no other obstacle.
double length_through(const Point& a, Side side, const Point& left, const Point& right, Point b) {
  const int across = runs_along_x(side) ? 1 : 0;
  const int along = 1 - across;
  const double line = left[across];
  const double a_off = a[across] - line;
  double b_off = b[across] - line;
  if (a_off * b_off > 0.0) b_off = -b_off;  // there and back is as long as through to the mirrored end
  b[across] = line + b_off;
  const double span = std::abs(a_off) + std::abs(b_off);
  const double crossing = span > 0.0 ? a[along] + (b[along] - a[along]) * (std::abs(a_off) / span) : a[along];
  const auto [low, high] = std::minmax(left[along], right[along]);
  Point through = left;
  through[along] = std::clamp(crossing, low, high);
  return (through - a).norm() + (b - through).norm();
}

class Search {
 public:
  Search(const CellMesh& mesh, const Point& from, const Point& to, const std::function<bool()>& stop)
      : mesh_(mesh),
        from_(snapped(from.x()), snapped(from.y())),
        to_(to),
        stop_(stop),
        start_(mesh.rectangle_of(cell_of(from))),
        goal_(mesh.rectangle_of(cell_of(to))) {}

  MeshPath run() {
    if (start_ == CellMesh::kNone || goal_ == CellMesh::kNone || mesh_.part_of(start_) != mesh_.part_of(goal_))
      return {};
    roots_.push_back({from_, CellMesh::kNone, 0.0, -1});
    const std::vector<Index> around = rectangles_around_start();
    if (std::find(around.begin(), around.end(), goal_) != around.end()) return path_over(0);
    allowed_ = mesh_.blocks_between(start_, goal_);
    best_.assign(static_cast<std::size_t>(mesh_.corners()), std::numeric_limits<double>::infinity());
    for (const Index rectangle : around)
      for (const CellMesh::Portal& portal : mesh_.portals(rectangle)) {
        if (std::find(around.begin(), around.end(), portal.to) != around.end()) continue;
        const auto [left, right] = ends_of(rectangle, portal);
        add_part(rectangle, portal, 0, left, right);
      }
    publish();
    while (!waiting_.empty()) {
      Interval next = waiting_.top();
      waiting_.pop();
      if (next.into == CellMesh::kNone) return path_over(next.root);
      while (true) {
        if (++expanded_ % kAskEvery == 0 && stop_ && stop_()) return stopped();
        if (!is_outdone(next)) expand(next);
        // A single continuation need not wait in the queue.
        if (found_.size() != 1 || found_.front().into == CellMesh::kNone) break;
        next = found_.front();
        found_.clear();
      }
      publish();
    }
    return {{}, 0.0, expanded_, false};  // not reached: the parts are the same
  }

 private:
  static Cell cell_of(const Point& p) {
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
  }

  // Those that hold the start, rims included: several when it lies on a line between them. The search sets out from
  // all; between them it would go round the start for ever, no path being longer than another.
  [[nodiscard]] std::vector<Index> rectangles_around_start() const {
    std::vector<Index> around{start_};
    for (std::size_t i = 0; i < around.size(); ++i)
      for (const CellMesh::Portal& portal : mesh_.portals(around[i])) {
        const CellBox& r = mesh_.rectangle(portal.to);
        const bool holds_it =
            from_.x() >= r.min.x && from_.x() <= r.max.x && from_.y() >= r.min.y && from_.y() <= r.max.y;
        if (holds_it && std::find(around.begin(), around.end(), portal.to) == around.end()) around.push_back(portal.to);
      }
    return around;
  }

  // The ends of a portal as a path sees them that leaves its rectangle through it.
  [[nodiscard]] std::pair<Point, Point> ends_of(Index rectangle, const CellMesh::Portal& portal) const {
    const CellBox& r = mesh_.rectangle(rectangle);
    const double low = portal.low;
    const double high = portal.high;
    switch (portal.side) {
      case Side::below:
        return {Point(high, r.min.y), Point(low, r.min.y)};
      case Side::right:
        return {Point(r.max.x, high), Point(r.max.x, low)};
      case Side::above:
        return {Point(low, r.max.y), Point(high, r.max.y)};
      case Side::left:
        return {Point(r.min.x, low), Point(r.min.x, high)};
    }
    return {};
  }

  [[nodiscard]] Index corner_of(const Point& p) const {
    const double x = std::nearbyint(p.x());
    const double y = std::nearbyint(p.y());
    return x == p.x() && y == p.y() ? mesh_.corner_at(static_cast<int>(x), static_cast<int>(y)) : CellMesh::kNone;
  }

  [[nodiscard]] bool is_outdone(const Interval& interval) const {
    const Root& root = roots_[static_cast<std::size_t>(interval.root)];
    return root.corner != CellMesh::kNone && root.length > best_[static_cast<std::size_t>(root.corner)] + kSnap;
  }

  // The root for a path that turns at a point; -1 where there is nothing to turn round or a shorter path is known.
  std::int32_t root_at(const Point& p, std::int32_t before) {
    const Index corner = corner_of(p);
    if (corner == CellMesh::kNone) return -1;
    const Root& last = roots_[static_cast<std::size_t>(before)];
    const double length = last.length + (p - last.at).norm();
    double& best = best_[static_cast<std::size_t>(corner)];
    if (length > best + kSnap) return -1;
    best = std::min(best, length);
    roots_.push_back({p, corner, length, before});
    return static_cast<std::int32_t>(roots_.size()) - 1;
  }

  void add_part(Index from, const CellMesh::Portal& portal, std::int32_t root, const Point& left, const Point& right) {
    if (allowed_[static_cast<std::size_t>(portal.block)] == 0) return;
    if ((left - right).cwiseAbs().maxCoeff() < kMinPart) return;
    const Root& r = roots_[static_cast<std::size_t>(root)];
    found_.push_back({r.length + length_through(r.at, portal.side, left, right, to_), root, from, portal.to,
                      portal.side, left, right});
  }
  void add_goal(std::int32_t root) {
    const Root& r = roots_[static_cast<std::size_t>(root)];
    found_.push_back({r.length + (to_ - r.at).norm(), root, CellMesh::kNone, CellMesh::kNone, Side::below, to_, to_});
  }
  void publish() {
    for (const Interval& interval : found_) waiting_.push(interval);
    found_.clear();
  }

  // What the path can do in the rectangle that an interval leads into.
  void expand(const Interval& entry) {
    std::int32_t root = entry.root;
    const Point at = roots_[static_cast<std::size_t>(root)].at;
    const int across = runs_along_x(entry.side) ? 1 : 0;
    if (at[across] != entry.left[across]) {
      expand_cone(entry, at);
      return;
    }
    // The root lies on the side's own line: on the interval it sees everything, beside it only the near end.
    const int along = 1 - across;
    const auto [low, high] = std::minmax(entry.left[along], entry.right[along]);
    if (at[along] < low || at[along] > high) {
      Point near = entry.left;
      near[along] = std::clamp(at[along], low, high);
      root = root_at(near, root);
      if (root < 0) return;
    }
    for (const CellMesh::Portal& portal : mesh_.portals(entry.into)) {
      if (portal.to == entry.from) continue;
      const auto [left, right] = ends_of(entry.into, portal);
      add_part(entry.into, portal, root, left, right);
    }
    if (entry.into == goal_) add_goal(root);
  }

  void expand_cone(const Interval& entry, const Point& at) {
    // Asked for once an end, when something lies beyond it.
    std::int32_t left_root = -2;
    std::int32_t right_root = -2;
    const auto turned_left = [&] { return left_root == -2 ? left_root = root_at(entry.left, entry.root) : left_root; };
    const auto turned_right = [&] {
      return right_root == -2 ? right_root = root_at(entry.right, entry.root) : right_root;
    };
    for (const CellMesh::Portal& portal : mesh_.portals(entry.into)) {
      if (portal.to == entry.from || allowed_[static_cast<std::size_t>(portal.block)] == 0) continue;
      auto [left, right] = ends_of(entry.into, portal);
      const int along = runs_along_x(portal.side) ? 0 : 1;
      // Off to the left of the cone, then off to its right; what remains is seen.
      const auto [seen_from, left_part] = cut(at, entry.left, left, right, along);
      if (left_part && turned_left() >= 0) add_part(entry.into, portal, left_root, left, seen_from);
      if (left_part && seen_from == right) continue;
      const auto [right_from, right_part] = cut(at, entry.right, right, seen_from, along, -1.0);
      if (right_part && turned_right() >= 0) add_part(entry.into, portal, right_root, right_from, right);
      if (right_part && right_from == seen_from) continue;
      add_part(entry.into, portal, entry.root, seen_from, right_from);
    }
    if (entry.into != goal_) return;
    if (turn(at, entry.left, to_) > 0.0) {
      if (turned_left() >= 0) add_goal(left_root);
    } else if (turn(at, entry.right, to_) < 0.0) {
      if (turned_right() >= 0) add_goal(right_root);
    } else {
      add_goal(entry.root);
    }
  }

  // The point up to which a stretch, from `begin` on, lies beyond the ray at -> rim (sign +1: to its left), and
  // whether any of it does.
  static std::pair<Point, bool> cut(const Point& at, const Point& rim, const Point& begin, const Point& end, int along,
                                    double sign = 1.0) {
    const double begin_off = sign * turn(at, rim, begin);
    const double end_off = sign * turn(at, rim, end);
    if (begin_off <= 0.0 && end_off <= 0.0) return {begin, false};
    if (end_off > 0.0) return {end, true};  // then all of it does: seen from inside, stretches turn towards the cone
    Point split = begin;
    split[along] = snapped(begin[along] + (end[along] - begin[along]) * (begin_off / (begin_off - end_off)));
    return {split, true};
  }

  [[nodiscard]] MeshPath stopped() const { return {{}, 0.0, expanded_, true}; }
  [[nodiscard]] MeshPath path_over(std::int32_t last) const {
    MeshPath path;
    path.points.push_back(to_);
    for (std::int32_t i = last; i >= 0; i = roots_[static_cast<std::size_t>(i)].before)
      if (roots_[static_cast<std::size_t>(i)].at != path.points.back() || path.points.size() == 1)
        path.points.push_back(roots_[static_cast<std::size_t>(i)].at);
    std::reverse(path.points.begin(), path.points.end());
    const Root& root = roots_[static_cast<std::size_t>(last)];
    path.length = root.length + (to_ - root.at).norm();
    path.expanded = expanded_;
    return path;
  }

  const CellMesh& mesh_;
  Point from_;
  Point to_;
  const std::function<bool()>& stop_;
  Index start_;
  Index goal_;
  std::vector<std::uint8_t> allowed_;  // by block
  std::vector<double> best_;           // by corner: the shortest path known
  std::vector<Root> roots_;
  std::vector<Interval> found_;  // of the interval being expanded
  std::priority_queue<Interval, std::vector<Interval>, LongerFirst> waiting_;
  std::int64_t expanded_ = 0;
};

}  // namespace

MeshPath shortest_path(const CellMesh& mesh, const Point& from, const Point& to, const std::function<bool()>& stop) {
  return Search(mesh, from, to, stop).run();
}

}  // namespace cairn
