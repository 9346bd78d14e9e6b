#include "planners/common/any_angle/disc_routes.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "planners/common/any_angle/cleared_paths.hpp"
#include "planners/common/disc_space/field_box.hpp"
#include "planners/common/disc_space/routes.hpp"

namespace cairn {
namespace {

constexpr int kMaxParts = 4;  // of a cell's side, at first
constexpr int kFinerParts = 4;
constexpr std::size_t kKeptRadii = 3;          // on one space: as many margins as a question is tried with
constexpr std::int64_t kMaxCells = 8'000'000;  // of a lattice finer than the grid

std::int64_t cells_of(const CellBox& box) {
  return std::int64_t{box.width()} * box.height();
}

int first_parts(const DiscSpace& space, double radius_m) {
  const double cells = space.cell_m() / radius_m;
  int parts = std::clamp(static_cast<int>(std::ceil(2.0 * cells)), 1, kMaxParts);
  while (parts > 1 && cells_of(space.field().box()) * parts * parts > kMaxCells) --parts;
  return parts;
}

bool is_doubtful(const DiscRoute& found, double ratio = DiscRoutes::kDoubtfulRatio) {
  return found.route.empty() || length_of(found.route) > ratio * found.length_lower_bound_m;
}

template <class IsOpen>
CellMesh mesh_where(const DistanceField& field, const IsOpen& is_open) {
  const CellBox box = field.box();
  std::vector<std::uint8_t> open;
  open.reserve(static_cast<std::size_t>(cells_of(box)));
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) open.push_back(is_open(Cell{x, y}) ? 1 : 0);
  return {box, open};
}

// Distances as they are between whole squares: those between centres to what is blocked, each blocked cell
// with its eight neighbours.
DistanceField between_squares(const DistanceField& field) {
  const CellBox box = field.box();
  std::vector<std::uint8_t> free(static_cast<std::size_t>(cells_of(box)), 1);
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x) {
      if (!field.is_blocked({x, y})) continue;
      for (int v = std::max(y - 1, box.min.y); v <= std::min(y + 1, box.max.y - 1); ++v)
        for (int u = std::max(x - 1, box.min.x); u <= std::min(x + 1, box.max.x - 1); ++u)
          free[static_cast<std::size_t>(v - box.min.y) * static_cast<std::size_t>(box.width()) +
               static_cast<std::size_t>(u - box.min.x)] = 0;
    }
  return {box, field.cell_m(), field.origin_m(), std::move(free)};
}

// From metres to the mesh's lattice and back.
Point to_lattice(const DiscSpace& space, const Point& p_map) {
  return (p_map - space.field().origin_m()) / space.cell_m();
}
std::vector<Point> to_map(const DiscSpace& space, std::vector<Point> points) {
  for (Point& p : points) p = space.field().origin_m() + p * space.cell_m();
  return points;
}

// A cell near an end from which the mesh's paths may begin, for each part of the mesh that is in sight.
std::vector<Point> entry_points(const DiscSpace& space, const CellMesh& mesh, const Point& end, double radius_m,
                                int reach) {
  const Cell at = space.field().cell_at(end);
  if (mesh.rectangle_of(at) != CellMesh::kNone) return {end};
  std::vector<Cell> near;
  for (int y = at.y - reach; y <= at.y + reach; ++y)
    for (int x = at.x - reach; x <= at.x + reach; ++x)
      if (mesh.rectangle_of({x, y}) != CellMesh::kNone) near.push_back({x, y});
  const auto away = [&](Cell c) { return (space.field().centre_of(c) - end).squaredNorm(); };
  std::stable_sort(near.begin(), near.end(), [&](Cell a, Cell b) { return away(a) < away(b); });
  std::vector<Point> entry_points;
  std::vector<CellMesh::Index> parts;
  for (const Cell cell : near) {
    const CellMesh::Index part = mesh.part_of(mesh.rectangle_of(cell));
    if (std::find(parts.begin(), parts.end(), part) != parts.end()) continue;
    if (!space.fits_along(end, space.field().centre_of(cell), radius_m)) continue;
    parts.push_back(part);
    entry_points.push_back(space.field().centre_of(cell));
  }
  return entry_points;
}

}  // namespace

bool has_time_for(const Budget& budget, std::int64_t cells) {
  constexpr double kSecondsPerCell = 5e-7;
  if (budget.deadline == Budget::Clock::time_point::max()) return true;
  const double left_s = std::chrono::duration<double>(budget.deadline - Budget::Clock::now()).count();
  return left_s > kSecondsPerCell * static_cast<double>(cells);
}

DiscRoutes::DiscRoutes(std::shared_ptr<const DiscSpace> space, double radius_m)
    : space_(std::move(space)),
      radius_m_(radius_m),
      is_point_(radius_m <= kPointRadius_m),
      parts_(is_point_ ? 1 : first_parts(*space_, radius_m)),
      coarse_(meshes_of(parts_)) {}

DiscRoutes::Meshes DiscRoutes::meshes_of(int parts) const {
  const auto space = parts == 1 ? space_ : std::make_shared<const DiscSpace>(space_->refined(parts));
  const DistanceField& field = space->field();
  if (is_point_) return {space, mesh_where(field, [&](Cell c) { return !field.is_blocked(c); }), std::nullopt};
  // From some point of a cell to any of a square is as far as from centre to centre at most, and at least
  // as far as between the squares.
  const auto radius_m = static_cast<float>(radius_m_ - 1e-6);
  CellMesh optimistic =
      mesh_where(field, [&](Cell c) { return !field.is_blocked(c) && field.distance_m(c) >= radius_m; });
  const DistanceField squares = between_squares(field);
  const auto all_m = static_cast<float>(radius_m_ + 1e-6);
  return {space, std::move(optimistic), mesh_where(field, [&](Cell c) { return squares.distance_m(c) >= all_m; })};
}

const DiscRoutes::Meshes* DiscRoutes::finer(const Budget& budget) const {
  const int parts = parts_ * kFinerParts;
  const std::int64_t cells = cells_of(space_->field().box()) * parts * parts;
  if (is_point_ || cells > kMaxCells) return nullptr;
  constexpr std::chrono::milliseconds kLookEvery{1};
  std::shared_future<Meshes> made;
  {
    const std::lock_guard lock(finer_mutex_);
    const bool has_time = has_time_for(budget, cells);
    if (!finer_.valid() && has_time)
      finer_ = std::async(std::launch::async, [this, parts] { return meshes_of(parts); }).share();
    made = finer_;
    if (!made.valid() || (!has_time && made.wait_for(kLookEvery * 0) != std::future_status::ready)) return nullptr;
  }
  while (made.wait_for(kLookEvery) != std::future_status::ready)
    if (budget.exhausted()) return nullptr;
  return &finer_.get();
}

bool DiscRoutes::may_reach(const Point& from, const Point& to) const {
  const auto part = [&](const Point& p) {
    const CellMesh::Index at = coarse_.optimistic.rectangle_of(coarse_.space->field().cell_at(p));
    return at == CellMesh::kNone ? CellMesh::kNone : coarse_.optimistic.part_of(at);
  };
  return part(from) != CellMesh::kNone && part(from) == part(to);
}

double DiscRoutes::length_lower_bound_m(const Point& from, const Point& to, const Budget& budget) const {
  if (!may_reach(from, to)) return std::numeric_limits<double>::infinity();
  const DiscSpace& space = *coarse_.space;
  const auto stop = [&budget] { return budget.exhausted(); };
  return shortest_path(coarse_.optimistic, to_lattice(space, from), to_lattice(space, to), stop).length *
         space.cell_m();
}

NumberedCells DiscRoutes::cells_between(const Point& from, const Point& to, double max_m, const Budget& budget) const {
  constexpr int kAskEvery = 4096;
  const CellMesh& mesh = coarse_.optimistic;
  const DistanceField& field = coarse_.space->field();
  const CellMesh::Index start = mesh.rectangle_of(field.cell_at(from));
  NumberedCells cells;
  if (start == CellMesh::kNone) return cells;
  const auto min_m = [&](const CellBox& cells_of_box) {  // from point to box to point
    const FieldBox box = box_of(field, cells_of_box);
    const auto off_m = [&box](const Point& p) { return (box.low - p).cwiseMax(p - box.high).cwiseMax(0.0).norm(); };
    return off_m(from) + off_m(to);
  };
  int asked = 0;
  const auto is_over = [&] { return ++asked % kAskEvery == 0 && budget.exhausted(); };
  for (CellMesh::Index i = 0; i < mesh.rectangles(); ++i) {
    if (is_over()) return {};
    const CellBox& r = mesh.rectangle(i);
    if (mesh.part_of(i) != mesh.part_of(start) || min_m(r) > max_m) continue;
    if (std::isinf(max_m)) {
      cells.add(r);
      continue;
    }
    for (int y = r.min.y; y < r.max.y; ++y) {
      int begin = r.min.x;  // of the run of cells that are near enough
      for (int x = r.min.x; x < r.max.x; ++x) {
        if (is_over()) return {};
        if (min_m({{x, y}, {x + 1, y + 1}}) <= max_m) continue;
        cells.add({{begin, y}, {x, y + 1}});
        begin = x + 1;
      }
      cells.add({{begin, y}, {r.max.x, y + 1}});
    }
  }
  return cells;
}

DiscRoute DiscRoutes::route_on(const Meshes& meshes, const Point& from, const Point& to, const Budget& budget) const {
  const DiscSpace& space = *meshes.space;
  const auto stop = [&budget] { return budget.exhausted(); };
  DiscRoute answer;
  const MeshPath least = shortest_path(meshes.optimistic, to_lattice(space, from), to_lattice(space, to), stop);
  answer.expanded = least.expanded;
  answer.interrupted = least.interrupted;
  answer.impossible = least.points.empty() && !least.interrupted;
  if (least.points.empty()) return answer;
  answer.length_lower_bound_m = least.length * space.cell_m();
  std::vector<Point> min_path = to_map(space, least.points);
  min_path.front() = from;
  min_path.back() = to;
  if (!meshes.conservative) {
    answer.route = off_corners(space, min_path);
    return answer;
  }
  const int reach = 2 * std::max(1, static_cast<int>(std::lround(space_->cell_m() / space.cell_m()))) + 1;
  double best_m = std::numeric_limits<double>::infinity();
  for (const Point& first : entry_points(space, *meshes.conservative, from, radius_m_, reach))
    for (const Point& last : entry_points(space, *meshes.conservative, to, radius_m_, reach)) {
      const MeshPath path =
          shortest_path(*meshes.conservative, to_lattice(space, first), to_lattice(space, last), stop);
      answer.expanded += path.expanded;
      answer.interrupted = answer.interrupted || path.interrupted;
      if (path.points.empty()) continue;
      std::vector<Point> route = to_map(space, path.points);
      first == from ? void(route.front() = from) : void(route.insert(route.begin(), from));
      last == to ? void(route.back() = to) : route.push_back(to);
      if (length_of(route) >= best_m) continue;
      best_m = length_of(route);
      answer.route = std::move(route);
    }
  if (!answer.route.empty()) answer.route = shortest_of(space, answer.route, budget);
  if (answer.interrupted || !is_doubtful(answer)) return answer;
  const std::vector<Point> pushed = shortest_of(space, pushed_clear(space, min_path, radius_m_, budget), budget);
  if (!pushed.empty() && (answer.route.empty() || length_of(pushed) < length_of(answer.route))) answer.route = pushed;
  return answer;
}

std::vector<Point> DiscRoutes::shortest_of(const DiscSpace& space, const std::vector<Point>& route,
                                           const Budget& budget) const {
  if (route.empty()) return route;
  return tightened(space, straightened(space, route, radius_m_, 1, budget), radius_m_, 1, budget);
}

DiscRoute DiscRoutes::coarse_route(const Point& from, const Point& to, const Budget& budget) const {
  DiscRoute answer;
  if (!may_reach(from, to)) {
    answer.impossible = true;
    return answer;
  }
  if (space_->fits_along(from, to, radius_m_)) {
    answer.route = {from, to};
    answer.length_lower_bound_m = (to - from).norm();
    return answer;
  }
  return route_on(coarse_, from, to, budget);
}

DiscRoute DiscRoutes::route(const Point& from, const Point& to, const Budget& budget, double doubtful_ratio) const {
  DiscRoute answer = coarse_route(from, to, budget);
  if (answer.interrupted || answer.impossible || !is_doubtful(answer, doubtful_ratio)) return answer;
  const Meshes* const fine = finer(budget);
  if (fine == nullptr) return answer;
  DiscRoute better = route_on(*fine, from, to, budget);
  better.expanded += answer.expanded;
  better.length_lower_bound_m = std::max(better.length_lower_bound_m, answer.length_lower_bound_m);
  if (answer.route.empty()) return better;
  if (better.route.empty() || length_of(better.route) >= length_of(answer.route)) better.route = answer.route;
  better.interrupted = false;
  better.impossible = false;
  return better;
}

std::shared_ptr<const DiscRoutes> DiscRoutesCache::routes_of(const std::shared_ptr<const DiscSpace>& space,
                                                             double radius_m) const {
  const std::lock_guard lock(mutex_);
  std::erase_if(kept_, [&](const auto& routes) { return &routes->space() != space.get(); });
  const auto found = std::ranges::find_if(kept_, [&](const auto& routes) { return routes->radius_m() == radius_m; });
  if (found != kept_.end()) {
    std::rotate(kept_.begin(), found, found + 1);
    return kept_.front();
  }
  if (kept_.size() == kKeptRadii) kept_.pop_back();
  kept_.insert(kept_.begin(), std::make_shared<const DiscRoutes>(space, radius_m));
  return kept_.front();
}

std::shared_ptr<const DiscRoutes> DiscRoutesCache::last() const {
  const std::lock_guard lock(mutex_);
  return kept_.empty() ? nullptr : kept_.front();
}

}  // namespace cairn
