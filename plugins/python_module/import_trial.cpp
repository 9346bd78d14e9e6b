#include "plugins/python_module/import_trial.hpp"

#include <Python.h>

#include <chrono>
#include <filesystem>
#include <mutex>
#include <set>
#include <system_error>

#include "maps/base/child_process.hpp"
#include "maps/base/printable.hpp"
#include "plugins/python_module/interpreter.hpp"

namespace cairn::python_module {
namespace {

// As run_file() does it. It ends with its parent (prctl), and writes no core file. The answer goes to kReportFd;
// os._exit() leaves threads and atexit alone.
constexpr const char* kScript = R"(
import ctypes, importlib.machinery, importlib.util, os, resource, signal, sys
ctypes.CDLL(None).prctl(1, signal.SIGKILL)
resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
file = sys.argv[1]
sys.path[0:1] = []
sys.path.append(os.path.dirname(file))
loader = importlib.machinery.SourceFileLoader("cairn_module_tried", file)
module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
sys.modules[loader.name] = module
sys.dont_write_bytecode = True
try:
    loader.exec_module(module)
except BaseException:
    pass
os.write(3, b"returned")
os._exit(0)
)";
static_assert(kReportFd == 3);

constexpr std::chrono::seconds kUsualLimit(10);
constexpr std::size_t kMaxShown = 200;  // of what it printed

std::string fault_of(const std::string& file) {
  const std::chrono::milliseconds limit = limit_from("CAIRN_MODULE_TRIAL_S", kUsualLimit);
  try {
    const ChildEnd end = run_child({python_program(), "-X", "utf8", "-c", kScript, file}, limit);
    if (end.reported == "returned") return {};
    std::string fault = end_text(end, limit) + " while it was imported";
    if (!end.printed.empty()) fault += "; it printed \"" + printable_excerpt(end.printed, kMaxShown) + "\"";
    return fault;
  } catch (const std::system_error&) {
    return {};  // the program cannot be started: nothing is known of the file
  }
}

}  // namespace

void try_import(const std::string& file, const SourcePlace& place) {
  static const bool runs_in_python = Py_IsInitialized() != 0;  // before ours: that one has imported what it wanted
  static std::mutex mutex;
  static std::set<std::string> sound;  // files, with the time of their last change
  if (runs_in_python) return;
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(file, error).time_since_epoch().count();
  const std::string key = file + " " + std::to_string(changed);
  const std::lock_guard lock(mutex);
  if (sound.contains(key)) return;
  if (const std::string fault = fault_of(file); !fault.empty()) throw ConfigError(place, file + ": " + fault);
  sound.insert(key);
}

}  // namespace cairn::python_module
