#include "plugins/python_module/class_check.hpp"

#include <algorithm>
#include <vector>

#include "maps/base/spelling.hpp"
#include "maps/base/text.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

bool is_class(const py::handle& object) {
  return py::isinstance(object, py::handle(reinterpret_cast<PyObject*>(&PyType_Type)));
}

// Those that the file itself defines.
std::vector<std::string> classes_of(const py::module_& module) {
  std::vector<std::string> names;
  for (const auto& [key, value] : py::dict(module.attr("__dict__")))
    if (is_class(value) && value.attr("__module__").equal(module.attr("__name__"))) names.push_back(py::str(key));
  return names;
}

struct Parameters {
  std::vector<std::string> names;     // behind the context
  std::vector<std::string> required;  // of these
  bool takes_any = false;             // **settings
};

// Of a class that Python knows no parameters of, anything goes.
Parameters parameters_of(const py::object& type) {
  Parameters found;
  const py::module_ inspect = py::module_::import("inspect");
  try {
    const py::object kinds = inspect.attr("Parameter");
    bool is_context = true;
    for (const py::handle parameter : py::object(inspect.attr("signature")(type).attr("parameters").attr("values")())) {
      const py::object kind = parameter.attr("kind");
      if (kind.is(kinds.attr("VAR_KEYWORD"))) found.takes_any = true;
      if (std::exchange(is_context, false) || kind.is(kinds.attr("VAR_KEYWORD")) ||
          kind.is(kinds.attr("VAR_POSITIONAL")) || kind.is(kinds.attr("POSITIONAL_ONLY")))
        continue;
      found.names.push_back(py::str(parameter.attr("name")));
      if (parameter.attr("default").is(kinds.attr("empty"))) found.required.push_back(found.names.back());
    }
  } catch (const py::error_already_set&) {
    found = {{}, {}, true};
  }
  return found;
}

}  // namespace

py::object class_in(const py::module_& module, const std::string& file, const ConfigValue& class_name,
                    std::initializer_list<const char*> methods) {
  const std::string name = config_detail::to_text(class_name, "class");
  const auto known = [&] {
    const std::vector<std::string> names = classes_of(module);
    return did_you_mean(name, names) + "; it has " + (names.empty() ? "none" : joined(names));
  };
  if (!py::hasattr(module, name.c_str()))
    throw ConfigError(class_name.place, file + " has no class " + in_quotes(name) + known());
  py::object type = module.attr(name.c_str());
  if (!is_class(type)) throw ConfigError(class_name.place, in_quotes(name) + " of " + file + " is no class" + known());
  const auto lacking = std::find_if(methods.begin(), methods.end(), [&](const char* method) {
    return !py::hasattr(type, method) || PyCallable_Check(py::object(type.attr(method)).ptr()) == 0;
  });
  if (lacking != methods.end())
    throw ConfigError(class_name.place,
                      "the class " + name + " of " + file + " lacks the method " + *lacking + "() (docs/python.md)");
  return type;
}

void check_settings(const py::object& type, const Config& config) {
  const ConfigValue& settings = config.settings;
  if (settings.kind != ConfigValue::Kind::map && settings.kind != ConfigValue::Kind::null)
    throw ConfigError(settings.place, "settings must be a map, found " + settings.kind_name());
  const Parameters parameters = parameters_of(type);
  const std::string of_class = " of the class " + config.class_name.scalar;
  for (const ConfigValue::Entry& entry : settings.entries) {
    const auto& names = parameters.names;
    if (parameters.takes_any || std::find(names.begin(), names.end(), entry.key) != names.end()) continue;
    throw ConfigError(entry.key_place, "unknown setting " + in_quotes(entry.key) + of_class +
                                           did_you_mean(entry.key, names) +
                                           (names.empty() ? "; it takes none" : "; known: " + joined(names)));
  }
  for (const std::string& name : parameters.required)
    if (settings.find(name) == nullptr)
      throw ConfigError(settings.place.file.empty() ? config.class_name.place : settings.place,
                        "settings lack " + in_quotes(name) + ", a parameter" + of_class);
}

}  // namespace cairn::python_module
