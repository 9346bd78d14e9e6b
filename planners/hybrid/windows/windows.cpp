#include "planners/hybrid/windows/windows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contracts/view/cell_source.hpp"

namespace cairn {
namespace {

constexpr std::int64_t kMaxKept_cells = 4'000'000;  // of all windows
constexpr double kMaxShortcut_m = 25.0;
constexpr double kWork_cells = 1e6;  // of shortening a path
constexpr double kDrivingStep_m = 0.1;
constexpr double kNearest_m = 0.5;  // clearances are looked for so far out at first

std::int64_t cells_of(const CellBox& box) {
  return std::int64_t{box.width()} * box.height();
}

int floor_divided(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

PathResult path_of(const DiscRoute& found, const Pose2& from, const Place& to) {
  PathResult result;
  if (found.route.empty()) return result;
  result.outcome = PlanOutcome::solved;
  result.reason = "the shortest path in the surroundings of both ends";
  result.length_m = length_of(found.route);
  result.cost_m = result.length_m;
  result.length_lower_bound_m = found.length_lower_bound_m;
  const auto heading = to.heading_matters ? std::optional(to.pose->theta_rad) : std::nullopt;
  result.path = poses_along(found.route, from.theta_rad, heading);
  return result;
}

}  // namespace

std::shared_ptr<const Window> WindowCache::find(const WorldView& world, const CellBox& box, const GroundRules& rules,
                                                double disc_m) const {
  const std::lock_guard lock(mutex_);
  const auto at = std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const OccupancyGrid& grid = entry.window->grid;
    return entry.box == box && grid.cell_m() == world.grid.cell_m() && grid.origin_m() == world.grid.origin_m() &&
           entry.window->routes->radius_m() == disc_m && entry.window->routes->space().rules() == rules;
  });
  if (at == entries_.end()) return nullptr;
  const bool known = world.grid_version != 0 && at->version == world.grid_version;
  if (!known && part_of(world.grid, box) != at->window->grid) {
    entries_.erase(at);
    return nullptr;
  }
  at->version = world.grid_version;
  entries_.splice(entries_.begin(), entries_, at);
  return entries_.front().window;
}

void WindowCache::keep(const Entry& entry) const {
  const std::lock_guard lock(mutex_);
  entries_.push_front(entry);
  std::int64_t cells = 0;
  auto end = entries_.begin();
  for (; end != entries_.end(); ++end)
    if ((cells += cells_of(end->box)) > kMaxKept_cells && end != entries_.begin()) break;
  entries_.erase(end, entries_.end());
}

std::shared_ptr<const Window> WindowCache::window_of(const WorldView& world, const CellBox& box,
                                                     const GroundRules& rules, double disc_m) const {
  if (auto kept = find(world, box, rules, disc_m)) return kept;
  OccupancyGrid grid = part_of(world.grid, box);
  const auto space = std::make_shared<const DiscSpace>(grid, rules);
  auto window =
      std::make_shared<const Window>(Window{std::move(grid), std::make_shared<const DiscRoutes>(space, disc_m)});
  keep({box, world.grid_version, window});
  return window;
}

WindowedGround::WindowedGround(const WorldView& world, const GroundRules& rules, double disc_m,
                               const PathPlanner& path_planner, const WindowCache& cache, const WindowRules& windows,
                               bool shortest)
    : world_(world),
      rules_(rules),
      disc_m_(disc_m),
      path_planner_(path_planner),
      cache_(cache),
      windows_(windows),
      shortest_(shortest),
      block_cells_(std::max(1, static_cast<int>(std::lround(windows.block_m / world.grid.cell_m())))) {}

void WindowedGround::require_near(const Point& from, const Point& to, double reach_m) const {
  if (world_.cells == nullptr) return;
  const Point reach(reach_m, reach_m);
  world_.cells->require(
      {world_.grid.cell_at(from.cwiseMin(to) - reach), world_.grid.cell_at(from.cwiseMax(to) + reach) + Cell{1, 1}});
}

bool WindowedGround::fits_with(const Point& from, const Point& to, double added_m) const {
  if (!from.allFinite() || !to.allFinite()) return false;
  const CellBox inside = world_.grid.bounds().grown(1);  // no centre of a disc leaves them, as in a DiscSpace
  if (!inside.contains(world_.grid.cell_at(from)) || !inside.contains(world_.grid.cell_at(to))) return false;
  require_near(from, to, disc_m_ + added_m);
  return sweep_is_free(world_.grid, rules_, from, to, disc_m_ + added_m);
}

std::optional<Pose2> WindowedGround::approach(const Landmark& landmark) const {
  if (landmark.access && fits_along(landmark.access->position(), landmark.access->position())) return landmark.access;
  const Point at = landmark.approach_pose().position();
  return approach_pose(window_of(box_round(at, at, windows_.reach_blocks))->routes->space(), landmark, disc_m_);
}

PathResult WindowedGround::path(const PathRequest& request, const Budget& budget) const {
  const Point from = request.from.pose->position();
  const Point to = request.to.pose->position();
  const CellBox box = window_with(from, to);
  const std::shared_ptr<const Window> window = window_of(box);
  PathResult result;
  if (shortest_ && request.cost == CostKind::length)
    result = path_of(window->routes->coarse_route(from, to, budget), *request.from.pose, request.to);
  if (result.outcome != PlanOutcome::solved) {
    WorldView part{window->grid, world_.graph, world_.robot, world_.pose, world_.time_s};
    part.speed_law = world_.speed_law;
    result = path_planner_.plan(request, part, budget);
  }
  const double outside_m = min_outside_m(from, to, box);
  if (result.length_lower_bound_m) result.length_lower_bound_m = std::min(*result.length_lower_bound_m, outside_m);
  return result;
}

double WindowedGround::distance_m(const Point& from, const Point& to, double max_m) const {
  const Lattice lattice{world_.grid.origin_m(), world_.grid.cell_m()};
  double best_m = max_m;
  require_near(from, to, max_m);
  (void)any_cell_near(lattice, from, to, max_m, [&](Cell cell) {
    if (is_blocked(cell))
      best_m = std::min(best_m, distance_to_square_m(from, to, lattice.centre_of(cell), lattice.cell_m));
    return false;
  });
  return best_m;
}

double WindowedGround::clearance_m(const std::vector<Point>& route, double radius_m) const {
  const CellBox box = world_.grid.bounds();
  const double all_m = std::hypot(box.width(), box.height()) * world_.grid.cell_m();
  for (double max_m = radius_m + kNearest_m;; max_m *= 2.0) {
    double nearest_m = max_m;
    for (std::size_t i = 0; i < route.size(); ++i)
      nearest_m = distance_m(route[i == 0 ? 0 : i - 1], route[i], nearest_m);
    if (nearest_m < max_m) return std::max(nearest_m - radius_m, 0.0);
    if (max_m > all_m) return std::numeric_limits<double>::infinity();
  }
}

// As driving_time_s() of a distance field counts it, with exact distances.
double WindowedGround::driving_time_s(const std::vector<Point>& route, const DrivingRules& rules) const {
  const double open_m = rules.radius_m + rules.pace.open_from_m();
  double time_s = 0.0;
  for (std::size_t i = 1; i < route.size(); ++i) {
    const Point step = route[i] - route[i - 1];
    const int steps = std::max(1, static_cast<int>(std::ceil(step.norm() / kDrivingStep_m)));
    for (int k = 0; k < steps; ++k) {
      const Point middle = route[i - 1] + (k + 0.5) / steps * step;
      time_s += step.norm() / steps * rules.pace.s_per_m(distance_m(middle, middle, open_m) - rules.radius_m);
    }
  }
  return time_s;
}

ShortcutRules WindowedGround::shortcuts(double added_m) const {
  ShortcutRules rules;
  rules.fits_along = [this, added_m](const Point& from, const Point& to) { return fits_with(from, to, added_m); };
  rules.cell_m = world_.grid.cell_m();
  rules.max_shortcut_m = kMaxShortcut_m;
  rules.max_work_cells = kWork_cells;
  return rules;
}

CellBox WindowedGround::box_round(const Point& a, const Point& b, int reach_blocks) const {
  const CellBox whole = world_.grid.bounds();
  const auto block_of = [&](const Point& p) {
    Cell cell = world_.grid.cell_at(p);
    cell = {std::clamp(cell.x, whole.min.x, whole.max.x - 1), std::clamp(cell.y, whole.min.y, whole.max.y - 1)};
    return Cell{floor_divided(cell.x, block_cells_), floor_divided(cell.y, block_cells_)};
  };
  const Cell at = block_of(a.cwiseMin(b));
  const CellBox blocks = CellBox{at, block_of(a.cwiseMax(b)) + Cell{1, 1}}.grown(reach_blocks);
  return intersected({{blocks.min.x * block_cells_, blocks.min.y * block_cells_},
                      {blocks.max.x * block_cells_, blocks.max.y * block_cells_}},
                     whole);
}

std::shared_ptr<const Window> WindowedGround::window_of(const CellBox& box) const {
  for (const auto& [used, window] : used_)
    if (used == box) return window;
  if (world_.cells != nullptr) world_.cells->require(box);
  used_.emplace_back(box, cache_.window_of(world_, box, rules_, disc_m_));
  return used_.back().second;
}

// What is beside the ends counts too: a block on each side, where the grid goes on.
CellBox WindowedGround::window_with(const Point& from, const Point& to) const {
  const CellBox all = box_round(from, to, windows_.reach_blocks);
  const CellBox ends = box_round(from, to, 0);
  for (const auto& [used, window] : used_)
    if (used == all || united(used, ends) == used) return used;
  return all;
}

double WindowedGround::min_outside_m(const Point& from, const Point& to, const CellBox& box) const {
  const CellBox whole = world_.grid.bounds();
  const Point low = world_.grid.origin_m() + world_.grid.cell_m() * Point(box.min.x, box.min.y);
  const Point high = world_.grid.origin_m() + world_.grid.cell_m() * Point(box.max.x, box.max.y);
  // By way of a line: the straight one to the mirrored end.
  const auto by_rim_m = [&](int axis, double a_m, double b_m) {
    return std::hypot(std::max(0.0, a_m - disc_m_) + std::max(0.0, b_m - disc_m_), to[1 - axis] - from[1 - axis]);
  };
  double min_m = std::numeric_limits<double>::infinity();
  for (const int axis : {0, 1}) {
    const auto at = [axis](Cell cell) { return axis == 0 ? cell.x : cell.y; };
    if (at(box.min) > at(whole.min))
      min_m = std::min(min_m, by_rim_m(axis, from[axis] - low[axis], to[axis] - low[axis]));
    if (at(box.max) < at(whole.max))
      min_m = std::min(min_m, by_rim_m(axis, high[axis] - from[axis], high[axis] - to[axis]));
  }
  return min_m;
}

}  // namespace cairn
