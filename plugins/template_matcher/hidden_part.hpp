// The part of an outline that cannot be seen, because another thing stands close behind it: a wall, a shelf
// (docs/method.md 7.5).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "maps/grid/occupancy_grid.hpp"
#include "plugins/template_matcher/match.hpp"

namespace cairn::template_matcher {

// Looks beyond an outline, in 24 directions from its centre. One that the map does not show free close behind the
// outline is closed; closed ones side by side hide their part of the outline, and the next direction to either side.
// Few of them hide nothing, being chance, nor do many: what is left would fit everywhere.
class HiddenParts {
 public:
  // Something is a wall when it is longer than this many cells.
  HiddenParts(std::span<const LandmarkTemplate> templates, int wall_cells);

  // The template without its cells that are hidden at this place; all of them where none is.
  [[nodiscard]] LandmarkTemplate seen_part(const OccupancyGrid& grid, std::size_t index, Cell at) const;

 private:
  static constexpr int kDirections = 24;
  static constexpr int kLookedAt = 4;
  static constexpr int kReach = 12;
  struct Outline {
    std::array<std::array<Cell, kReach>, kDirections> beyond;
    std::array<bool, kDirections> is_there{};  // not so for outlines with a gap
    std::vector<int> directions;               // of its cells
  };
  struct Run {
    int first = 0;
    int count = 0;
  };
  [[nodiscard]] static Outline outline_of(const LandmarkTemplate& shape);
  [[nodiscard]] bool is_wall_behind(const OccupancyGrid& grid, const Outline& outline, const Run& run, Cell at) const;
  [[nodiscard]] static Run closed_run(const OccupancyGrid& grid, const Outline& outline, Cell at);

  std::span<const LandmarkTemplate> templates_;
  int wall_cells_;
  std::vector<Outline> outlines_;
};

}  // namespace cairn::template_matcher
