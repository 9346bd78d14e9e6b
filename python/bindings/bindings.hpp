// What the parts of the native module share.
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "framework/modules/module_library.hpp"
#include "maps/store/map_store.hpp"

namespace cairn::python {

// A saved map in memory. Planners share it; whoever changes it drops those that were made of it.
class Map {
 public:
  explicit Map(const std::filesystem::path& file);

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  [[nodiscard]] const SavedMap& saved() const { return *saved_; }
  [[nodiscard]] const std::shared_ptr<SavedMap>& shared() const { return saved_; }
  // Gives a landmark or cluster that name; empty: takes its name away. Planners in use keep the old one.
  void name(const std::string& what, const std::string& name);
  void save(const std::filesystem::path& file);

 private:
  std::filesystem::path file_;
  std::shared_ptr<SavedMap> saved_;
};

// Of the modules beside the package, and of CAIRN_PLUGIN_PATH; made once. Keep the interpreter's lock released.
[[nodiscard]] const ModuleLibrary& module_library();

void add_errors();
void add_grid(pybind11::module_& module);
void add_graph(pybind11::module_& module);
void add_map(pybind11::module_& module, pybind11::class_<Map, std::shared_ptr<Map>>& map);
void add_logs(pybind11::module_& module);
void add_planning(pybind11::module_& module);
void add_run(pybind11::module_& module);

}  // namespace cairn::python
