#include "framework/modules/trial/child_trial.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <exception>
#include <string_view>
#include <system_error>

#include "framework/modules/plugin_loader.hpp"
#include "maps/base/child_process.hpp"
#include "maps/base/printable.hpp"

namespace cairn {
namespace {

// What the child reports: these marks as it comes to them, then the outcome between the last two.
constexpr std::string_view kRegistering = "registering\n";
constexpr std::string_view kOutcome = "outcome\n";
constexpr std::size_t kMaxShown = 200;  // of what it printed

void report(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(kReportFd, text.data(), text.size());
    if (count <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(count));
  }
}

TrialOutcome outcome_of_end(const ChildEnd& end, std::chrono::milliseconds limit) {
  const std::size_t begin = end.reported.find(kOutcome);
  const bool is_registered = begin != std::string::npos;
  if (is_registered && !end.has_timed_out && end.signal == 0 && end.exit_status == 0)
    if (const auto outcome = outcome_from(std::string_view(end.reported).substr(begin + kOutcome.size())))
      return *outcome;
  TrialOutcome outcome;
  outcome.is_fatal = true;
  outcome.fault = end_text(end, limit);
  if (is_registered)
    outcome.fault += " while the program ended";
  else
    outcome.fault += end.reported.starts_with(kRegistering) ? " while it registered" : " while it was opened";
  if (!end.printed.empty()) outcome.fault += "; it printed \"" + printable_excerpt(end.printed, kMaxShown) + "\"";
  return outcome;
}

}  // namespace

TrialOutcome ChildTrial::outcome_of(const std::filesystem::path& file) const {
  try {
    return outcome_of_end(run_child({program_.string(), kModuleTrialArgument, file.string()}, limit_), limit_);
  } catch (const std::system_error& error) {
    TrialOutcome outcome;
    outcome.fault = std::string("could not be tried: ") + error.what();
    return outcome;
  }
}

int run_module_trial(const std::filesystem::path& file) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const rlimit no_core{0, 0};
  ::setrlimit(RLIMIT_CORE, &no_core);
  TrialOutcome outcome;
  try {
    for (const RegisteredModule& module : load_plugin(file, [] { report(kRegistering); }).modules)
      outcome.modules.push_back({module.kind, module.name, module.summary});
  } catch (const PluginError& error) {
    outcome.fault = error.reason();
  } catch (const std::exception& error) {
    outcome.fault = printable_excerpt(error.what());
  }
  report(std::string(kOutcome) + text_of(outcome));
  return 0;
}

}  // namespace cairn
