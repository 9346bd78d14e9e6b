#include "plugins/behaviours/local_map/free_space.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plugins/common/motion/path.hpp"

namespace cairn::behaviours {
namespace {

constexpr double kForbidden = 1e6;  // the step weight of cells that may not be crossed
constexpr double kOutOfReach_m = 1e4;
constexpr float kDearest = 1e5F;                             // the start may lie where nothing may be crossed
constexpr double kShortcutCost = 1.02;                       // of what it replaces: rounding
constexpr int kStraightFirst[8] = {1, 3, 4, 6, 0, 2, 5, 7};  // of kNeighbours

}  // namespace

void FreeSpaceSettings::describe(Fields<FreeSpaceSettings>& fields) {
  using C = FreeSpaceSettings;
  fields.number("preferred_room_m", &C::preferred_room_m, {0.01, 5.0}, "m",
                "room beyond the clearance from which on a metre of path costs no more than its length");
  fields.number("tight_cost", &C::tight_cost, {0.0, 1000.0}, "", "extra cost of a metre with no room to spare");
  fields.number("avoided_cost", &C::avoided_cost, {0.0, 1e5}, "",
                "extra cost of a metre where the robot was blocked a while ago");
  fields.number("avoided_radius_m", &C::avoided_radius_m, {0.0, 5.0}, "m", "around such a place");
  fields.number("longest_escape_m", &C::longest_escape_m, {0.0, 5.0}, "m",
                "a robot that stands too near to something looks for room within this distance");
  fields.integer("longest_shortcut_cells", &C::longest_shortcut_cells, {2.0, 10000.0},
                 "straight pieces of paths replace at most so many cells");
}

CellLayer<CellState> FreeSpace::known_states(const OccupancyGrid& grid, const DistanceField& field, double radius_m,
                                             const std::vector<Pose2>& trace) {
  const CellBox box = field.box();
  CellLayer<CellState> states(box, CellState::unknown, CellState::unknown);
  std::vector<LogOdds> row(static_cast<std::size_t>(std::max(0, box.width())));
  for (int y = box.min.y; y < box.max.y; ++y) {
    grid.copy_log_odds({{box.min.x, y}, {box.max.x, y + 1}}, row);
    for (int x = box.min.x; x < box.max.x; ++x)
      states[{x, y}] = OccupancyThresholds{}.state(row[static_cast<std::size_t>(x - box.min.x)]);
  }
  const int reach = static_cast<int>(radius_m / field.cell_m());
  for (const Pose2& pose : trace) {
    const Cell centre = field.cell_at(pose.position());
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        const Cell c = centre + Cell{dx, dy};
        if (dx * dx + dy * dy <= reach * reach && box.contains(c) && states[c] == CellState::unknown)
          states[c] = CellState::free;
      }
    }
  }
  return states;
}

CellLayer<float> FreeSpace::weights(const std::vector<TroubleSpot>& troubles) const {
  CellLayer<float> all(box(), static_cast<float>(kForbidden), static_cast<float>(kForbidden));
  for (int y = box().min.y; y < box().max.y; ++y) {
    for (int x = box().min.x; x < box().max.x; ++x) {
      const Cell c{x, y};
      if (states_.at(c) != CellState::free || field_.distance_m(c) < min_m_) continue;
      const double missing_m = std::max(0.0, min_m_ + robot_.settings.preferred_room_m - field_.distance_m(c));
      double weight = 1.0 + robot_.settings.tight_cost * missing_m / robot_.settings.preferred_room_m;
      for (const TroubleSpot& spot : troubles)
        if ((centre_of(c) - spot.at_m).norm() < robot_.settings.avoided_radius_m)
          weight += robot_.settings.avoided_cost;
      all[c] = static_cast<float>(weight);
    }
  }
  return all;
}

// Breadth first over cells that are not occupied, to the first one with enough room.
std::vector<Point> FreeSpace::find_escape_path() const {
  std::vector<Point> path{robot_.position};
  const Cell start = cell_at(robot_.position);
  if (!box().contains(start) || weights_.at(start) < kForbidden) return path;

  const int reach = static_cast<int>(robot_.settings.longest_escape_m / cell_m());
  const CellBox near = intersected(box(), CellBox{start, start + Cell{1, 1}}.grown(reach));
  CellLayer<std::int8_t> came_from(near, -1, -1);
  CellGroup queue{start};
  came_from[start] = 8;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const Cell here = queue[i];
    if (weights_.at(here) < kForbidden) {
      for (Cell c = here; c != start; c = c + kNeighbours[7 - came_from.at(c)]) path.push_back(centre_of(c));
      std::reverse(path.begin() + 1, path.end());
      return path;
    }
    for (const int k : kStraightFirst) {
      const Cell next = here + kNeighbours[k];
      if (!near.contains(next) || came_from.at(next) >= 0 || states_.at(next) == CellState::occupied) continue;
      came_from[next] = static_cast<std::int8_t>(k);
      queue.push_back(next);
    }
  }
  return path;
}

TravelField FreeSpace::travel_from_escape() const {
  // Only what can be crossed, so that the search never leaves it.
  OccupancyGrid crossable(field_.cell_m(), 4.0, field_.origin_m());
  for (int y = box().min.y; y < box().max.y; ++y)
    for (int x = box().min.x; x < box().max.x; ++x)
      if (weights_.at({x, y}) < kForbidden) crossable.set_log_odds({x, y}, log_odds_of(0.01));
  const DistanceField field(crossable, UnknownPolicy::avoid);
  return TravelField(field, escape_path_.back(), 0.0, [this](Cell c) { return std::min(weights_.at(c), kDearest); });
}

FreeSpace::FreeSpace(const OccupancyGrid& grid, const RobotSpace& robot, const std::vector<Pose2>& trace,
                     const std::vector<TroubleSpot>& troubles)
    : robot_(robot),
      min_m_(robot.radius_m + robot.clearance_m),
      field_(grid, UnknownPolicy::allow),
      states_(known_states(grid, field_, robot.radius_m, trace)),
      weights_(weights(troubles)),
      escape_path_(find_escape_path()) {}

const TravelField& FreeSpace::travel() const {
  if (!*travel_) travel_->emplace(travel_from_escape());
  return **travel_;
}

bool FreeSpace::reaches(Cell cell) const {
  return cost_m(cell) < kOutOfReach_m;
}

double FreeSpace::cost_m(Cell cell) const {
  const double cost = travel().cost_m(cell);
  return cost < kOutOfReach_m && weights_.at(cell) < kForbidden ? cost + length_of(escape_path_)
                                                                : std::numeric_limits<double>::infinity();
}

double FreeSpace::line_cost(const Point& from, const Point& to) const {
  if (!segment_is_clear(field_, from, to, min_m_)) return std::numeric_limits<double>::infinity();
  const double length_m = (to - from).norm();
  const int steps = std::max(1, static_cast<int>(std::ceil(length_m / (0.5 * cell_m()))));
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) {
    const double weight = weights_.at(cell_at(from + (to - from) * (static_cast<double>(i) / steps)));
    if (weight >= kForbidden) return std::numeric_limits<double>::infinity();
    sum += weight;
  }
  return length_m * sum / (steps + 1);
}

std::vector<Point> FreeSpace::straightened(const std::vector<Cell>& cells) const {
  std::vector<Point> path;
  std::size_t at = 0;
  path.push_back(centre_of(cells[0]));
  while (at + 1 < cells.size()) {
    std::size_t next = at + 1;
    for (std::size_t i = at + 2;
         i < std::min(cells.size(), at + static_cast<std::size_t>(robot_.settings.longest_shortcut_cells)); ++i) {
      const double saved_m = travel().cost_m(cells[i]) - travel().cost_m(cells[at]);
      if (line_cost(path.back(), centre_of(cells[i])) <= kShortcutCost * saved_m) next = i;
    }
    at = next;
    path.push_back(centre_of(cells[at]));
  }
  return path;
}

std::vector<Point> FreeSpace::path_to(Cell cell) const {
  if (!reaches(cell)) return {};
  std::vector<Point> path = escape_path_;
  const std::vector<Point> rest = straightened(travel().path_to(cell));
  // The first cell is the one that the escape path ends in.
  path.insert(path.end(), rest.begin() + (rest.size() > 1 ? 1 : 0), rest.end());
  return path;
}

bool FreeSpace::line_is_open(const Point& from, const Point& to) const {
  return line_cost(from, to) < std::numeric_limits<double>::infinity();
}

bool FreeSpace::sees(const Point& from, Cell cell) const {
  const Point to = centre_of(cell);
  const int steps = static_cast<int>(std::ceil((to - from).norm() / (0.5 * cell_m())));
  for (int i = 1; i < steps; ++i) {
    const Cell c = cell_at(from + (to - from) * (static_cast<double>(i) / steps));
    if (distance8(c, cell) > 1 && states_.at(c) == CellState::occupied) return false;
  }
  return true;
}

bool path_is_blocked(const OccupancyGrid& grid, const std::vector<Point>& path, double along_m, double ahead_m,
                     double radius_m) {
  const auto is_occupied = [&](Cell c) { return grid.state(c) == CellState::occupied; };
  return path_is_blocked(grid, is_occupied, path, along_m, ahead_m, radius_m);
}

bool path_is_blocked(const OccupancyGrid& space, const std::function<bool(Cell)>& is_occupied,
                     const std::vector<Point>& path, double along_m, double ahead_m, double radius_m) {
  if (path.empty()) return false;
  const double end_m = std::min(along_m + ahead_m, length_of(path));
  const double radius_cells = radius_m / space.cell_m();
  const int reach = static_cast<int>(radius_cells);
  for (double s = along_m; s <= end_m; s += 2.0 * space.cell_m()) {
    const Cell centre = space.cell_at(motion::point_along(path, s));
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        if (dx * dx + dy * dy > radius_cells * radius_cells) continue;
        if (is_occupied(centre + Cell{dx, dy})) return true;
      }
    }
  }
  return false;
}

}  // namespace cairn::behaviours
