#include "plugins/python_module/raised.hpp"

namespace cairn::python_module {
namespace py = pybind11;
namespace {

constexpr std::size_t kMaxTrace = 6000;  // bytes; what is longer loses its middle

py::object none_or(const py::object& object) {
  return object ? object : py::none();
}

// Python's texts may hold what UTF-8 cannot.
std::string utf8_of(const py::handle& text) {
  return py::bytes(py::str(text).attr("encode")("utf-8", "backslashreplace"));
}

std::string shortened(const std::string& text) {
  if (text.size() <= kMaxTrace) return text;
  const std::size_t first_end = text.rfind('\n', kMaxTrace / 3);
  const std::size_t last_begin = text.find('\n', text.size() - kMaxTrace * 2 / 3);
  if (first_end == std::string::npos || last_begin == std::string::npos) return text.substr(0, kMaxTrace);
  return text.substr(0, first_end) + "\n  ..." + text.substr(last_begin);
}

// The innermost call in that file; else the innermost one at all.
SourcePlace place_in(const py::object& trace, const std::string& file) {
  SourcePlace place;
  bool is_own = false;
  for (const py::handle frame : py::module_::import("traceback").attr("extract_tb")(trace)) {
    const std::string here = utf8_of(frame.attr("filename"));
    if (is_own && here != file) continue;
    is_own = here == file;
    const auto number = [&](const char* name) { return py::object(py::getattr(frame, name, py::none())); };
    place = {here, number("lineno").is_none() ? 0 : number("lineno").cast<int>(),
             number("colno").is_none() ? 0 : number("colno").cast<int>() + 1};
  }
  return place;
}

SourcePlace place_of(const py::object& value, const py::object& trace, const std::string& file) {
  if (py::isinstance(value, py::handle(PyExc_SyntaxError)) && !py::object(value.attr("lineno")).is_none()) {
    const py::object column = value.attr("offset");
    return {utf8_of(value.attr("filename")), value.attr("lineno").cast<int>(),
            column.is_none() ? 0 : column.cast<int>()};
  }
  return place_in(trace, file);
}

}  // namespace

std::string Raised::text() const {
  return (place.line > 0 ? place.text() + ": " : "") + sentence + "\n" + trace;
}

ConfigError Raised::as_error() const {
  return {place, sentence + "\n" + trace};
}

Raised raised_of(const py::error_already_set& error, const std::string& file) {
  Raised raised;
  try {
    const py::object type = none_or(error.type());
    const py::object value = none_or(error.value());
    const py::object trace = none_or(error.trace());
    const py::module_ traceback = py::module_::import("traceback");
    const py::list lines = traceback.attr("format_exception_only")(type, value);
    const py::str nothing("");
    raised.sentence = utf8_of(lines[lines.size() - 1].attr("strip")());
    raised.trace = shortened(
        utf8_of(nothing.attr("join")(traceback.attr("format_exception")(type, value, trace)).attr("rstrip")()));
    raised.place = place_of(value, trace, file);
  } catch (const std::exception&) {  // an exception whose own methods raise
    if (raised.sentence.empty()) raised.sentence = "something was raised that cannot be printed";
  }
  if (raised.place.file.empty()) raised.place.file = file;
  return raised;
}

}  // namespace cairn::python_module
