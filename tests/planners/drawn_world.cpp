#include "tests/planners/drawn_world.hpp"

#include <cctype>
#include <limits>
#include <sstream>

namespace cairn::test {
namespace {

constexpr LogOdds kSure = 1000;

LogOdds log_odds_for(CellState state) {
  if (state == CellState::occupied) return kSure;
  return state == CellState::free ? static_cast<LogOdds>(-kSure) : LogOdds{0};
}

CellState state_of(char mark) {
  if (mark == '#') return CellState::occupied;
  return mark == '?' ? CellState::unknown : CellState::free;
}

void fill_block(OccupancyGrid& grid, Cell low, int scale, CellState state) {
  for (int y = 0; y < scale; ++y)
    for (int x = 0; x < scale; ++x) grid.set_log_odds(low + Cell{x, y}, log_odds_for(state));
}

// Points along the path, closely spaced, ends of segments included.
template <class Visit>
void walk(const std::vector<Pose2>& path, double step_m, Visit visit) {
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Point from = path[i == 0 ? 0 : i - 1].position();
    const Point to = path[i].position();
    const int steps = std::max(1, static_cast<int>(std::ceil((to - from).norm() / step_m)));
    for (int k = 0; k <= steps; ++k) visit(Point(from + (to - from) * (static_cast<double>(k) / steps)));
  }
}

double distance_to_cell(const Point& p, const Point& centre, double cell_m) {
  const double dx = std::max(std::abs(p.x() - centre.x()) - 0.5 * cell_m, 0.0);
  const double dy = std::max(std::abs(p.y() - centre.y()) - 0.5 * cell_m, 0.0);
  return std::hypot(dx, dy);
}

}  // namespace

PathRequest DrawnWorld::request(char from, char to, double radius_m) const {
  PathRequest request;
  request.from.pose = pose(from);
  request.to.pose = pose(to);
  request.radius_m = radius_m;
  return request;
}

void DrawnWorld::fill(char place, CellState state) {
  const Cell middle = grid.cell_at(places.at(place));
  const int low = scale / 2;
  fill_block(grid, {middle.x - low, middle.y - low}, scale, state);
}

DrawnWorld drawn_world(const std::string& drawing, double cell_m, int scale) {
  std::vector<std::string> rows;
  std::istringstream lines(drawing);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty()) rows.push_back(line);
  DrawnWorld world;
  world.grid = OccupancyGrid(cell_m);
  world.scale = scale;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const char mark = rows[row][column];
      const Cell low{static_cast<int>(column) * scale, static_cast<int>(rows.size() - 1 - row) * scale};
      fill_block(world.grid, low, scale, state_of(mark));
      if (std::isalpha(static_cast<unsigned char>(mark)))
        world.places[mark] = world.grid.centre_of({low.x + scale / 2, low.y + scale / 2});
    }
  }
  return world;
}

std::string drawing_of(const OccupancyGrid& grid, const std::vector<Pose2>& path) {
  const CellBox box = grid.bounds();
  std::vector<std::string> rows;
  for (int y = box.max.y - 1; y >= box.min.y; --y) {
    rows.emplace_back();
    for (int x = box.min.x; x < box.max.x; ++x) {
      const CellState state = grid.state({x, y});
      rows.back() += state == CellState::occupied ? '#' : state == CellState::unknown ? '?' : '.';
    }
  }
  walk(path, 0.3 * grid.cell_m(), [&](const Point& p) {
    const Cell cell = grid.cell_at(p);
    if (box.contains(cell))
      rows[static_cast<std::size_t>(box.max.y - 1 - cell.y)][static_cast<std::size_t>(cell.x - box.min.x)] = '*';
  });
  std::string text = "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

double distance_by_brute_force(const OccupancyGrid& grid, const std::vector<Pose2>& path, bool only_occupied,
                               double step_m) {
  const CellBox box = grid.bounds().grown(1);
  double best_m = std::numeric_limits<double>::infinity();
  walk(path, step_m, [&](const Point& p) {
    for (int y = box.min.y; y < box.max.y; ++y)
      for (int x = box.min.x; x < box.max.x; ++x) {
        const CellState state = grid.state({x, y});
        if (state == CellState::free || (only_occupied && state == CellState::unknown)) continue;
        best_m = std::min(best_m, distance_to_cell(p, grid.centre_of({x, y}), grid.cell_m()));
      }
  });
  return best_m;
}

}  // namespace cairn::test
