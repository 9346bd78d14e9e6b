#include "plugins/python_module/import_trial.hpp"

#include <chrono>
#include <filesystem>
#include <map>
#include <mutex>
#include <system_error>

#include "framework/modules/trial/child_process.hpp"
#include "framework/modules/trial/child_trial.hpp"
#include "plugins/python_module/interpreter.hpp"

namespace cairn::python_module {
namespace {

// As run_file() does it. The answer goes to kReportFd; os._exit() leaves threads and atexit alone.
constexpr const char* kScript = R"(
import importlib.machinery, importlib.util, os, sys
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

std::string fault_of(const std::string& file) {
  constexpr std::chrono::seconds kLongest(10);
  const std::chrono::milliseconds limit = trial_limit(kLongest);
  try {
    const ChildEnd end = run_child({python_program(), "-X", "utf8", "-c", kScript, file}, limit);
    return end.reported == "returned" ? "" : end_text(end, limit) + " while it was imported";
  } catch (const std::system_error&) {
    return {};  // the interpreter of this process may be another one
  }
}

}  // namespace

void try_import(const std::string& file, const SourcePlace& place) {
  static std::mutex mutex;
  static std::map<std::string, std::string> faults;  // of files that were tried
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(file, error).time_since_epoch().count();
  const std::string key = file + " " + std::to_string(changed);
  const std::lock_guard lock(mutex);
  const auto [tried, is_new] = faults.try_emplace(key);
  if (is_new) tried->second = fault_of(file);
  if (!tried->second.empty()) throw ConfigError(place, file + ": " + tried->second);
}

}  // namespace cairn::python_module
