// The open cells of a lattice as a mesh of rectangles, for shortest paths of a point (mesh_search.hpp).
//
// Lattice coordinates: cell (x, y) is the square [x, x + 1] x [y, y + 1]. Rectangles are joined where they
// share a stretch of border, never through a corner alone: a point does not slip between two closed cells
// that meet at a corner. Immutable and thread-safe. Building it costs O(cells).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "maps/geometry/pose.hpp"
#include "maps/grid/cell.hpp"

namespace cairn {

class CellMesh {
 public:
  using Index = std::int32_t;
  static constexpr Index kNone = -1;

  enum class Side : std::uint8_t { below, right, above, left };

  // A stretch of a rectangle's side that it shares with another, along x for `below` and `above`, else along y.
  struct Portal {
    Side side;
    int low = 0;
    int high = 0;
    Index to = kNone;     // rectangle
    Index block = kNone;  // see `blocks_between`
  };

  // open: row-major, one a cell of the box; not 0 is open. What lies outside the box is closed.
  CellMesh(const CellBox& box, std::span<const std::uint8_t> open);

  [[nodiscard]] const CellBox& box() const { return box_; }
  [[nodiscard]] Index rectangles() const { return static_cast<Index>(rectangles_.size()); }
  [[nodiscard]] const CellBox& rectangle(Index i) const { return rectangles_[static_cast<std::size_t>(i)]; }
  // kNone where the cell is closed.
  [[nodiscard]] Index rectangle_of(Cell cell) const {
    return box_.contains(cell) ? rectangle_of_[cell_index(cell)] : kNone;
  }
  [[nodiscard]] std::span<const Portal> portals(Index rectangle) const {
    const auto i = static_cast<std::size_t>(rectangle);
    return {portals_.data() + first_portal_[i], portals_.data() + first_portal_[i + 1]};
  }
  // Rectangles with the same number are connected; others are not.
  [[nodiscard]] Index part_of(Index rectangle) const { return part_of_[static_cast<std::size_t>(rectangle)]; }

  // The number of an outward corner of what is closed at this lattice point, round which a path may turn; else kNone.
  [[nodiscard]] Index corner_at(int x, int y) const;
  [[nodiscard]] Index corners() const { return corners_; }

  // A mark for each block (biconnected component of the rectangles' graph): 1 where a path between the two
  // rectangles that passes none twice may lead. Shortest paths are such, rectangles being convex.
  [[nodiscard]] std::vector<std::uint8_t> blocks_between(Index from, Index to) const;

 private:
  [[nodiscard]] std::size_t cell_index(Cell cell) const {
    return static_cast<std::size_t>(cell.y - box_.min.y) * static_cast<std::size_t>(box_.width()) +
           static_cast<std::size_t>(cell.x - box_.min.x);
  }
  void cut_into_rectangles(std::span<const std::uint8_t> open);
  void join();
  void join_along(Index rectangle, Side side);
  void find_blocks();
  void find_corners(std::span<const std::uint8_t> open);

  CellBox box_;
  std::vector<Index> rectangle_of_;
  std::vector<CellBox> rectangles_;
  std::vector<std::size_t> first_portal_;
  std::vector<Portal> portals_;
  std::vector<Index> part_of_;
  std::vector<Index> corner_at_;  // (width + 1) x (height + 1) lattice points
  Index corners_ = 0;
  // The tree of blocks and rectangles: a rectangle's parent is a block, a block's a rectangle.
  Index blocks_ = 0;
  std::vector<Index> block_above_;      // of a rectangle; kNone at a root
  std::vector<Index> rectangle_above_;  // of a block
  std::vector<Index> depth_;            // of a rectangle, counted in rectangles
};

}  // namespace cairn
