// What Python has raised, for people: in one line with its place, and with its trace.
#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

#include "framework/config/config_value.hpp"

namespace cairn::python_module {

struct Raised {
  SourcePlace place;     // in the module's own file, where it comes from there; no line: nowhere in Python
  std::string sentence;  // "ZeroDivisionError: division by zero"
  std::string trace;     // as Python prints it

  // Place, sentence and trace.
  [[nodiscard]] std::string text() const;
  // Of a mission that cannot begin: sentence and trace at their place.
  [[nodiscard]] ConfigError as_error() const;
};

// file: the module's own. With the interpreter's lock.
[[nodiscard]] Raised raised_of(const pybind11::error_already_set& error, const std::string& file);

// Calls something of Python, with the interpreter's lock; what it raises, SystemExit and KeyboardInterrupt too, becomes
// a std::runtime_error with Raised::text(). The result may hold nothing of Python.
template <class Call>
auto in_python(const std::string& file, Call&& call) -> decltype(call()) {
  const pybind11::gil_scoped_acquire lock;
  try {
    return call();
  } catch (const pybind11::error_already_set& error) {
    throw std::runtime_error(raised_of(error, file).text());
  }
}

}  // namespace cairn::python_module
