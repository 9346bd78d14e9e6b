// Loading, naming, saving and drawing a map.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "framework/planning/landmark_names.hpp"
#include "maps/pictures/saved_map_picture.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

// path (N, 2 or 3) is drawn on top, with the names of the landmarks that it passes.
void draw(const Map& map, const std::filesystem::path& file, const std::string& title,
          const std::vector<std::array<double, 3>>& path, const std::vector<LandmarkId>& landmarks,
          double longer_side_px) {
  const py::gil_scoped_release others_run;
  const std::shared_ptr<SavedMap> saved = map.shared();
  MapPicture picture = picture_of(*saved);
  for (const auto& [x_m, y_m, heading_rad] : path) picture.planned.emplace_back(x_m, y_m);
  if (!path.empty()) {
    picture.start = picture.planned.front();
    picture.goal = picture.planned.back();
  }
  picture.planned_landmarks = landmarks;
  picture.title = title;
  picture.longer_side_px = longer_side_px;
  write_map_picture(file, picture);
}

}  // namespace

Map::Map(const std::filesystem::path& file) : file_(file), saved_(std::make_shared<SavedMap>(load_map(file))) {}

void Map::name(const std::string& what, const std::string& name) {
  auto changed = std::make_shared<SavedMap>(*saved_);  // planners and arrays in use keep the old one
  give_name(*changed, what, name);
  saved_ = std::move(changed);
}

void Map::save(const std::filesystem::path& file) {
  const std::shared_ptr<SavedMap> saved = saved_;
  const py::gil_scoped_release others_run;
  save_map(file, *saved);
}

void add_map(py::module_& module, py::class_<Map, std::shared_ptr<Map>>& map) {
  map.def_property_readonly("file", [](const Map& it) { return it.file().string(); })
      .def_property_readonly("properties", [](const Map& it) { return it.saved().properties; })
      .def("name", &Map::name, py::arg("what"), py::arg("name"))
      .def("save", &Map::save, py::arg("file"));
  module.def(
      "load",
      [](const std::filesystem::path& file) {
        const py::gil_scoped_release others_run;
        return std::make_shared<Map>(file);
      },
      py::arg("file"));
  module.def("draw", &draw, py::arg("map"), py::arg("file"), py::arg("title"), py::arg("path"), py::arg("landmarks"),
             py::arg("longer_side_px"));
}

}  // namespace cairn::python
