#include "planners/hybrid/length_lower_bound.hpp"

#include <bit>
#include <cmath>
#include <numbers>

#include "planners/common/any_angle/mesh_search.hpp"

// Why it is a bound. Let the disc's centre p be somewhere in a cell with centre c, and b the centre of a blocked cell.
// p + (b - c) lies in the blocked square, so that square is no further from p than |b - c|, and the radius is no more
// than that. So the path stays on cells whose centres are as far as the radius from those of all blocked cells. It
// stays on the blocks that hold such a cell all the more, and where it goes from cell to cell over a side, it goes over
// a side from block to block or stays in one. The shortest path of a point over these blocks is no longer.

namespace cairn {
namespace {

using Word = std::uint64_t;

constexpr int kSide = OccupancyGrid::kTileSide;
static_assert(kSide == 64, "a row of a tile is a word");

// For rounding: of the radius, a hair more than DiscRoutes takes off it, and of the length.
constexpr double kSlack_m = 1e-6;
constexpr double kSlack_ratio = 1e-6;

constexpr int tile_of(int cell) {
  return cell >> std::countr_zero(static_cast<unsigned>(kSide));
}

// A bit a cell, over whole tiles.
struct CellBits {
  CellBox tiles;
  std::vector<Word> words;  // by row of cells, one a tile

  explicit CellBits(const CellBox& tiles_box)
      : tiles(tiles_box),
        words(static_cast<std::size_t>(tiles.width()) * static_cast<std::size_t>(tiles.height()) * kSide, 0) {}
  [[nodiscard]] int rows() const { return tiles.height() * kSide; }
  [[nodiscard]] Word* row(int y) {
    return words.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles.width());
  }
  [[nodiscard]] const Word* row(int y) const {
    return words.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles.width());
  }
};

CellBits blocked_cells(const OccupancyGrid& grid, const GroundRules& rules, const CellBox& cells) {
  CellBits blocked(
      {{tile_of(cells.min.x), tile_of(cells.min.y)}, {tile_of(cells.max.x - 1) + 1, tile_of(cells.max.y - 1) + 1}});
  // More than this blocks: what is not free, or what is occupied.
  const OccupancyThresholds& thresholds = rules.thresholds;
  const int max_free = rules.unknown == UnknownPolicy::avoid
                           ? std::min<int>(thresholds.occupied_above, thresholds.free_below - 1)
                           : thresholds.occupied_above;
  for (int ty = 0; ty < blocked.tiles.height(); ++ty)
    for (int tx = 0; tx < blocked.tiles.width(); ++tx) {
      const LogOdds* const values = grid.cells_of_tile(blocked.tiles.min + Cell{tx, ty});
      for (int y = 0; y < kSide; ++y) {
        Word word = 0;
        if (values == nullptr) {
          word = max_free < 0 ? ~Word{0} : Word{0};
        } else {
          for (int x = 0; x < kSide; ++x) word |= Word{values[y * kSide + x] > max_free} << x;
        }
        blocked.row(ty * kSide + y)[tx] = word;
      }
    }
  return blocked;
}

// By a cell to both sides.
void widen(std::vector<Word>& row) {
  Word before = 0;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const Word here = row[i];
    const Word after = i + 1 < row.size() ? row[i + 1] : 0;
    row[i] = here | here << 1 | here >> 1 | before >> (kSide - 1) | after << (kSide - 1);
    before = here;
  }
}

// The cells whose centres are nearer than that to the centre of a blocked one, and the blocked ones.
CellBits near_blocked(const CellBits& blocked, double radius_cells) {
  CellBits near(blocked.tiles);
  std::vector<Word> wide;
  const auto is_near = [&](int dx, int dy) { return std::hypot(dx, dy) < radius_cells; };
  int highest = 0;
  while (is_near(0, highest + 1)) ++highest;
  for (int y = 0; y < blocked.rows(); ++y) {
    wide.assign(blocked.row(y), blocked.row(y) + blocked.tiles.width());
    if (std::all_of(wide.begin(), wide.end(), [](Word word) { return word == 0; })) continue;
    for (int dy = highest, dx = 0; dy >= 0; --dy) {
      for (; is_near(dx + 1, dy); ++dx) widen(wide);
      for (const int v : {y - dy, y + dy})
        if (v >= 0 && v < near.rows())
          for (std::size_t i = 0; i < wide.size(); ++i) near.row(v)[i] |= wide[i];
    }
  }
  return near;
}

// The largest with which what is blocked closes its whole block, so that walls stay closed.
int cells_across(double radius_cells) {
  int cells = 1;
  while (2 * cells <= kSide && (2 * cells - 1) * std::numbers::sqrt2 < radius_cells) cells *= 2;
  return cells;
}

// Blocks of so many cells a side over the box, open where one of their cells is.
CellMesh mesh_of_blocks(const CellBits& closed, const CellBox& cells, int across) {
  const auto block_of = [across](int cell) { return cell >> std::countr_zero(static_cast<unsigned>(across)); };
  const CellBox blocks{{block_of(cells.min.x), block_of(cells.min.y)},
                       {block_of(cells.max.x - 1) + 1, block_of(cells.max.y - 1) + 1}};
  const Word ones = ~Word{0} >> (kSide - across);
  const Cell first{closed.tiles.min.x * kSide, closed.tiles.min.y * kSide};
  std::vector<Word> free(static_cast<std::size_t>(closed.tiles.width()));
  std::vector<std::uint8_t> open;
  open.reserve(static_cast<std::size_t>(blocks.width()) * static_cast<std::size_t>(blocks.height()));
  for (int y = blocks.min.y; y < blocks.max.y; ++y) {
    std::fill(free.begin(), free.end(), 0);
    for (int v = y * across; v < (y + 1) * across; ++v)
      for (std::size_t i = 0; i < free.size(); ++i) free[i] |= ~closed.row(v - first.y)[i];
    for (int x = blocks.min.x; x < blocks.max.x; ++x) {
      const int at = x * across - first.x;
      open.push_back((free[static_cast<std::size_t>(at / kSide)] >> (at % kSide) & ones) != 0 ? 1 : 0);
    }
  }
  return {blocks, open};
}

}  // namespace

double length_lower_bound_m(const OccupancyGrid& grid, const GroundRules& rules, double radius_m, const Point& from,
                            const Point& to, const Budget& budget) {
  if (budget.exhausted()) return 0.0;
  const double radius_cells = (1.0 - kSlack_ratio) * (radius_m - kSlack_m) / grid.cell_m();
  const int across = cells_across(radius_cells);
  const CellBox cells = grid.bounds().grown(1);  // no centre of a disc leaves them, as in a DiscSpace
  const CellMesh mesh = mesh_of_blocks(near_blocked(blocked_cells(grid, rules, cells), radius_cells), cells, across);
  const double block_m = across * grid.cell_m();
  const auto in_blocks = [&](const Point& p_map) { return Point((p_map - grid.origin_m()) / block_m); };
  const MeshPath path = shortest_path(mesh, in_blocks(from), in_blocks(to), [&] { return budget.exhausted(); });
  if (path.interrupted) return 0.0;
  if (path.points.empty()) return std::numeric_limits<double>::infinity();
  return (1.0 - kSlack_ratio) * path.length * block_m;
}

}  // namespace cairn
