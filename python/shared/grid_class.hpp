// An occupancy grid as a class with arrays, which are copies: of a saved map, and of the grid that a module is shown.
#pragma once

#include <pybind11/numpy.h>

#include <algorithm>

#include "maps/grid/occupancy_grid.hpp"

namespace cairn::python {

template <class Value>
[[nodiscard]] pybind11::array_t<Value> array_for(const CellBox& box) {
  return pybind11::array_t<Value>({std::max(0, box.height()), std::max(0, box.width())});
}

[[nodiscard]] inline pybind11::array_t<LogOdds> log_odds_quanta(const OccupancyGrid& grid, const CellBox& box) {
  auto array = array_for<LogOdds>(box);
  grid.copy_log_odds(box, {array.mutable_data(), static_cast<std::size_t>(array.size())});
  return array;
}

[[nodiscard]] inline pybind11::array_t<std::uint8_t> ol_array(const OccupancyGrid& grid, const CellBox& box) {
  auto array = array_for<std::uint8_t>(box);
  grid.copy_ol(box, {array.mutable_data(), static_cast<std::size_t>(array.size())});
  return array;
}

// function: from LogOdds to a number.
template <class Function>
[[nodiscard]] pybind11::array_t<float> mapped_log_odds(const OccupancyGrid& grid, const CellBox& box,
                                                       Function function) {
  const auto quanta = log_odds_quanta(grid, box);
  auto array = array_for<float>(box);
  std::transform(quanta.data(), quanta.data() + quanta.size(), array.mutable_data(),
                 [&](LogOdds value) { return static_cast<float>(function(value)); });
  return array;
}

// Grid: has cells(), the OccupancyGrid, and box(), the part of it that the arrays show.
template <class Grid, class... Options>
void add_grid_members(pybind11::class_<Grid, Options...>& to) {
  namespace py = pybind11;
  to.def_property_readonly(
        "cell_m", [](const Grid& grid) { return grid.cells().cell_m(); }, "Side of a cell, m.")
      .def_property_readonly(
          "origin_m",
          [](const Grid& grid) {
            const CellBox box = grid.box();
            const Point corner = grid.cells().origin_m() + grid.cells().cell_m() * Point(box.min.x, box.min.y);
            return py::make_tuple(corner.x(), corner.y());
          },
          "(x m, y m) of the lower left corner of element [0, 0] in the map frame.")
      .def_property_readonly(
          "first_cell", [](const Grid& grid) { return py::make_tuple(grid.box().min.x, grid.box().min.y); },
          "(x, y): the lattice's index of element [0, 0]; tiles are named by such indices.")
      .def_property_readonly(
          "shape", [](const Grid& grid) { return py::make_tuple(grid.box().height(), grid.box().width()); },
          "(rows, columns) of the whole.")
      .def(
          "ol", [](const Grid& grid) { return ol_array(grid.cells(), grid.box()); },
          "(rows, columns) uint8: floor(255 P), 127 where nothing is known. A copy.")
      .def(
          "log_odds",
          [](const Grid& grid) {
            return mapped_log_odds(grid.cells(), grid.box(), [](LogOdds q) { return q / kLogOddsPerNat; });
          },
          "(rows, columns) float32, nat; above 0 is rather occupied. A copy.")
      .def(
          "probability",
          [](const Grid& grid) {
            return mapped_log_odds(grid.cells(), grid.box(), [](LogOdds q) { return probability_of(q); });
          },
          "(rows, columns) float32: of being occupied; 0.5 where nothing is known. A copy.");
}

}  // namespace cairn::python
