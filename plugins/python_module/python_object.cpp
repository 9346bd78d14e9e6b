#include "plugins/python_module/python_object.hpp"

#include <pybind11/functional.h>

#include <atomic>
#include <filesystem>

#include "plugins/python_module/class_check.hpp"
#include "plugins/python_module/import_trial.hpp"
#include "plugins/python_module/interpreter.hpp"
#include "plugins/python_module/values.hpp"
#include "plugins/python_module/views.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

// Unique in sys.modules: a second object of a file shares nothing with the first.
std::string new_module_name(const std::filesystem::path& file) {
  static std::atomic<int> count{0};
  return "cairn_module_" + std::to_string(++count) + "_" + file.stem().string();
}

// So that it can import its neighbours. Behind all others: a neighbour hides no package.
void add_folder(const std::filesystem::path& folder) {
  py::list path = py::module_::import("sys").attr("path");
  const py::str name(folder.string());
  if (!path.contains(name)) path.append(name);
}

py::module_ run_file(const std::string& file, const std::string& name) {
  const py::module_ machinery = py::module_::import("importlib.machinery");
  const py::module_ util = py::module_::import("importlib.util");
  const py::object loader = machinery.attr("SourceFileLoader")(name, file);
  py::object module = util.attr("module_from_spec")(util.attr("spec_from_loader")(name, loader));
  py::module_::import("sys").attr("modules")[py::str(name)] = module;  // where dataclasses look for it
  loader.attr("exec_module")(module);
  return module;
}

std::string file_of(const Config& config) {
  const std::filesystem::path file = config_detail::to_path(config.file, "file");
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw ConfigError(config.file.place, file.string() + (std::filesystem::exists(file, error) ? ": is not a plain file"
                                                                                               : ": no such file"));
  return std::filesystem::absolute(file).lexically_normal().string();
}

}  // namespace

PythonObject::PythonObject(const Config& config, const ModuleContext& context, const AddToContext& add_to_context,
                           std::initializer_list<const char*> methods)
    : file_(file_of(config)), module_name_(new_module_name(file_)), seed_(context.seed) {
  try_import(file_, config.file.place);
  start_interpreter();
  const py::gil_scoped_acquire lock;
  try {
    py::module_::import("numpy");
    add_classes();
    load(config, methods);
    py::dict of_this_kind = plain_context(config, context);
    add_to_context(of_this_kind);
    context_ = std::move(of_this_kind);
    settings_ = config.settings.kind == ConfigValue::Kind::map ? value_of(config.settings) : py::dict();
    object_ = made();
  } catch (const py::error_already_set& error) {
    const ConfigError as_error = raised_of(error, file_).as_error();
    release();
    throw ConfigError(as_error);
  } catch (...) {
    release();
    throw;
  }
}

PythonObject::~PythonObject() {
  const py::gil_scoped_acquire lock;
  release();
}

void PythonObject::release() {
  object_ = {};
  settings_ = {};
  context_ = {};
  class_ = {};
  PyObject* const modules = PyImport_GetModuleDict();
  if (modules != nullptr && PyDict_DelItemString(modules, module_name_.c_str()) != 0) PyErr_Clear();
}

void PythonObject::load(const Config& config, std::initializer_list<const char*> methods) {
  add_folder(std::filesystem::path(file_).parent_path());
  class_ = class_in(run_file(file_, module_name_), file_, config.class_name, methods);
  check_settings(class_, config);
}

py::dict PythonObject::plain_context(const Config& config, const ModuleContext& context) const {
  py::dict plain;
  plain["robot"] = namespace_of(context.robot);
  plain["seed"] = context.seed;
  plain["path"] = py::cpp_function(
      [like = config.file](const std::string& text) {
        ConfigValue value = like;
        value.scalar = text;
        return resolve_path(value).string();
      },
      py::arg("text"), py::doc("A path as the mission means it: from the folder of its file, with ${NAME}."));
  plain["exhausted"] = py::cpp_function([budget = budget_] { return *budget != nullptr && (*budget)->exhausted(); },
                                        py::doc("Whether the call under way should return, with what it has."));
  return plain;
}

py::object PythonObject::made() const {
  py::dict attributes = context_.attr("copy")();
  attributes["rng"] = py::module_::import("numpy.random").attr("default_rng")(seed_);
  return class_(namespace_of(attributes), **settings_);
}

void PythonObject::make_anew() {
  in_python(file_, [&] { object_ = made(); });
}

}  // namespace cairn::python_module
