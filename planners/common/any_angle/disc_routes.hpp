// Shortest routes for a disc on the grid, and proofs that there is none.
//
// Two meshes: of the cells in which the disc may stand somewhere, and of those in which it may stand
// everywhere. What the first does not join cannot be reached, and no route is shorter than its shortest
// path; a path over the second is a route. For a point the two are one, and the route is the shortest.
#pragma once

#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "framework/contracts/budget.hpp"
#include "planners/common/any_angle/mesh_search.hpp"
#include "planners/common/any_angle/numbered_cells.hpp"
#include "planners/common/disc_space/disc_space.hpp"

namespace cairn {

// Whether work on so many cells, at a generous price for each, ends before the budget's deadline.
[[nodiscard]] bool has_time_for(const Budget& budget, std::int64_t cells);

struct DiscRoute {
  std::vector<Point> route;           // corner points, ends included; empty: none found
  double length_lower_bound_m = 0.0;  // no route is shorter
  bool impossible = false;            // proven
  bool interrupted = false;           // by the budget
  std::int64_t expanded = 0;
};

// Immutable to its users and thread-safe. Building it costs O(cells).
class DiscRoutes {
 public:
  // radius_m: of the disc to plan with; one up to two micrometres counts as a point.
  DiscRoutes(std::shared_ptr<const DiscSpace> space, double radius_m);

  [[nodiscard]] const DiscSpace& space() const { return *space_; }
  [[nodiscard]] double radius_m() const { return radius_m_; }

  // False is a proof that there is no route, at once.
  [[nodiscard]] bool may_reach(const Point& from, const Point& to) const;
  // No route is shorter; +inf when there is none. Less than nothing is known when the budget ends: 0.
  [[nodiscard]] double length_lower_bound_m(const Point& from, const Point& to, const Budget& budget) const;
  // The lattice's cells that routes between two points may pass, of those not longer than max_m. O(cells),
  // O(rectangles) where max_m is infinite; none when the budget ends it.
  [[nodiscard]] NumberedCells cells_between(const Point& from, const Point& to, double max_m,
                                            const Budget& budget = {}) const;
  [[nodiscard]] const std::shared_ptr<const DiscSpace>& lattice() const { return coarse_.space; }

  // A route so much longer than any must be may have missed a passage that only a finer lattice shows.
  static constexpr double kDoubtfulRatio = 1.05;

  // Between two places where the disc fits. None without `impossible`: the route, if there is one, is narrower
  // than the finest lattice tried can show. The finer lattice, of the whole map, is tried where the first gives no
  // route or one more than doubtful_ratio times as long as any must be.
  [[nodiscard]] DiscRoute route(const Point& from, const Point& to, const Budget& budget,
                                double doubtful_ratio = kDoubtfulRatio) const;
  // The same on the first lattice alone, which takes a small part of the time and sees less of narrow passages.
  [[nodiscard]] DiscRoute coarse_route(const Point& from, const Point& to, const Budget& budget) const;

 private:
  // One lattice: a whole part of a cell of the grid.
  struct Meshes {
    std::shared_ptr<const DiscSpace> space;
    CellMesh optimistic;
    std::optional<CellMesh> conservative;  // none: the same
  };

  [[nodiscard]] Meshes meshes_of(int parts) const;
  // Null where it would be too large, or where it is not made yet and the budget has no time for it. Made by a thread
  // of its own, so that whoever waits for it heeds its budget; the end of this object waits for that thread.
  [[nodiscard]] const Meshes* finer(const Budget& budget) const;
  [[nodiscard]] DiscRoute route_on(const Meshes& meshes, const Point& from, const Point& to,
                                   const Budget& budget) const;

  [[nodiscard]] std::vector<Point> shortest_of(const DiscSpace& space, const std::vector<Point>& route,
                                               const Budget& budget) const;

  std::shared_ptr<const DiscSpace> space_;
  double radius_m_;
  bool is_point_;
  int parts_;
  Meshes coarse_;
  mutable std::mutex finer_mutex_;
  mutable std::shared_future<Meshes> finer_;  // last: what its thread uses outlives it
};

// The routes for the space last asked for and the few radii last used on it: many queries on one map build them once,
// as do queries that are asked again with a smaller margin. Thread-safe; while one caller builds, others wait for it.
class DiscRoutesCache {
 public:
  [[nodiscard]] std::shared_ptr<const DiscRoutes> routes_of(const std::shared_ptr<const DiscSpace>& space,
                                                            double radius_m) const;
  // What was last asked for; null before.
  [[nodiscard]] std::shared_ptr<const DiscRoutes> last() const;

 private:
  mutable std::mutex mutex_;
  mutable std::vector<std::shared_ptr<const DiscRoutes>> kept_;  // the last used first
};

}  // namespace cairn
