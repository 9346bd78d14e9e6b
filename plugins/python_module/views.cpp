#include "plugins/python_module/views.hpp"

#include <pybind11/eigen.h>

#include <algorithm>

#include "plugins/python_module/requests.hpp"
#include "plugins/python_module/values.hpp"
#include "python/shared/graph_classes.hpp"
#include "python/shared/grid_class.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

using python::tuple_of;
using Range2 = std::pair<int, int>;

// Rows and columns of the arrays, cut to what there is.
GridView part_of(const GridView& grid, const Range2& rows, const Range2& columns) {
  const Cell first = grid.shown.min;
  const auto lattice = [](int begin, int at, int size) { return begin + std::clamp(at, 0, size); };
  const CellBox box{
      {lattice(first.x, columns.first, grid.shown.width()), lattice(first.y, rows.first, grid.shown.height())},
      {lattice(first.x, columns.second, grid.shown.width()), lattice(first.y, rows.second, grid.shown.height())}};
  return {grid.grid, box.empty() ? CellBox{box.min, box.min} : box};
}

void add_grid(const py::module_& module) {
  py::class_<GridView> grid(module, "Grid",
                            "The map so far. In arrays of it row 0 has the smallest y, column 0 the smallest x.",
                            py::module_local());
  python::add_grid_members(grid);
  grid.def("part", part_of, py::arg("rows"), py::arg("columns"),
           "The part between these rows and columns, (begin, end) each, as a Grid; cut to what there is.")
      .def(
          "cell_of",
          [](const GridView& it, double x_m, double y_m) {
            const Cell cell = it.cells().cell_at({x_m, y_m}) - it.shown.min;
            return py::make_tuple(cell.y, cell.x);
          },
          py::arg("x_m"), py::arg("y_m"), "(row, column) of a point of the map; it may be outside of the arrays.")
      .def(
          "centre_of",
          [](const GridView& it, int row, int column) {
            const Point at = it.cells().centre_of(it.shown.min + Cell{column, row});
            return py::make_tuple(at.x(), at.y());
          },
          py::arg("row"), py::arg("column"), "(x m, y m) of the middle of a cell.");
}

py::array_t<bool> mask_of(const ChangesView& changes) {
  auto mask = python::array_for<bool>(changes.shown);
  std::fill_n(mask.mutable_data(), mask.size(), false);
  const auto width = static_cast<std::size_t>(std::max(0, changes.shown.width()));
  for (const CellSpan& span : changes.spans) {
    bool* const row = mask.mutable_data() + static_cast<std::size_t>(span.y - changes.shown.min.y) * width;
    std::fill(row + (span.x_begin - changes.shown.min.x), row + (span.x_end - changes.shown.min.x), true);
  }
  return mask;
}

py::tuple box_of(const ChangesView& changes) {
  CellBox box;
  for (const CellSpan& span : changes.spans) box = united(box, {{span.x_begin, span.y}, {span.x_end, span.y + 1}});
  const Cell first = changes.shown.min;
  return py::make_tuple(py::make_tuple(box.min.y - first.y, box.max.y - first.y),
                        py::make_tuple(box.min.x - first.x, box.max.x - first.x));
}

void add_changes(const py::module_& module) {
  py::class_<ChangesView>(module, "Changes", "Cells that may have changed since the last call, one at least.",
                          py::module_local())
      .def_property_readonly("box", box_of, "((first row, end row), (first column, end column)) that holds them all.")
      .def("mask", mask_of, "(rows, columns) bool: true where a cell may have changed.");
}

py::object pose_of(const WorldProxy& it) {
  return tuple_of(it.world.get().pose.T_map_robot);
}

py::object moved_place(const WorldProxy& it, const std::vector<double>& place) {
  if (place.size() != 2 && place.size() != 3) throw py::value_error("moved: a place is (x, y) or (x, y, heading)");
  const MapMove* const move = it.world.get().last_map_move;
  if (move == nullptr) return py::none();
  const Pose2 before{place[0], place[1], place.size() == 3 ? place[2] : 0.0};
  const Pose2 now = move->near(before.position()) * before;
  if (place.size() == 3) return tuple_of(now);
  return py::make_tuple(now.x_m, now.y_m);
}

void add_world(const py::module_& module) {
  py::class_<WorldProxy>(module, "World", "What is known at this tick.", py::module_local())
      .def_property_readonly("pose", pose_of, "As estimated: (x m, y m, heading rad) in the map.")
      .def_property_readonly(
          "covariance", [](const WorldProxy& it) { return Eigen::Matrix3d(it.world.get().pose.covariance); },
          "(3, 3) of the pose.")
      .def_property_readonly(
          "is_lost", [](const WorldProxy& it) { return it.world.get().pose.trust == PoseTrust::lost; },
          "The pose has to do with no map yet.")
      .def_property_readonly(
          "time_s", [](const WorldProxy& it) { return it.world.get().time_s; }, "By the mission's clock.")
      .def_property_readonly(
          "start", [](const WorldProxy& it) { return tuple_of(it.world.get().T_map_start); },
          "Where the mission began: (x m, y m, heading rad).")
      .def_property_readonly(
          "speed_reduction_ratio", [](const WorldProxy& it) { return it.world.get().speed_reduction_ratio; },
          "Share of the last wanted speed that the collision monitor has cut: 0 none, 1 all.")
      .def_property_readonly(
          "map_moves", [](const WorldProxy& it) { return it.world.get().map_moves; },
          "How often the map was exchanged for another that has places elsewhere.")
      .def("moved", moved_place, py::arg("place"),
           "Where a place (x, y) or (x, y, heading) of the map before the last exchange lies now; None: nowhere.")
      .def_property_readonly(
          "observation",
          [](const WorldProxy& it) -> py::object {
            const Observation* const seen = it.world.get().observation;
            return seen == nullptr ? py::object(py::none()) : namespace_of(*seen);
          },
          "The latest; None where there is none.")
      .def_property_readonly("grid", [](const WorldProxy& it) { return whole_of(it.world.with(it.world.get().grid)); })
      .def_property_readonly("landmarks",
                             [](const WorldProxy& it) { return python::values_of(it.world.get().graph.landmarks()); })
      .def_property_readonly("routes",
                             [](const WorldProxy& it) { return python::values_of(it.world.get().graph.routes()); });
}

}  // namespace

GridView whole_of(const Lent<const OccupancyGrid>& grid) {
  return {grid, grid.get().bounds()};
}

void add_classes() {
  static bool is_done = false;  // under the interpreter's lock
  if (std::exchange(is_done, true)) return;
  static PyModuleDef definition;
  // For the classes' names; never freed, and nobody imports it.
  const py::module_ module = py::module_::create_extension_module("cairn_module", nullptr, &definition);
  static_cast<void>(py::module_(module).release());
  add_grid(module);
  add_changes(module);
  python::add_landmark(module, py::module_local());
  python::add_route(module, py::module_local());
  add_world(module);
  add_requests(module);
}

}  // namespace cairn::python_module
