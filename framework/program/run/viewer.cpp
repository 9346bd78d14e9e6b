#include "framework/program/run/viewer.hpp"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>

namespace cairn {

// Between fork and exec only what may be called there: the run has threads.
Viewer::Viewer(const std::filesystem::path& folder, bool control, bool to_standard_error) {
  const std::string where = folder.string();
  std::array<const char*, 6> arguments{"cairn", "view", control ? "--control" : "--", control ? "--" : where.c_str()};
  if (control) arguments[4] = where.c_str();
  const pid_t parent = ::getpid();
  child_ = ::fork();
  if (child_ < 0) throw std::runtime_error(std::string("the viewer cannot be started: ") + std::strerror(errno));
  if (child_ > 0) return;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(0);
  if (to_standard_error) ::dup2(STDERR_FILENO, STDOUT_FILENO);
  ::execv("/proc/self/exe", const_cast<char* const*>(arguments.data()));  // NOLINT: exec changes none of them
  ::_exit(127);
}

Viewer::~Viewer() {
  ::kill(child_, SIGTERM);
  while (::waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace cairn
