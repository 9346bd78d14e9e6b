// Errors of the libraries as exceptions: cairn.FileError has file, line and column, cairn.MapError a saved map's
// reason.
#include "framework/config/config_value.hpp"
#include "framework/modules/fence.hpp"
#include "maps/base/source_text.hpp"
#include "python/bindings/bindings.hpp"

namespace cairn::python {
namespace py = pybind11;
namespace {

// Of the package, whose exceptions they are.
py::object exception_class(const char* name) {
  return py::module_::import("cairn.errors").attr(name);
}

void raise(const char* name, const std::string& text) {
  PyErr_SetObject(exception_class(name).ptr(), py::str(text).ptr());
}

void raise(const ConfigError& error) {
  const SourcePlace& place = error.place();
  std::string text = error.what();
  for (const ConfigError& other : error.others()) text += std::string("\n") + other.what();
  const py::object type = exception_class("FileError");
  PyErr_SetObject(type.ptr(), type(text, place.file, place.line, place.column).ptr());
}

}  // namespace

void add_errors() {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const ConfigError& error) {
      raise(error);
    } catch (const StoreError& error) {
      raise("MapError", error.what());
    } catch (const ExchangeError& error) {
      raise("FileError", error.what());
    } catch (const ModuleFault& error) {
      raise("ModuleError", error.what());
    } catch (const py::builtin_exception&) {
      throw;  // pybind11's own
    } catch (const std::runtime_error& error) {
      raise("CairnError", error.what());
    }
  });
}

}  // namespace cairn::python
