// The native module `cairn._native`. Its Python side (python/cairn) is what users meet.
#include "framework/modules/trial/cached_trial.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {

const ModuleLibrary& module_library() {
  static const ModuleLibrary library(plugin_folders({}), remembered_child_trial(installed_prefix() / "bin" / "cairn"));
  return library;
}

}  // namespace cairn::python

PYBIND11_MODULE(_native, module) {
  using namespace cairn::python;
  module.doc() = "Cairn's libraries as Python sees them.";
  add_errors();
  add_grid(module);
  add_graph(module);
  pybind11::class_<Map, std::shared_ptr<Map>> map(module, "Map");
  add_map(module, map);
  add_logs(module);
  add_planning(module);
  add_run(module);
  module.attr("prefix") = cairn::installed_prefix().string();
}
