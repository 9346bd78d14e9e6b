#include "maps/base/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "maps/base/text.hpp"

namespace cairn {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kMaxPrinted = 1000;
constexpr std::size_t kMaxReported = std::size_t{1} << 20U;

[[noreturn]] void fail(const char* what, int error) {
  throw std::system_error(error, std::generic_category(), what);
}

std::string name_of_signal(int signal) {
  const char* const name = ::sigabbrev_np(signal);
  return name == nullptr ? "signal " + std::to_string(signal) : std::string("SIG") + name;
}

// One end of a pipe.
class End {
 public:
  End() = default;
  // Moved out of the way of the numbers that the child uses.
  explicit End(int fd) : fd_(::fcntl(fd, F_DUPFD_CLOEXEC, 10)) { ::close(fd); }
  End(End&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  End& operator=(End&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~End() { close(); }
  void close() {
    if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  }
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_ = -1;
};

struct Pipe {
  End read_end;
  End write_end;
};

Pipe new_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("no pipe", errno);
  Pipe pipe{End(ends[0]), End(ends[1])};
  if (pipe.read_end.fd() < 0 || pipe.write_end.fd() < 0) fail("no pipe", EMFILE);
  return pipe;
}

// What the child gets, released at the end.
struct SpawnSettings {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
  SpawnSettings(int printed, int reported) {
    ::posix_spawn_file_actions_init(&files);
    ::posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files, printed, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, printed, STDERR_FILENO);
    ::posix_spawn_file_actions_adddup2(&files, reported, kReportFd);
    ::posix_spawn_file_actions_addclosefrom_np(&files, kReportFd + 1);
    sigset_t none;
    sigset_t all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setsigmask(&attributes, &none);
    ::posix_spawnattr_setsigdefault(&attributes, &all);
    ::posix_spawnattr_setpgroup(&attributes, 0);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    ::posix_spawn_file_actions_destroy(&files);
    ::posix_spawnattr_destroy(&attributes);
  }
};

pid_t start(const std::vector<std::string>& arguments, int printed, int reported) {
  const SpawnSettings settings(printed, reported);
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  pid_t child = -1;
  const int error =
      ::posix_spawn(&child, arguments.front().c_str(), &settings.files, &settings.attributes, argv.data(), environ);
  if (error != 0) fail("cannot start a process", error);
  return child;
}

// Keeps the first bytes. False: the other side has closed it.
bool read_some(int fd, std::string& text, std::size_t max_bytes) {
  std::array<char, 4096> buffer{};
  const ssize_t count = ::read(fd, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR;
  text.append(buffer.data(), std::min(static_cast<std::size_t>(count), max_bytes - text.size()));
  return count > 0;
}

// Ended, and still to be waited for: its number, and so that of its group, is not given to others yet.
bool has_ended(pid_t child) {
  siginfo_t info{};
  return ::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) != 0 || info.si_pid == child;
}

// Reads what is there, or waits for it a little.
void read_both(std::array<pollfd, 2>& ends, ChildEnd& end, int wait_ms) {
  ::poll(ends.data(), ends.size(), wait_ms);
  const auto read_from = [](pollfd& from, std::string& text, std::size_t max_bytes) {
    if (from.fd >= 0 && from.revents != 0 && !read_some(from.fd, text, max_bytes)) from.fd = -1;
  };
  read_from(ends[0], end.printed, kMaxPrinted);
  read_from(ends[1], end.reported, kMaxReported);
}

}  // namespace

ChildEnd run_child(const std::vector<std::string>& arguments, std::chrono::milliseconds limit) {
  Pipe printed = new_pipe();
  Pipe reported = new_pipe();
  const pid_t child = start(arguments, printed.write_end.fd(), reported.write_end.fd());
  const Clock::time_point deadline = Clock::now() + limit;
  printed.write_end.close();
  reported.write_end.close();
  ChildEnd end;
  std::array<pollfd, 2> ends{{{printed.read_end.fd(), POLLIN, 0}, {reported.read_end.fd(), POLLIN, 0}}};
  while (!end.has_timed_out && !has_ended(child)) {
    // The end of the process closes the pipes, shortly before it can be waited for.
    const bool is_closed = ends[0].fd < 0 && ends[1].fd < 0;
    read_both(ends, end, is_closed ? 1 : 20);
    end.has_timed_out = Clock::now() >= deadline && !has_ended(child);
  }
  ::kill(-child, SIGKILL);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  // What the pipes still hold; a process that left the group may keep them open.
  const auto holds_more = [&] { return ::poll(ends.data(), ends.size(), 0) > 0; };
  while ((ends[0].fd >= 0 || ends[1].fd >= 0) && holds_more() && Clock::now() < deadline + limit)
    read_both(ends, end, 0);
  if (WIFEXITED(status)) end.exit_status = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  return end;
}

std::string end_text(const ChildEnd& end, std::chrono::milliseconds limit) {
  if (end.has_timed_out && limit.count() % 1000 == 0)
    return "did not finish within " + std::to_string(limit.count() / 1000) + " s";
  if (end.has_timed_out) return "did not finish within " + std::to_string(limit.count()) + " ms";
  if (end.signal != 0) return "crashed (" + name_of_signal(end.signal) + ")";
  return "called exit(" + std::to_string(end.exit_status) + ")";
}

std::chrono::milliseconds limit_from(const char* variable, std::chrono::milliseconds usual) {
  const char* const chosen = std::getenv(variable);
  const auto limit_s = number_from<double>(chosen == nullptr ? "" : chosen);
  if (!limit_s || !(*limit_s >= 0.1 && *limit_s <= 3600.0)) return usual;
  return std::chrono::milliseconds(std::llround(1e3 * *limit_s));
}

}  // namespace cairn
