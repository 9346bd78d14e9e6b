#include "plugins/python_module/interpreter.hpp"

#include <dlfcn.h>
#include <pybind11/eval.h>
#include <pybind11/pybind11.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <string>

namespace cairn::python_module {
namespace {

// Modules are opened with local symbols, and so is the libpython that this one brings along. Extension modules of
// Python (numpy) are linked to none: they expect its symbols to be global.
void make_python_symbols_global() {
  Dl_info found{};
  if (::dladdr(reinterpret_cast<const void*>(&Py_IsInitialized), &found) == 0 || found.dli_fname == nullptr) return;
  static_cast<void>(::dlopen(found.dli_fname, RTLD_LAZY | RTLD_NOLOAD | RTLD_GLOBAL));  // stays open
}

void check(const PyStatus& status) {
  if (PyStatus_Exception(status) != 0)
    throw std::runtime_error(std::string("Python cannot be started: ") +
                             (status.err_msg != nullptr ? status.err_msg : "it gives no reason"));
}

void preinitialize() {
  PyPreConfig config;
  PyPreConfig_InitPythonConfig(&config);
  config.parse_argv = 0;
  config.configure_locale = 0;  // the program's stays as it is
  config.coerce_c_locale = 0;
  config.coerce_c_locale_warn = 0;
  config.utf8_mode = 1;
  check(Py_PreInitialize(&config));
}

class Configuration {
 public:
  Configuration() {
    PyConfig_InitPythonConfig(&config_);
    config_.parse_argv = 0;
    config_.install_signal_handlers = 0;
    config_.use_hash_seed = 1;
    config_.hash_seed = 0;
    config_.write_bytecode = 0;
    config_.configure_c_stdio = 0;
  }
  Configuration(const Configuration&) = delete;
  Configuration& operator=(const Configuration&) = delete;
  ~Configuration() { PyConfig_Clear(&config_); }

  void start() {
    check(PyConfig_SetBytesString(&config_, &config_.program_name, python_program().c_str()));
    check(Py_InitializeFromConfig(&config_));
  }

 private:
  PyConfig config_{};
};

// The standard output is the program's: reports and JSON. Its standard error goes through a filter, which Python would
// write past.
void print_by_program() {
  pybind11::dict names;
  names["show"] = pybind11::cpp_function([](const pybind11::bytes& bytes) {
    const std::string text = bytes;
    const pybind11::gil_scoped_release others_run;
    std::cerr << text << std::flush;
  });
  pybind11::exec(R"(
import io, sys
class StandardError(io.BufferedIOBase):
    def __init__(self, show): self.show = show
    def writable(self): return True
    def fileno(self): return 2
    def write(self, data):
        self.show(bytes(data))
        return len(data)
sys.stdout = sys.stderr = io.TextIOWrapper(StandardError(show), "utf-8", "backslashreplace", write_through=True)
)",
                 names);
}

}  // namespace

std::string python_program() {
  const std::string version = "python" + std::to_string(PY_MAJOR_VERSION) + "." + std::to_string(PY_MINOR_VERSION);
  if (const char* environment = std::getenv("VIRTUAL_ENV")) {
    const std::filesystem::path folder = environment;
    std::error_code error;
    if (std::filesystem::is_directory(folder / "lib" / version, error)) return (folder / "bin" / "python3").string();
  }
  return CAIRN_PYTHON;
}

void start_interpreter() {
  static std::once_flag once;
  std::call_once(once, [] {
    make_python_symbols_global();
    if (Py_IsInitialized() != 0) return;
    preinitialize();
    Configuration().start();
    print_by_program();
    pybind11::detail::get_internals();  // by a thread whose state lasts
    static_cast<void>(PyEval_SaveThread());
  });
}

}  // namespace cairn::python_module
