#include "plugins/behaviours/lookouts/frontiers.hpp"

#include <algorithm>
#include <limits>

namespace cairn::behaviours {
namespace {

constexpr int kStraight = 5;
constexpr int kDiagonal = 7;
constexpr Cell kBeside[4] = {{0, -1}, {-1, 0}, {1, 0}, {0, 1}};

bool has_beside(const FreeSpace& space, Cell cell, CellState state) {
  return std::any_of(std::begin(kBeside), std::end(kBeside),
                     [&](Cell step) { return space.box().contains(cell + step) && space.state(cell + step) == state; });
}

bool cuts_corner(const FreeSpace& space, Cell from, Cell step) {
  return space.state(from + Cell{step.x, 0}) == CellState::occupied ||
         space.state(from + Cell{0, step.y}) == CellState::occupied;
}

template <class Accept>
std::vector<Cell> cells_where(const CellBox& box, const Accept& accept) {
  std::vector<Cell> cells;
  for (int y = box.min.y; y < box.max.y; ++y)
    for (int x = box.min.x; x < box.max.x; ++x)
      if (accept(Cell{x, y})) cells.push_back({x, y});
  return cells;
}

}  // namespace

bool is_frontier(const FreeSpace& space, Cell cell) {
  return space.state(cell) == CellState::free && has_beside(space, cell, CellState::unknown);
}

bool is_edge(const FreeSpace& space, Cell cell) {
  return space.state(cell) == CellState::occupied && has_beside(space, cell, CellState::free);
}

std::vector<Cell> frontier_cells(const FreeSpace& space) {
  return cells_where(space.box(), [&](Cell c) { return is_frontier(space, c); });
}

std::vector<Cell> edge_cells(const FreeSpace& space) {
  return cells_where(space.box(), [&](Cell c) { return is_edge(space, c); });
}

std::vector<Cell> far_edge_cells(const FreeSpace& space, int within_cells) {
  const auto has_free_near = [&](Cell c) {
    for (int dy = -within_cells; dy <= within_cells; ++dy)
      for (int dx = -within_cells; dx <= within_cells; ++dx)
        if (space.state(c + Cell{dx, dy}) == CellState::free) return true;
    return false;
  };
  return cells_where(space.box(), [&](Cell c) { return space.state(c) == CellState::occupied && has_free_near(c); });
}

// Dial's algorithm with steps of 5 and 7 fifths of a cell: one bucket a distance.
std::vector<std::optional<Cell>> lookouts(const FreeSpace& space, const std::vector<CellGroup>& groups, double within_m,
                                          bool over_unknown) {
  struct Entry {
    Cell cell;
    int group;
  };
  const int most = static_cast<int>(std::lround(kStraight * within_m / space.cell_m()));
  std::vector<std::vector<Entry>> buckets(static_cast<std::size_t>(most) + 1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Cell c : groups[g]) buckets[0].push_back({c, static_cast<int>(g)});

  std::vector<std::optional<Cell>> best(groups.size());
  std::vector<double> best_cost_m(groups.size(), std::numeric_limits<double>::infinity());
  CellLayer<char> settled(space.box(), 0, 1);
  for (int length = 0; length <= most; ++length) {
    for (const Entry entry : buckets[static_cast<std::size_t>(length)]) {
      if (settled.at(entry.cell)) continue;
      settled[entry.cell] = 1;
      const auto g = static_cast<std::size_t>(entry.group);
      if (const double cost_m = space.cost_m(entry.cell); cost_m < best_cost_m[g]) {
        best_cost_m[g] = cost_m;
        best[g] = entry.cell;
      }
      for (const Cell step : kNeighbours) {
        const bool is_diagonal = step.x != 0 && step.y != 0;
        const int next_length = length + (is_diagonal ? kDiagonal : kStraight);
        const Cell next = entry.cell + step;
        if (is_diagonal && cuts_corner(space, entry.cell, step)) continue;
        const CellState state = space.state(next);
        const bool is_open = state == CellState::free || (over_unknown && state == CellState::unknown);
        if (next_length <= most && !settled.at(next) && is_open)
          buckets[static_cast<std::size_t>(next_length)].push_back({next, entry.group});
      }
    }
  }
  return best;
}

}  // namespace cairn::behaviours
