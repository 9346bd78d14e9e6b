#include "tests/bench/routes/lazy_theta_star.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cairn {
namespace {

constexpr std::array<Cell, 8> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

double straight(Cell a, Cell b) {
  return std::hypot(static_cast<double>(a.x - b.x), static_cast<double>(a.y - b.y));
}

double over_eight_neighbours(Cell a, Cell b) {
  const auto [less, more] = std::minmax({std::abs(a.x - b.x), std::abs(a.y - b.y)});
  return more + (std::numbers::sqrt2 - 1.0) * less;
}

}  // namespace

bool sees_along_line(const PlainCells& cells, Cell from, Cell to) {
  const std::int64_t dx = std::abs(to.x - from.x);
  const std::int64_t dy = std::abs(to.y - from.y);
  const int step_x = to.x > from.x ? 1 : -1;
  const int step_y = to.y > from.y ? 1 : -1;
  std::int64_t crossed_x = 0;  // sides of cells passed so far
  std::int64_t crossed_y = 0;
  for (Cell at = from; at != to;) {
    // The next upright side is crossed at (crossed_x + 1/2) / dx of the way, the next level one likewise.
    const std::int64_t later = (2 * crossed_x + 1) * dy - (2 * crossed_y + 1) * dx;
    if (later == 0 && !cells.is_open(at.x + step_x, at.y) && !cells.is_open(at.x, at.y + step_y)) return false;
    if (later <= 0) {
      at.x += step_x;
      ++crossed_x;
    }
    if (later >= 0) {
      at.y += step_y;
      ++crossed_y;
    }
    if (!cells.is_open(at.x, at.y)) return false;
  }
  return cells.is_open(from.x, from.y);
}

PlainSearches::PlainSearches(const PlainCells& cells) : cells_(cells), vertices_(cells.open.size()) {}

template <class Look>
void PlainSearches::each_neighbour(Cell cell, Look look) const {
  for (const Cell step : kSteps) {
    const Cell next = cell + step;
    if (!cells_.is_open(next.x, next.y)) continue;
    if (step.x != 0 && step.y != 0 && !(cells_.is_open(cell.x + step.x, cell.y) && cells_.is_open(cell.x, next.y)))
      continue;
    look(next);
  }
}

// Of equal estimates the one with the longer known part goes first.
bool PlainSearches::comes_after(const Candidate& a, const Candidate& b) {
  return a.estimate != b.estimate ? a.estimate > b.estimate : a.length < b.length;
}

void PlainSearches::begin(Cell from) {
  ++search_;
  open_.clear();
  offer(index(from), index(from), 0.0, 0.0);
}

void PlainSearches::offer(std::int32_t vertex, std::int32_t parent, double length, double estimate) {
  at(vertex) = {search_, parent, false, length};
  open_.push_back({estimate, length, vertex});
  std::push_heap(open_.begin(), open_.end(), comes_after);
}

bool PlainSearches::next(std::int32_t& vertex) {
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end(), comes_after);
    vertex = open_.back().vertex;
    open_.pop_back();
    if (at(vertex).closed) continue;
    at(vertex).closed = true;
    return true;
  }
  return false;
}

PlainPath PlainSearches::path_to(std::int32_t vertex, std::int64_t expanded) {
  PlainPath path{{}, at(vertex).length, expanded};
  for (std::int32_t v = vertex;; v = at(v).parent) {
    path.cells.push_back(cell(v));
    if (at(v).parent == v) break;
  }
  std::reverse(path.cells.begin(), path.cells.end());
  return path;
}

// That the parent sees the vertex was taken for granted when it was offered; now it is looked at.
void PlainSearches::settle_sight(std::int32_t vertex) {
  if (sees_along_line(cells_, cell(at(vertex).parent), cell(vertex))) return;
  at(vertex).length = std::numeric_limits<double>::infinity();
  each_neighbour(cell(vertex), [&](Cell neighbour) {
    const std::int32_t v = index(neighbour);
    if (!is_met(v) || !at(v).closed || v == vertex) return;
    const double length = at(v).length + straight(neighbour, cell(vertex));
    if (length >= at(vertex).length) return;
    at(vertex).length = length;
    at(vertex).parent = v;
  });
}

PlainPath PlainSearches::lazy_theta_star(Cell from, Cell to) {
  if (!cells_.is_open(from.x, from.y) || !cells_.is_open(to.x, to.y)) return {};
  begin(from);
  std::int64_t expanded = 0;
  for (std::int32_t vertex = 0; next(vertex);) {
    settle_sight(vertex);
    if (cell(vertex) == to) return path_to(vertex, expanded);
    ++expanded;
    const std::int32_t parent = at(vertex).parent;
    each_neighbour(cell(vertex), [&](Cell neighbour) {
      const std::int32_t v = index(neighbour);
      const double length = at(parent).length + straight(cell(parent), neighbour);
      if (!is_met(v) || (!at(v).closed && length < at(v).length))
        offer(v, parent, length, length + straight(neighbour, to));
    });
  }
  return {};
}

PlainPath PlainSearches::a_star(Cell from, Cell to) {
  if (!cells_.is_open(from.x, from.y) || !cells_.is_open(to.x, to.y)) return {};
  begin(from);
  std::int64_t expanded = 0;
  for (std::int32_t vertex = 0; next(vertex);) {
    if (cell(vertex) == to) return path_to(vertex, expanded);
    ++expanded;
    const double so_far = at(vertex).length;
    each_neighbour(cell(vertex), [&](Cell neighbour) {
      const std::int32_t v = index(neighbour);
      const double length = so_far + straight(cell(vertex), neighbour);
      if (!is_met(v) || (!at(v).closed && length < at(v).length))
        offer(v, vertex, length, length + over_eight_neighbours(neighbour, to));
    });
  }
  return {};
}

}  // namespace cairn
