// A program in a process of its own, with a time limit.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace cairn {

inline constexpr int kReportFd = 3;  // of the child: where it writes what its parent wants to know

struct ChildEnd {
  bool has_timed_out = false;
  int exit_status = -1;  // when it ended by itself
  int signal = 0;        // when a signal ended it
  std::string printed;   // the first bytes of its standard output and error
  std::string reported;  // all that it wrote to kReportFd, to a limit of 1 MiB
};

// What an environment variable says, in seconds from 0.1 to 3600, or the usual.
[[nodiscard]] std::chrono::milliseconds limit_from(const char* variable, std::chrono::milliseconds usual);

// How it ended, for people: "crashed (SIGSEGV)", "called exit(3)", "did not finish within 5 s".
[[nodiscard]] std::string end_text(const ChildEnd& end, std::chrono::milliseconds limit);

// Starts the program (arguments[0], a path) and waits until it has ended. It reads /dev/null, has no other open files
// than these, all signals as usual, and a process group of its own; what is left of the group is killed at the time
// limit or when the program ends. Throws std::system_error: it cannot be started.
[[nodiscard]] ChildEnd run_child(const std::vector<std::string>& arguments, std::chrono::milliseconds limit);

}  // namespace cairn
