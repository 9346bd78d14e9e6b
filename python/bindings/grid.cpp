// The grid of a saved map: tiles as views of its memory, the whole as copies.
#include <pybind11/stl.h>

#include <cmath>

#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"
#include "python/shared/grid_class.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

constexpr int kSide = OccupancyGrid::kTileSide;

// Of a map, which it keeps.
struct Grid {
  std::shared_ptr<const SavedMap> map;
  [[nodiscard]] const OccupancyGrid& cells() const { return map->grid; }
  [[nodiscard]] CellBox box() const { return map->grid.bounds(); }
};

int tile_of(int cell) {
  return static_cast<int>(std::floor(static_cast<double>(cell) / kSide));
}

// Read-only, and keeps the map.
py::object tile_view(const std::shared_ptr<const SavedMap>& map, Cell tile) {
  const LogOdds* const cells = map->grid.cells_of_tile(tile);
  if (cells == nullptr) return py::none();
  auto* const kept = new std::shared_ptr<const SavedMap>(map);
  const py::capsule keeper(kept, [](void* held) { delete static_cast<std::shared_ptr<const SavedMap>*>(held); });
  py::array_t<LogOdds> view({kSide, kSide}, cells, keeper);
  make_read_only(view);
  return view;
}

py::list tiles_of(const Grid& grid) {
  py::list tiles;
  const CellBox box = grid.box();
  if (box.empty()) return tiles;
  for (int y = tile_of(box.min.y); y <= tile_of(box.max.y - 1); ++y)
    for (int x = tile_of(box.min.x); x <= tile_of(box.max.x - 1); ++x)
      if (py::object view = tile_view(grid.map, {x, y}); !view.is_none())
        tiles.append(py::make_tuple(py::make_tuple(x * kSide, y * kSide), view));
  return tiles;
}

}  // namespace

void add_grid(py::module_& module) {
  py::class_<Grid> grid(
      module, "Grid",
      "The occupancy grid of a map. In arrays of it row 0 has the smallest y, column 0 the smallest x.");
  add_grid_members(grid);
  grid.def_property_readonly(
      "tiles", tiles_of,
      "Read-only views of the map's own memory, without a copy: [((x, y), (64, 64) int16), ...] "
      "with the lattice's index of each one's first cell and log-odds in 1/256 nat. Where nothing was ever "
      "written there is no tile.");
  module.def(
      "grid_of", [](const Map& map) { return Grid{map.shared()}; }, py::arg("map"));
}

}  // namespace cairn::python
