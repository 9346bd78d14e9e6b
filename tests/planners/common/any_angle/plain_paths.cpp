#include "tests/planners/common/any_angle/plain_paths.hpp"

#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

namespace cairn::test {
namespace {

struct Whole {  // in half cells
  std::int64_t x = 0;
  std::int64_t y = 0;
};

Whole whole(const Point& p) {
  return {std::llround(2.0 * p.x()), std::llround(2.0 * p.y())};
}

std::int64_t turn(Whole a, Whole b, Whole c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool enters_square(Whole a, Whole b, Whole low) {
  const Whole high{low.x + 2, low.y + 2};
  if (std::max(a.x, b.x) <= low.x || std::min(a.x, b.x) >= high.x) return false;
  if (std::max(a.y, b.y) <= low.y || std::min(a.y, b.y) >= high.y) return false;
  const std::int64_t sides[] = {turn(a, b, low), turn(a, b, {high.x, low.y}), turn(a, b, high),
                                turn(a, b, {low.x, high.y})};
  const auto [least, most] = std::minmax_element(std::begin(sides), std::end(sides));
  return *least < 0 && *most > 0;
}

// Along the line between two closed cells, or through the point where two meet.
bool slips(const OpenCells& cells, Whole a, Whole b) {
  const std::int64_t steps = std::gcd(b.x - a.x, b.y - a.y);
  for (std::int64_t i = 0; i <= steps; ++i) {
    const Whole p = steps == 0 ? a : Whole{a.x + (b.x - a.x) / steps * i, a.y + (b.y - a.y) / steps * i};
    const auto x = static_cast<int>(std::floor(static_cast<double>(p.x) / 2.0));
    const auto y = static_cast<int>(std::floor(static_cast<double>(p.y) / 2.0));
    const bool on_x = p.x % 2 == 0;
    const bool on_y = p.y % 2 == 0;
    if (on_x && on_y) {
      const bool low = cells.is_open(x - 1, y - 1);
      const bool right = cells.is_open(x, y - 1);
      const bool left = cells.is_open(x - 1, y);
      const bool high = cells.is_open(x, y);
      if ((low == high) && (left == right) && low != left) return true;
    } else if (on_x && a.x == b.x && !cells.is_open(x - 1, y) && !cells.is_open(x, y)) {
      return true;
    } else if (on_y && a.y == b.y && !cells.is_open(x, y - 1) && !cells.is_open(x, y)) {
      return true;
    }
  }
  return false;
}

std::vector<Point> corners_of(const OpenCells& cells) {
  std::vector<Point> corners;
  for (int y = cells.box.min.y; y <= cells.box.max.y; ++y)
    for (int x = cells.box.min.x; x <= cells.box.max.x; ++x) {
      const int open = int{cells.is_open(x - 1, y - 1)} + int{cells.is_open(x, y - 1)} + int{cells.is_open(x - 1, y)} +
                       int{cells.is_open(x, y)};
      if (open > 0 && open < 4) corners.emplace_back(x, y);  // more than needed, so as to leave nothing to reason about
    }
  return corners;
}

}  // namespace

OpenCells drawn_cells(const std::string& drawing, Cell corner) {
  std::vector<std::string> rows;
  std::istringstream lines(drawing);
  for (std::string row; std::getline(lines, row);)
    if (!row.empty()) rows.push_back(row);
  OpenCells cells;
  cells.box = {corner, {corner.x + static_cast<int>(rows.front().size()), corner.y + static_cast<int>(rows.size())}};
  for (auto row = rows.rbegin(); row != rows.rend(); ++row)
    for (const char c : *row) cells.open.push_back(c == '#' ? 0 : 1);
  return cells;
}

OpenCells random_cells(std::mt19937_64& random, int width, int height, double closed_ratio) {
  OpenCells cells;
  cells.box = {{0, 0}, {width, height}};
  std::bernoulli_distribution is_closed(closed_ratio);
  for (int i = 0; i < width * height; ++i) cells.open.push_back(is_closed(random) ? 0 : 1);
  return cells;
}

std::string drawing_of(const OpenCells& cells, const std::vector<Point>& path) {
  std::string text = "\n";
  for (int y = cells.box.max.y - 1; y >= cells.box.min.y; --y) {
    for (int x = cells.box.min.x; x < cells.box.max.x; ++x) text += cells.is_open(x, y) ? '.' : '#';
    text += '\n';
  }
  for (const Point& p : path) text += "(" + std::to_string(p.x()) + ", " + std::to_string(p.y()) + ") ";
  return text;
}

bool sees(const OpenCells& cells, const Point& a, const Point& b) {
  const Whole from = whole(a);
  const Whole to = whole(b);
  // What lies outside the box is closed, and reached through the box's rim only.
  for (int y = cells.box.min.y - 1; y <= cells.box.max.y; ++y)
    for (int x = cells.box.min.x - 1; x <= cells.box.max.x; ++x)
      if (!cells.is_open(x, y) && enters_square(from, to, {2 * x, 2 * y})) return false;
  return !slips(cells, from, to);
}

double plain_shortest_length(const OpenCells& cells, const Point& from, const Point& to) {
  std::vector<Point> vertices = corners_of(cells);
  vertices.push_back(to);
  std::vector<double> length(vertices.size(), std::numeric_limits<double>::infinity());
  std::vector<bool> done(vertices.size(), false);
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (sees(cells, from, vertices[i])) length[i] = (vertices[i] - from).norm();
  for (;;) {
    std::size_t next = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (!done[i] && (next == vertices.size() || length[i] < length[next])) next = i;
    if (next == vertices.size() || next + 1 == vertices.size() || std::isinf(length[next])) return length.back();
    done[next] = true;
    for (std::size_t i = 0; i < vertices.size(); ++i)
      if (!done[i] && length[next] + (vertices[i] - vertices[next]).norm() < length[i] &&
          sees(cells, vertices[next], vertices[i]))
        length[i] = length[next] + (vertices[i] - vertices[next]).norm();
  }
}

}  // namespace cairn::test
