#include "planners/common/any_angle/cell_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/biconnected_components.hpp>
#include <stdexcept>

namespace cairn {
namespace {

using Index = CellMesh::Index;

constexpr CellMesh::Side kSides[] = {CellMesh::Side::below, CellMesh::Side::right, CellMesh::Side::above,
                                     CellMesh::Side::left};

struct EdgeBlock {
  Index block = 0;
};
using RectangleGraph =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property, EdgeBlock>;

// The largest of two rectangles of free cells that have their lower left cell here: first as wide as it
// goes, or first as high as it goes.
template <class IsFree>
CellBox rectangle_at(Cell at, const CellBox& box, const IsFree& is_free) {
  const auto row_is_free = [&](int y, int x_end) {
    for (int x = at.x; x < x_end; ++x)
      if (!is_free(Cell{x, y})) return false;
    return true;
  };
  const auto column_is_free = [&](int x, int y_end) {
    for (int y = at.y; y < y_end; ++y)
      if (!is_free(Cell{x, y})) return false;
    return true;
  };
  CellBox wide{at, {at.x + 1, at.y + 1}};
  while (wide.max.x < box.max.x && is_free(Cell{wide.max.x, at.y})) ++wide.max.x;
  while (wide.max.y < box.max.y && row_is_free(wide.max.y, wide.max.x)) ++wide.max.y;
  CellBox high{at, {at.x + 1, at.y + 1}};
  while (high.max.y < box.max.y && is_free(Cell{at.x, high.max.y})) ++high.max.y;
  while (high.max.x < box.max.x && column_is_free(high.max.x, high.max.y)) ++high.max.x;
  const auto area = [](const CellBox& r) { return std::int64_t{r.width()} * r.height(); };
  return area(high) > area(wide) ? high : wide;
}

}  // namespace

CellMesh::CellMesh(const CellBox& box, std::span<const std::uint8_t> open) : box_(box.empty() ? CellBox{} : box) {
  const auto cells = static_cast<std::size_t>(box_.width()) * static_cast<std::size_t>(box_.height());
  if (open.size() != cells)
    throw std::invalid_argument(fmt::format("CellMesh: {} marks for a box of {} cells", open.size(), cells));
  cut_into_rectangles(open);
  join();
  find_blocks();
  find_corners(open);
}

void CellMesh::cut_into_rectangles(std::span<const std::uint8_t> open) {
  rectangle_of_.assign(open.size(), kNone);
  const auto is_free = [&](Cell c) {
    const std::size_t i = cell_index(c);
    return open[i] != 0 && rectangle_of_[i] == kNone;
  };
  for (int y = box_.min.y; y < box_.max.y; ++y)
    for (int x = box_.min.x; x < box_.max.x; ++x) {
      if (!is_free({x, y})) continue;
      const CellBox found = rectangle_at({x, y}, box_, is_free);
      for (int row = found.min.y; row < found.max.y; ++row)
        std::fill_n(rectangle_of_.begin() + static_cast<std::ptrdiff_t>(cell_index({found.min.x, row})), found.width(),
                    rectangles());
      rectangles_.push_back(found);
    }
}

void CellMesh::join() {
  first_portal_.reserve(rectangles_.size() + 1);
  for (Index i = 0; i < rectangles(); ++i) {
    first_portal_.push_back(portals_.size());
    for (const Side side : kSides) join_along(i, side);
  }
  first_portal_.push_back(portals_.size());
}

void CellMesh::join_along(Index rectangle, Side side) {
  const CellBox& r = this->rectangle(rectangle);
  const bool along_x = side == Side::below || side == Side::above;
  const int begin = along_x ? r.min.x : r.min.y;
  const int end = along_x ? r.max.x : r.max.y;
  const auto neighbour = [&](int at) {
    switch (side) {
      case Side::below:
        return rectangle_of({at, r.min.y - 1});
      case Side::right:
        return rectangle_of({r.max.x, at});
      case Side::above:
        return rectangle_of({at, r.max.y});
      case Side::left:
        return rectangle_of({r.min.x - 1, at});
    }
    return kNone;
  };
  for (int at = begin; at < end;) {
    const Index to = neighbour(at);
    int next = at + 1;
    while (next < end && neighbour(next) == to) ++next;
    if (to != kNone) portals_.push_back({side, at, next, to, kNone});
    at = next;
  }
}

void CellMesh::find_blocks() {
  RectangleGraph graph(rectangles_.size());
  for (Index i = 0; i < rectangles(); ++i)
    for (const Portal& portal : portals(i))
      if (i < portal.to) boost::add_edge(static_cast<std::size_t>(i), static_cast<std::size_t>(portal.to), graph);
  blocks_ = static_cast<Index>(boost::biconnected_components(graph, boost::get(&EdgeBlock::block, graph)));

  part_of_.assign(rectangles_.size(), kNone);
  block_above_.assign(rectangles_.size(), kNone);
  rectangle_above_.assign(static_cast<std::size_t>(blocks_), kNone);
  depth_.assign(rectangles_.size(), 0);
  // Breadth first: a block is first entered through the one rectangle that all paths from the root lead through.
  std::vector<std::size_t> queue;
  Index parts = 0;
  for (std::size_t root = 0; root < rectangles_.size(); ++root) {
    if (part_of_[root] != kNone) continue;
    part_of_[root] = parts++;
    queue.assign(1, root);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const std::size_t at = queue[head];
      for (const auto edge : boost::make_iterator_range(boost::out_edges(at, graph))) {
        const std::size_t to = boost::target(edge, graph);
        const Index block = graph[edge].block;
        Index& above = rectangle_above_[static_cast<std::size_t>(block)];
        if (above == kNone) above = static_cast<Index>(at);
        if (part_of_[to] != kNone) continue;
        part_of_[to] = part_of_[root];
        block_above_[to] = block;
        depth_[to] = depth_[static_cast<std::size_t>(above)] + 1;
        queue.push_back(to);
      }
    }
  }
  // Two rectangles share one portal, and so an edge, at most: each rectangle's edges first, then its portals.
  std::vector<Index> block_to(rectangles_.size(), kNone);
  for (std::size_t i = 0; i < rectangles_.size(); ++i) {
    for (const auto edge : boost::make_iterator_range(boost::out_edges(i, graph)))
      block_to[boost::target(edge, graph)] = graph[edge].block;
    for (std::size_t p = first_portal_[i]; p < first_portal_[i + 1]; ++p)
      portals_[p].block = block_to[static_cast<std::size_t>(portals_[p].to)];
  }
}

void CellMesh::find_corners(std::span<const std::uint8_t> open) {
  const auto is_closed = [&](int x, int y) {
    const Cell cell{x, y};
    return !box_.contains(cell) || open[cell_index(cell)] == 0;
  };
  corner_at_.assign(static_cast<std::size_t>(box_.width() + 1) * static_cast<std::size_t>(box_.height() + 1), kNone);
  std::size_t at = 0;
  for (int y = box_.min.y; y <= box_.max.y; ++y)
    for (int x = box_.min.x; x <= box_.max.x; ++x, ++at) {
      const bool a = is_closed(x - 1, y - 1);
      const bool b = is_closed(x, y - 1);
      const bool c = is_closed(x - 1, y);
      const bool d = is_closed(x, y);
      const int closed = int{a} + int{b} + int{c} + int{d};
      if (closed == 1 || (closed == 2 && a == d)) corner_at_[at] = corners_++;
    }
}

CellMesh::Index CellMesh::corner_at(int x, int y) const {
  if (x < box_.min.x || y < box_.min.y || x > box_.max.x || y > box_.max.y) return kNone;
  return corner_at_[static_cast<std::size_t>(y - box_.min.y) * static_cast<std::size_t>(box_.width() + 1) +
                    static_cast<std::size_t>(x - box_.min.x)];
}

std::vector<std::uint8_t> CellMesh::blocks_between(Index from, Index to) const {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(blocks_), 0);
  if (part_of(from) != part_of(to)) return marks;
  while (from != to) {
    Index& deeper = depth_[static_cast<std::size_t>(from)] >= depth_[static_cast<std::size_t>(to)] ? from : to;
    const Index block = block_above_[static_cast<std::size_t>(deeper)];
    marks[static_cast<std::size_t>(block)] = 1;
    deeper = rectangle_above_[static_cast<std::size_t>(block)];
    // Siblings of one block meet in it: the path between them need not go through what is above.
    const Index& other = &deeper == &from ? to : from;
    if (other != deeper && block_above_[static_cast<std::size_t>(other)] == block) break;
  }
  return marks;
}

}  // namespace cairn
