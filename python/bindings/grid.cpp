// OccupancyGrid as arrays: tiles as views of its memory, the whole as copies.
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "python/bindings/arrays.hpp"
#include "python/bindings/bindings.hpp"

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

template <class Value>
py::array_t<Value> array_for(const CellBox& box) {
  return py::array_t<Value>({std::max(0, box.height()), std::max(0, box.width())});
}

py::array_t<LogOdds> log_odds_quanta(const Grid& grid) {
  auto array = array_for<LogOdds>(grid.box());
  grid.cells().copy_log_odds(grid.box(), {array.mutable_data(), static_cast<std::size_t>(array.size())});
  return array;
}

py::array_t<std::uint8_t> ol_array(const Grid& grid) {
  auto array = array_for<std::uint8_t>(grid.box());
  grid.cells().copy_ol(grid.box(), {array.mutable_data(), static_cast<std::size_t>(array.size())});
  return array;
}

template <class Function>
py::array_t<float> mapped(const Grid& grid, Function function) {
  const auto quanta = log_odds_quanta(grid);
  auto array = array_for<float>(grid.box());
  std::transform(quanta.data(), quanta.data() + quanta.size(), array.mutable_data(),
                 [&](LogOdds value) { return static_cast<float>(function(value)); });
  return array;
}

Point corner_of(const Grid& grid) {
  const CellBox box = grid.box();
  return grid.cells().origin_m() + grid.cells().cell_m() * Point(box.min.x, box.min.y);
}

}  // namespace

void add_grid(py::module_& module) {
  py::class_<Grid>(module, "Grid",
                   "The occupancy grid of a map. In arrays of it row 0 has the smallest y, column 0 the smallest x.")
      .def_property_readonly(
          "cell_m", [](const Grid& grid) { return grid.cells().cell_m(); }, "Side of a cell, m.")
      .def_property_readonly(
          "origin_m",
          [](const Grid& grid) {
            const Point corner = corner_of(grid);
            return py::make_tuple(corner.x(), corner.y());
          },
          "(x m, y m) of the lower left corner of element [0, 0] in the map frame.")
      .def_property_readonly(
          "first_cell", [](const Grid& grid) { return py::make_tuple(grid.box().min.x, grid.box().min.y); },
          "(x, y): the lattice's index of element [0, 0]; tiles are named by such indices.")
      .def_property_readonly(
          "shape", [](const Grid& grid) { return py::make_tuple(grid.box().height(), grid.box().width()); },
          "(rows, columns) of the whole.")
      .def_property_readonly(
          "tiles", tiles_of,
          "Read-only views of the map's own memory, without a copy: [((x, y), (64, 64) int16), ...] "
          "with the lattice's index of each one's first cell and log-odds in 1/256 nat. Where nothing was ever "
          "written there is no tile.")
      .def("ol", ol_array, "(rows, columns) uint8: floor(255 P), 127 where nothing is known. A copy.")
      .def(
          "log_odds", [](const Grid& grid) { return mapped(grid, [](LogOdds q) { return q / kLogOddsPerNat; }); },
          "(rows, columns) float32, nat; above 0 is rather occupied. A copy.")
      .def(
          "probability", [](const Grid& grid) { return mapped(grid, [](LogOdds q) { return probability_of(q); }); },
          "(rows, columns) float32: of being occupied; 0.5 where nothing is known. A copy.");
  module.def(
      "grid_of", [](const Map& map) { return Grid{map.shared()}; }, py::arg("map"));
}

}  // namespace cairn::python
