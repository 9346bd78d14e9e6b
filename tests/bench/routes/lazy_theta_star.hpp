// The plain searches that routes are held against: Lazy Theta* (A. Nash, S. Koenig, C. Tovey, Lazy Theta*: Any-angle
// path planning and path length analysis in 3D, AAAI 2010) and A* over eight neighbours.
//
// From cell centre to cell centre; a diagonal step needs both straight neighbours open. Lazy Theta* looks along
// straight lines exactly: they may touch a closed cell, not enter it, nor pass between two that meet at a corner.
#pragma once

#include <limits>
#include <vector>

#include "tests/bench/routes/plain_cells.hpp"

namespace cairn {

struct PlainPath {
  std::vector<Cell> cells;                                  // where it turns, ends included; empty: none
  double length = std::numeric_limits<double>::infinity();  // in cells
  std::int64_t expanded = 0;
};

[[nodiscard]] bool sees_along_line(const PlainCells& cells, Cell from, Cell to);

// Its space is used again from search to search, so that what is timed is the search.
class PlainSearches {
 public:
  explicit PlainSearches(const PlainCells& cells);

  [[nodiscard]] PlainPath lazy_theta_star(Cell from, Cell to);
  [[nodiscard]] PlainPath a_star(Cell from, Cell to);  // the eight-neighbour optimum

 private:
  struct Vertex {
    std::uint32_t search = 0;  // in which it was last met
    std::int32_t parent = 0;
    bool closed = false;
    double length = 0.0;
  };
  struct Candidate {
    double estimate;
    double length;
    std::int32_t vertex;
  };

  [[nodiscard]] static bool comes_after(const Candidate& a, const Candidate& b);
  [[nodiscard]] std::int32_t index(Cell cell) const { return static_cast<std::int32_t>(cells_.index(cell.x, cell.y)); }
  [[nodiscard]] Cell cell(std::int32_t vertex) const { return {vertex % cells_.width, vertex / cells_.width}; }
  [[nodiscard]] bool is_met(std::int32_t vertex) const {
    return vertices_[static_cast<std::size_t>(vertex)].search == search_;
  }
  Vertex& at(std::int32_t vertex) { return vertices_[static_cast<std::size_t>(vertex)]; }
  template <class Look>
  void each_neighbour(Cell cell, Look look) const;
  void begin(Cell from);
  void offer(std::int32_t vertex, std::int32_t parent, double length, double estimate);
  bool next(std::int32_t& vertex);
  void settle_sight(std::int32_t vertex);
  [[nodiscard]] PlainPath path_to(std::int32_t vertex, std::int64_t expanded);

  const PlainCells& cells_;
  std::vector<Vertex> vertices_;
  std::vector<Candidate> open_;  // a heap
  std::uint32_t search_ = 0;
};

}  // namespace cairn
