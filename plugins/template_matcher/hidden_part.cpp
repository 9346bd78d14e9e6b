#include "plugins/template_matcher/hidden_part.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cairn::template_matcher {
namespace {

constexpr int kBeyond_cells = 2;    // behind the outermost cell; nearer ones are blurred by it
constexpr int kMinClosed = 3;       // side by side
constexpr int kMaxClosed = 10;      // the same
constexpr int kMaxOtherClosed = 3;  // not beside these

Cell nearest_cell(const Point& cells) {
  return {static_cast<int>(std::lround(cells.x())), static_cast<int>(std::lround(cells.y()))};
}

// Whether occupied cells that hang together reach over so many.
bool is_long(const OccupancyGrid& grid, Cell from, int cells) {
  constexpr int kGap = 2;
  const CellBox around = CellBox{from, from + Cell{1, 1}}.grown(cells);
  std::vector<char> seen(static_cast<std::size_t>(around.width()) * static_cast<std::size_t>(around.height()));
  const auto index = [&](Cell c) {
    return static_cast<std::size_t>(c.y - around.min.y) * static_cast<std::size_t>(around.width()) +
           static_cast<std::size_t>(c.x - around.min.x);
  };
  std::vector<Cell> open{from};
  seen[index(from)] = 1;
  CellBox extent{from, from + Cell{1, 1}};
  for (std::size_t next = 0; next < open.size(); ++next) {
    extent = united(extent, {open[next], open[next] + Cell{1, 1}});
    if (std::max(extent.width(), extent.height()) > cells) return true;
    for (int y = -kGap; y <= kGap; ++y)
      for (int x = -kGap; x <= kGap; ++x) {
        const Cell c = open[next] + Cell{x, y};
        if (!around.contains(c) || seen[index(c)] != 0 || grid.state(c) != CellState::occupied) continue;
        seen[index(c)] = 1;
        open.push_back(c);
      }
  }
  return false;
}

}  // namespace

HiddenParts::HiddenParts(std::span<const LandmarkTemplate> templates, int wall_cells)
    : templates_(templates), wall_cells_(wall_cells) {
  outlines_.reserve(templates.size());
  for (const LandmarkTemplate& shape : templates) outlines_.push_back(outline_of(shape));
}

HiddenParts::Outline HiddenParts::outline_of(const LandmarkTemplate& shape) {
  constexpr double kStep_rad = 2.0 * std::numbers::pi / kDirections;
  Outline outline;
  std::array<double, kDirections> outermost_cells{};
  outline.directions.reserve(shape.cells.size());
  for (const TemplateCell& cell : shape.cells) {
    const double turns = std::atan2(cell.offset.y, cell.offset.x) / kStep_rad;
    const int direction = (static_cast<int>(std::lround(turns)) + kDirections) % kDirections;
    outline.directions.push_back(direction);
    auto& farthest = outermost_cells[static_cast<std::size_t>(direction)];
    farthest = std::max(farthest, std::hypot(cell.offset.x, cell.offset.y));
  }
  for (std::size_t k = 0; k < kDirections; ++k) {
    outline.is_there[k] = outermost_cells[k] > 0.0;
    const double angle_rad = kStep_rad * static_cast<double>(k);
    for (int i = 0; i < kReach; ++i)
      outline.beyond[k][static_cast<std::size_t>(i)] =
          nearest_cell((outermost_cells[k] + kBeyond_cells + i) * unit_vector(angle_rad));
  }
  return outline;
}

// The longest one; empty when it hides nothing.
HiddenParts::Run HiddenParts::closed_run(const OccupancyGrid& grid, const Outline& outline, Cell at) {
  std::array<bool, kDirections> is_closed{};
  for (std::size_t k = 0; k < kDirections; ++k) {
    const auto closed = std::ranges::count_if(std::span(outline.beyond[k]).first(kLookedAt),
                                              [&](Cell beyond) { return grid.state(at + beyond) != CellState::free; });
    is_closed[k] = outline.is_there[k] && 2 * closed > kLookedAt;
  }
  Run longest;
  for (int first = 0; first < kDirections; ++first) {
    int count = 0;
    while (count < kDirections && is_closed[static_cast<std::size_t>((first + count) % kDirections)]) ++count;
    if (count > longest.count) longest = {first, count};
  }
  const auto all = static_cast<int>(std::ranges::count(is_closed, true));
  const bool hides =
      longest.count >= kMinClosed && longest.count <= kMaxClosed && all - longest.count <= kMaxOtherClosed;
  return hides ? longest : Run{};
}

bool HiddenParts::is_wall_behind(const OccupancyGrid& grid, const Outline& outline, const Run& run, Cell at) const {
  int hits = 0;
  for (int i = 0; i < run.count; ++i) {
    for (const Cell offset : outline.beyond[static_cast<std::size_t>((run.first + i) % kDirections)]) {
      const CellState state = grid.state(at + offset);
      if (state == CellState::free) break;
      if (state != CellState::occupied) continue;
      if (is_long(grid, at + offset, wall_cells_)) ++hits;
      break;
    }
  }
  return 3 * hits >= run.count;
}

LandmarkTemplate HiddenParts::seen_part(const OccupancyGrid& grid, std::size_t index, Cell at) const {
  const Outline& outline = outlines_[index];
  const Run run = closed_run(grid, outline, at);
  LandmarkTemplate seen = templates_[index];
  if (run.count == 0 || !is_wall_behind(grid, outline, run, at)) return seen;
  std::vector<TemplateCell> cells;
  cells.reserve(seen.cells.size());
  for (std::size_t i = 0; i < seen.cells.size(); ++i) {
    const int behind_first = (outline.directions[i] - run.first + 1 + kDirections) % kDirections;
    if (behind_first >= run.count + 2) cells.push_back(seen.cells[i]);
  }
  seen.cells = std::move(cells);
  return seen;
}

}  // namespace cairn::template_matcher
