#include "tests/conformance/planner_world.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cairn::conformance {
namespace {

constexpr int kScale = 2;  // cells a character
constexpr LogOdds kSure = 1000;
constexpr Cell kDoorLow{20, 28};
constexpr Cell kDoorHigh{22, 34};

const std::vector<std::string> kRows{
    "#####################",  //
    "#.........#.........#",  //
    "#.........#.........#",  //
    "#.........#.........#",  //
    "#...................#",  //
    "#...................#",  //
    "#...................#",  //
    "#.........#.........#",  //
    "#.........#.........#",  //
    "#.........#.........#",  //
    "#####################",  //
    "#####################",  //
    "#####################",  //
    "#####################",  //
    "#####################",  //
    "#####################",  //
    "#####################",  //
    "#.......#############",  //
    "#.......#############",  //
    "#.......#############",  //
    "#####################",
};

template <class Visit>
void walk(const std::vector<Pose2>& path, Visit visit) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point from = path[i == 0 ? 0 : i - 1].position();
    const Point way = path[i].position() - from;
    const int steps = std::max(1, static_cast<int>(std::ceil(way.norm() / 0.01)));
    for (int k = 0; k <= steps; ++k) visit(Point(from + way * (static_cast<double>(k) / steps)));
  }
}

double distance_to_cell_m(const OccupancyGrid& grid, Cell cell, const Point& p) {
  const Point off = (p - grid.centre_of(cell)).cwiseAbs() - Point(0.5, 0.5) * grid.cell_m();
  return off.cwiseMax(0.0).norm();
}

}  // namespace

PlannerWorld::PlannerWorld() {
  for (std::size_t row = 0; row < kRows.size(); ++row)
    for (std::size_t column = 0; column < kRows[row].size(); ++column)
      for (int i = 0; i < kScale * kScale; ++i) {
        const Cell cell{static_cast<int>(column) * kScale + i % kScale,
                        static_cast<int>(kRows.size() - 1 - row) * kScale + i / kScale};
        grid.set_log_odds(cell, kRows[row][column] == '#' ? kSure : static_cast<LogOdds>(-kSure));
      }
  for (const Pose2& place : {left, right, behind_walls}) {
    Landmark landmark;
    landmark.category = "square";
    landmark.T_map_landmark = place;
    landmark.access = place;
    graph.add(landmark);
  }
  Route there;
  there.from = 1;
  there.to = 2;
  there.trajectory = {left, {1.8, 3.1, 0.0}, {2.5, 3.1, 0.0}, right};
  there.cost_m = length_of(there.trajectory);
  Route back = there;
  std::swap(back.from, back.to);
  std::reverse(back.trajectory.begin(), back.trajectory.end());
  graph.add_route(there);
  graph.add_route(back);
}

void PlannerWorld::close_door() {
  set_door(kSure);
}

void PlannerWorld::forget_door() {
  set_door(0);
}

void PlannerWorld::set_door(LogOdds log_odds) {
  for (int y = kDoorLow.y; y < kDoorHigh.y; ++y)
    for (int x = kDoorLow.x; x < kDoorHigh.x; ++x) grid.set_log_odds({x, y}, log_odds);
  std::vector<RouteId> ids;
  for (const auto& [id, route] : graph.routes()) ids.push_back(id);
  for (const RouteId id : ids) graph.set_closed(id, true);
}

std::string PlannerWorld::drawing(const std::vector<Pose2>& path) const {
  const CellBox box = grid.bounds();
  std::vector<std::string> rows(static_cast<std::size_t>(box.height()),
                                std::string(static_cast<std::size_t>(box.width()), ' '));
  const auto mark = [&](Cell cell, char as) {
    if (box.contains(cell))
      rows[static_cast<std::size_t>(box.max.y - 1 - cell.y)][static_cast<std::size_t>(cell.x - box.min.x)] = as;
  };
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (grid.state({x, y}) != CellState::unknown) mark({x, y}, grid.state({x, y}) == CellState::occupied ? '#' : '.');
  walk(path, [&](const Point& p) { mark(grid.cell_at(p), '*'); });
  std::string text = "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

double distance_to_occupied_m(const OccupancyGrid& grid, const std::vector<Pose2>& path) {
  constexpr int kNear_cells = 10;
  double min_m = std::numeric_limits<double>::infinity();
  walk(path, [&](const Point& p) {
    const Cell here = grid.cell_at(p);
    for (int y = here.y - kNear_cells; y <= here.y + kNear_cells; ++y)
      for (int x = here.x - kNear_cells; x <= here.x + kNear_cells; ++x)
        if (grid.state({x, y}) == CellState::occupied) min_m = std::min(min_m, distance_to_cell_m(grid, {x, y}, p));
  });
  return min_m;
}

}  // namespace cairn::conformance
