// Parts of a large grid round places, so that a path over landmarks needs nothing of the rest.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "planners/common/any_angle/disc_routes.hpp"
#include "planners/hybrid/ground.hpp"

namespace cairn {

struct WindowRules {
  double block_m = 10.0;  // windows are whole blocks of that side
  int reach_blocks = 1;   // on each side of a place's own block, at first
  int max_reach_blocks = 4;
  double near_m = 20.0;  // a goal so near is also tried without landmarks
};

// A part of the grid, and what is made of it.
struct Window {
  OccupancyGrid grid;
  std::shared_ptr<const DiscRoutes> routes;
};

// The windows last used, which many questions at one map make once. It compares their cells unless the version
// (WorldView::grid_version) says that they are the same. Thread-safe.
class WindowCache {
 public:
  // The box must have been required of the world's cells.
  [[nodiscard]] std::shared_ptr<const Window> window_of(const WorldView& world, const CellBox& box,
                                                        const GroundRules& rules, double disc_m) const;

 private:
  struct Entry {
    CellBox box;
    std::uint64_t version = 0;
    std::shared_ptr<const Window> window;
  };
  [[nodiscard]] std::shared_ptr<const Window> find(const WorldView& world, const CellBox& box, const GroundRules& rules,
                                                   double disc_m) const;
  void keep(const Entry& entry) const;

  mutable std::mutex mutex_;
  mutable std::list<Entry> entries_;  // the last used first
};

// A large grid, of which paths are planned in windows; lines are checked cell by cell where they lie. For one request.
class WindowedGround : public PlanningGround {
 public:
  // All must outlive it. robot_m: of the requests' disc, to which the path planner adds its margin; disc_m: of that
  // disc, a hair more. shortest: paths are the shortest in their window, whatever the path planner would choose.
  WindowedGround(const WorldView& world, const GroundRules& rules, double disc_m, const PathPlanner& path_planner,
                 const WindowCache& cache, const WindowRules& windows, bool shortest);

  [[nodiscard]] const WorldView& world() const override { return world_; }
  [[nodiscard]] bool fits_with(const Point& from, const Point& to, double added_m) const override;
  [[nodiscard]] std::optional<Pose2> approach(const Landmark& landmark) const override;
  // In a window that was used before and holds both ends, else in the one round both. Its lower bound, if any, holds
  // for the whole grid.
  [[nodiscard]] PathResult path(const PathRequest& request, const Budget& budget) const override;
  [[nodiscard]] double clearance_m(const std::vector<Point>& route, double radius_m) const override;
  [[nodiscard]] double driving_time_s(const std::vector<Point>& route, const DrivingRules& rules) const override;
  [[nodiscard]] ShortcutRules shortcuts(double added_m) const override;

  // The blocks of the places, of the nearest cells where they lie outside the grid, and so many more on each side.
  [[nodiscard]] CellBox box_round(const Point& a, const Point& b, int reach_blocks) const;
  [[nodiscard]] std::shared_ptr<const Window> window_of(const CellBox& box) const;
  // No path between the places that leaves the box is shorter; +inf where the grid ends with it.
  [[nodiscard]] double min_outside_m(const Point& from, const Point& to, const CellBox& box) const;
  [[nodiscard]] const GroundRules& rules() const { return rules_; }

 private:
  void require_near(const Point& from, const Point& to, double reach_m) const;
  [[nodiscard]] bool is_blocked(Cell cell) const { return rules_.blocks(world_.grid.state(cell, rules_.thresholds)); }
  [[nodiscard]] double distance_m(const Point& from, const Point& to, double max_m) const;
  [[nodiscard]] CellBox window_with(const Point& from, const Point& to) const;

  const WorldView& world_;
  GroundRules rules_;
  double disc_m_;
  const PathPlanner& path_planner_;
  const WindowCache& cache_;
  WindowRules windows_;
  bool shortest_;
  int block_cells_;
  mutable std::vector<std::pair<CellBox, std::shared_ptr<const Window>>> used_;
};

}  // namespace cairn
