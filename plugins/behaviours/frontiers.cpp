#include "plugins/behaviours/frontiers.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <tuple>

namespace cairn::behaviours {
namespace {

constexpr Cell kBeside[4] = {{0, -1}, {-1, 0}, {1, 0}, {0, 1}};

bool has_beside(const FreeSpace& space, Cell cell, CellState state) {
  return std::any_of(std::begin(kBeside), std::end(kBeside),
                     [&](Cell step) { return space.box().contains(cell + step) && space.state(cell + step) == state; });
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

std::vector<std::optional<Cell>> lookouts(const FreeSpace& space, const std::vector<CellGroup>& groups,
                                          double within_m) {
  struct Owner {
    float way_m = std::numeric_limits<float>::infinity();
    int group = -1;
  };
  using Entry = std::tuple<float, Cell, int>;
  CellLayer<Owner> owner(space.box(), {}, {});
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Cell c : groups[g]) queue.emplace(0.0F, c, static_cast<int>(g));

  std::vector<std::optional<Cell>> best(groups.size());
  std::vector<double> best_cost_m(groups.size(), std::numeric_limits<double>::infinity());
  const auto cell_m = static_cast<float>(space.cell_m());
  const double most_m = within_m + 0.01 * space.cell_m();  // sums of cells, give or take rounding
  while (!queue.empty()) {
    const auto [way_m, cell, group] = queue.top();
    queue.pop();
    if (owner.at(cell).group >= 0) continue;
    owner[cell] = {way_m, group};
    const auto g = static_cast<std::size_t>(group);
    if (const double cost_m = space.cost_m(cell); cost_m < best_cost_m[g]) {
      best_cost_m[g] = cost_m;
      best[g] = cell;
    }
    for (const Cell step : kNeighbours) {
      const Cell next = cell + step;
      const float next_m = way_m + cell_m * (step.x != 0 && step.y != 0 ? std::numbers::sqrt2_v<float> : 1.0F);
      if (next_m > most_m || owner.at(next).group >= 0 || space.state(next) != CellState::free) continue;
      if (next_m < owner.at(next).way_m) {
        owner[next].way_m = next_m;
        queue.emplace(next_m, next, group);
      }
    }
  }
  return best;
}

}  // namespace cairn::behaviours
